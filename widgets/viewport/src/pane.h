#pragma once

#include <vtkCamera.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <memory>
#include <vector>

#include "inspected_shot.h"
#include "patch_presenter.h"
#include "presenter.h"
#include "shot_presenter.h"
#include "source_presenter.h"

namespace lorica::viewport {

/// One of the pictures side by side: the body with the organs of one model.
class Pane {
 public:
  /// \param model index into the models of the frames it will be shown
  Pane(std::size_t model, vtkCamera* camera);

  vtkRenderer* renderer() { return renderer_; }
  ShotPresenter& shots() { return *shots_; }
  SourcePresenter& sources() { return *sources_; }
  InspectedShotPresenter& inspected() { return *inspected_; }
  PatchPresenter& patch() { return *patch_; }
  /// \param title of the pane; empty: none
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame, const QString& title);
  void restyle(const document::StudyDocument& document);
  /// Draws less of everything, fewer depth layers of what is translucent, edges unsmoothed; null: all there is.
  void drawCoarsely(const CoarseMeshes* meshes);
  /// Null: organs have no values. \pre of the frame that is shown
  void showColours(const jobs::OrganColours* colours, const ColourScale& scale);

 private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkLightKit> light_;
  vtkNew<vtkTextActor> title_;
  std::vector<std::unique_ptr<Presenter>> presenters_;
  ShotPresenter* shots_ = nullptr;
  SourcePresenter* sources_ = nullptr;
  InspectedShotPresenter* inspected_ = nullptr;
  PatchPresenter* patch_ = nullptr;
};

}  // namespace lorica::viewport
