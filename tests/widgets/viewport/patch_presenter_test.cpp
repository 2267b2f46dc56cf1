#include "patch_presenter.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>

#include <QTest>

#include "sample_document.h"

namespace lorica::viewport {
namespace {

class Patch : public testing::Test {
 protected:
  Patch() { testsupport::openLoadedSample(document_); }

  static std::shared_ptr<const jobs::Frame> frameAt(const std::string& pose) {
    std::shared_ptr<const jobs::Frame> got;
    jobs::FrameEngine engine;
    engine.setStudy(testsupport::loadedSample());
    QObject::connect(
        &engine, &jobs::FrameEngine::frameReady, &engine,
        [&](std::shared_ptr<const jobs::Frame> frame) { got = std::move(frame); }, Qt::QueuedConnection);
    jobs::FrameRequest request;
    request.pose = pose;
    request.models = {viscera::OrganModel::staticJoint};
    engine.request(request);
    EXPECT_TRUE(QTest::qWaitFor([&] { return got != nullptr; }, 20000));
    return got;
  }
  /// Whether what is drawn is no larger than, and as near as, the patch's corners.
  void expectBoundsOf(const jobs::Frame& frame, const std::vector<std::uint32_t>& triangles) {
    geometry::Box3d box;
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t corner : frame.study->body->body().skin.triangles[t]) {
        box.extend(frame.scene->body().skin[corner].cast<double>());
      }
    }
    vtkActorCollection* actors = renderer_->GetActors();
    actors->InitTraversal();
    const double* bounds = actors->GetNextActor()->GetBounds();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(bounds[2 * axis], box.min()[axis], 1e-5);
      EXPECT_NEAR(bounds[2 * axis + 1], box.max()[axis], 1e-5);
    }
  }

  document::StudyDocument document_;
  vtkNew<vtkRenderer> renderer_;
};

TEST_F(Patch, LiesOnTheSkinAndGoesWithItFromPoseToPose) {
  PatchPresenter presenter(renderer_);
  const std::vector<std::uint32_t> triangles{10, 11, 12, 500};
  presenter.mark(
      std::make_shared<jobs::SkinPatch>(jobs::SkinPatch{testsupport::loadedSample()->body, "rest", triangles, {}, {}}));
  EXPECT_EQ(presenter.shownTriangles(), 0U) << "there is no body yet";
  const auto rest = frameAt("rest");
  presenter.showFrame(rest);
  presenter.restyle(document_);
  EXPECT_EQ(presenter.shownTriangles(), 4U);
  expectBoundsOf(*rest, triangles);
  const auto bent = frameAt("toe_touch@2");
  presenter.showFrame(bent);
  presenter.restyle(document_);
  expectBoundsOf(*bent, triangles);
  presenter.mark(nullptr);
  presenter.restyle(document_);
  EXPECT_EQ(presenter.shownTriangles(), 0U);
  EXPECT_EQ(renderer_->GetActors()->GetNumberOfItems(), 0);
}

TEST_F(Patch, OfAnotherBodyIsNotDrawn) {
  PatchPresenter presenter(renderer_);
  presenter.showFrame(frameAt("rest"));
  presenter.mark(std::make_shared<jobs::SkinPatch>(jobs::SkinPatch{nullptr, "rest", {1, 2}, {}, {}}));
  presenter.restyle(document_);
  EXPECT_EQ(presenter.shownTriangles(), 0U);
}

}  // namespace
}  // namespace lorica::viewport
