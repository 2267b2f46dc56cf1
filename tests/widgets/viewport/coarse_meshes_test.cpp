#include "coarse_meshes.h"

#include <gtest/gtest.h>

#include <QSignalSpy>

#include "coarse_triangles.h"
#include "lorica/study/study_file.h"

namespace lorica::viewport {
namespace {

analysis::LoadedStudy load(const study::Study& study, const analysis::LoadedStudy* previous = nullptr) {
  analysis::LoadOptions options;
  options.previous = previous;
  return analysis::load(study, "sample.lorica.json", {}, {}, options);
}

study::Study sample() {
  return study::parseStudy(study::templateText("sample"), "sample");
}

class Coarse : public testing::Test {
 protected:
  Coarse() : study_(std::make_shared<const analysis::LoadedStudy>(load(sample()))) { meshes_.setStudy(study_); }
  bool make() {
    QSignalSpy made(&meshes_, &CoarseMeshes::made);
    meshes_.make();
    return made.wait(20000);
  }
  const std::vector<geometry::Triangle>& skin() const { return study_->body->body().skin.triangles; }

  std::shared_ptr<const analysis::LoadedStudy> study_;
  CoarseMeshes meshes_;
};

TEST_F(Coarse, AreThereForEveryLargeMeshOnceTheyWereMade) {
  EXPECT_EQ(meshes_.of(skin()), nullptr);
  ASSERT_TRUE(make());
  ASSERT_NE(meshes_.of(skin()), nullptr);
  EXPECT_LT(meshes_.of(skin())->size(), skin().size());
  for (const auto& organ : study_->organs) {
    const auto& all = organ->rig.rest.triangles;
    const CoarseMeshes::Triangles few = meshes_.of(all);
    EXPECT_EQ(few == nullptr, all.size() <= CoarseOptions().least) << organ->name;
    EXPECT_TRUE(few == nullptr || few->size() < all.size()) << organ->name;
  }
}

TEST_F(Coarse, StayWhenTheStudyIsEditedAndAreForgottenWithIt) {
  ASSERT_TRUE(make());
  const CoarseMeshes::Triangles before = meshes_.of(skin());
  study::Study edited = sample();
  edited.organs.pop_back();
  const auto loaded = std::make_shared<const analysis::LoadedStudy>(load(edited, study_.get()));
  meshes_.setStudy(loaded);
  EXPECT_EQ(meshes_.of(loaded->body->body().skin.triangles), before) << "the body was not read again";
  EXPECT_EQ(meshes_.of(study_->organs.back()->rig.rest.triangles), nullptr);
  meshes_.setStudy(nullptr);
  EXPECT_EQ(meshes_.of(skin()), nullptr);
}

TEST_F(Coarse, OfAStudyThatIsGoneAreNeverTold) {
  QSignalSpy made(&meshes_, &CoarseMeshes::made);
  meshes_.make();
  meshes_.setStudy(nullptr);
  EXPECT_FALSE(made.wait(500));
  EXPECT_EQ(meshes_.of(skin()), nullptr);
}

}  // namespace
}  // namespace lorica::viewport
