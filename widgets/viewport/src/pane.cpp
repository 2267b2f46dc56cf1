#include "pane.h"

#include <vtkTextProperty.h>

#include "driver_presenter.h"
#include "floor_presenter.h"
#include "mesh_presenter.h"

namespace lorica::viewport {

namespace {

// Depth layers of what is translucent: more are right, fewer are fast.
constexpr int fullPeels = 4;
constexpr int coarsePeels = 1;

}  // namespace

Pane::Pane(std::size_t model, vtkCamera* camera) {
  renderer_->SetActiveCamera(camera);
  renderer_->GradientBackgroundOn();
  renderer_->SetBackground(0.86, 0.88, 0.90);
  renderer_->SetBackground2(0.97, 0.975, 0.98);
  renderer_->SetUseDepthPeeling(1);
  renderer_->SetMaximumNumberOfPeels(fullPeels);
  renderer_->SetOcclusionRatio(0.0);
  renderer_->UseFXAAOn();
  renderer_->AutomaticLightCreationOff();
  light_->SetKeyLightIntensity(0.85);
  light_->AddLightsToRenderer(renderer_);
  presenters_.push_back(std::make_unique<FloorPresenter>(renderer_));
  presenters_.push_back(std::make_unique<SkinPresenter>(renderer_));
  presenters_.push_back(std::make_unique<OrganPresenter>(renderer_, model));
  presenters_.push_back(std::make_unique<ArmorPresenter>(renderer_));
  presenters_.push_back(std::make_unique<DriverPresenter>(renderer_, model));
  auto sources = std::make_unique<SourcePresenter>(renderer_);
  sources_ = sources.get();
  presenters_.push_back(std::move(sources));
  auto shots = std::make_unique<ShotPresenter>(renderer_, model);
  shots_ = shots.get();
  presenters_.push_back(std::move(shots));
  auto inspected = std::make_unique<InspectedShotPresenter>(renderer_, model);
  inspected_ = inspected.get();
  presenters_.push_back(std::move(inspected));
  auto patch = std::make_unique<PatchPresenter>(renderer_);
  patch_ = patch.get();
  presenters_.push_back(std::move(patch));
  vtkTextProperty* text = title_->GetTextProperty();
  text->SetFontFamilyToArial();
  text->SetColor(0.20, 0.22, 0.25);
  text->SetJustificationToCentered();
  text->SetVerticalJustificationToTop();
  title_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  title_->SetPosition(0.5, 0.985);
  renderer_->AddViewProp(title_);
  text->SetFontSize(14);
}

void Pane::showFrame(const std::shared_ptr<const jobs::Frame>& frame, const QString& title) {
  for (const auto& presenter : presenters_) {
    presenter->showFrame(frame);
  }
  title_->SetInput(title.toUtf8().constData());
  title_->SetVisibility(title.isEmpty() ? 0 : 1);
}

void Pane::restyle(const document::StudyDocument& document) {
  for (const auto& presenter : presenters_) {
    presenter->restyle(document);
  }
}

void Pane::showColours(const jobs::OrganColours* colours, const ColourScale& scale) {
  for (const auto& presenter : presenters_) {
    presenter->showColours(colours, scale);
  }
}

void Pane::drawCoarsely(const CoarseMeshes* meshes) {
  const bool full = meshes == nullptr;
  renderer_->SetMaximumNumberOfPeels(full ? fullPeels : coarsePeels);
  renderer_->SetUseFXAA(full);
  for (const auto& presenter : presenters_) {
    presenter->drawCoarsely(meshes);
  }
}

}  // namespace lorica::viewport
