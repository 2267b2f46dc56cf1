#include "lorica/jobs/frame_engine.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>
#include <set>

#include "lorica/geometry/measures.h"
#include "lorica/study/study_file.h"

namespace lorica::jobs {
namespace {

using viscera::OrganModel;

std::shared_ptr<const analysis::LoadedStudy> sample() {
  static const auto study = std::make_shared<const analysis::LoadedStudy>(
      analysis::load(study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json", {}));
  return study;
}

class Engine : public testing::Test {
 protected:
  Engine() {
    QObject::connect(
        &engine_, &FrameEngine::frameReady, &engine_,
        [this](std::shared_ptr<const Frame> frame) { frames_.push_back(std::move(frame)); }, Qt::QueuedConnection);
    engine_.setStudy(sample());
  }
  /// The next frame of this pose.
  std::shared_ptr<const Frame> wait(const std::string& pose) {
    const auto there = [&] { return !frames_.empty() && frames_.back()->pose == pose; };
    return QTest::qWaitFor(there, 20000) ? frames_.back() : nullptr;
  }
  static FrameRequest at(const std::string& pose) {
    FrameRequest request;
    request.pose = pose;
    return request;
  }

  FrameEngine engine_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

TEST_F(Engine, AFrameIsThePoseWithNormalsOfEverything) {
  engine_.request(at("toe_touch@2"));
  const auto frame = wait("toe_touch@2");
  ASSERT_NE(frame, nullptr);
  const analysis::LoadedStudy& study = *sample();
  const analysis::PosedScene scene(study, {OrganModel::dynamic}, analysis::resolvePose(study, "toe_touch@2").pose,
                                   raycast::SceneUse::manyRays, {});
  EXPECT_EQ(frame->scene->body().skin, scene.body().skin);
  EXPECT_EQ(frame->skinNormals, geometry::vertexNormals(scene.body().skin, study.body->body().skin.triangles));
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    EXPECT_EQ(frame->scene->organ(o, 0), scene.organ(o, 0));
    EXPECT_EQ(frame->organNormals[o], geometry::vertexNormals(scene.organ(o, 0), study.organs[o]->rig.rest.triangles));
  }
  EXPECT_GT(frame->engineMs, 0.0);
}

TEST_F(Engine, AFrameThatIsHeldIsNeverWrittenTo) {
  engine_.request(at("rest"));
  const auto held = wait("rest");
  ASSERT_NE(held, nullptr);
  const geometry::Positions skin = held->scene->body().skin;
  const geometry::Vec3f* place = held->scene->body().skin.data();
  for (const char* pose : {"toe_touch@1", "toe_touch@2", "belly_twist@1"}) {
    engine_.request(at(pose));
    ASSERT_NE(wait(pose), nullptr);
  }
  EXPECT_EQ(held->scene->body().skin, skin);
  EXPECT_EQ(held->scene->body().skin.data(), place);
}

TEST_F(Engine, BuffersOfFramesThatNobodyHoldsAreUsedAgain) {
  std::set<const geometry::Vec3f*> places;
  for (int i = 0; i < 12; ++i) {
    const std::string pose = "toe_touch@" + std::to_string(i * 0.25).substr(0, 4);
    engine_.request(at(pose));
    const auto frame = wait(pose);
    ASSERT_NE(frame, nullptr);
    places.insert(frame->scene->body().skin.data());
    frames_.clear();
  }
  EXPECT_LE(places.size(), 3U);
}

TEST_F(Engine, OnlyTheLastOfManyRequestsHasToBeComputed) {
  for (int i = 0; i < 100; ++i) {
    engine_.request(at("toe_touch@" + std::to_string(i * 0.03).substr(0, 4)));
  }
  engine_.request(at("rest"));
  ASSERT_NE(wait("rest"), nullptr);
  EXPECT_LT(frames_.size(), 100U);
  EXPECT_FALSE(engine_.isBusy());
}

TEST_F(Engine, APoseThatDoesNotExistIsToldInOneSentence) {
  QSignalSpy failed(&engine_, &FrameEngine::failed);
  engine_.request(at("hand_stand"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !failed.empty(); }, 60000));
  EXPECT_TRUE(failed[0][0].toString().contains("hand_stand"));
}

TEST_F(Engine, ShotsAreThoseOfTheSourceUpToTheLimit) {
  FrameRequest request = at("rest");
  request.shotSource = 0;
  request.shotLimit = 77;
  engine_.request(request);
  const auto frame = wait("rest");
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->shots.size(), 77U);
}

}  // namespace
}  // namespace lorica::jobs
