#include "patch_presenter.h"

#include <vtkMapper.h>
#include <vtkProperty.h>

namespace lorica::viewport {

namespace {

/// Before the skin that it lies in, in the depth buffer's units.
constexpr double towardsViewer = -4.0;

}  // namespace

PatchPresenter::~PatchPresenter() {
  clear();
}

void PatchPresenter::clear() {
  if (actor_ != nullptr) {
    renderer()->RemoveActor(actor_->actor());
    actor_.reset();
  }
  drawn_.reset();
}

void PatchPresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  frame_ = frame;
  if (frame == nullptr || (drawn_ != nullptr && drawn_->body != frame->study->body)) {
    clear();
  }
  if (actor_ != nullptr) {
    actor_->show(frame->scene->body().skin, frame->skinNormals);
  }
}

void PatchPresenter::restyle(const document::StudyDocument& /*document*/) {
  if (patch_ == drawn_) {
    return;
  }
  clear();
  if (patch_ == nullptr || frame_ == nullptr || patch_->body != frame_->study->body) {
    return;
  }
  triangles_.clear();
  for (const std::uint32_t t : patch_->triangles) {
    triangles_.push_back(frame_->study->body->body().skin.triangles[t]);
  }
  drawn_ = patch_;
  actor_ = std::make_unique<MeshActor>(triangles_);
  actor_->show(frame_->scene->body().skin, frame_->skinNormals);
  vtkProperty* property = actor_->actor()->GetProperty();
  property->SetColor(0.90, 0.12, 0.10);
  property->SetAmbient(0.5);
  property->SetDiffuse(0.6);
  property->SetSpecular(0.0);
  vtkMapper* mapper = actor_->actor()->GetMapper();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(towardsViewer, towardsViewer);
  renderer()->AddActor(actor_->actor());
}

}  // namespace lorica::viewport
