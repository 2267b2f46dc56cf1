#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <array>

#include "presenter.h"

namespace lorica::viewport {

/// What drives the organ that is looked into, in one model. Rays and frame of the site in its middle stand out from
/// those of the others, which would hide one another. Nothing is built of what is not shown.
class DriverPresenter final : public Presenter {
 public:
  /// \param model index into the frame's models
  DriverPresenter(vtkRenderer* renderer, std::size_t model);
  ~DriverPresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override { frame_ = frame; }
  void restyle(const document::StudyDocument& document) override;

  /// How many dots and lines are drawn of one kind.
  vtkIdType drawn(document::Driver driver) const;

 private:
  class Drawing;
  enum Layer { edges, points, otherSites, sites, otherRays, rays, anchors, otherAxes, axes, layerTotal };
  struct Drawn {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkActor> actor;
  };

  void scaleToScreen();
  void buildSites(std::array<Drawing, layerTotal>& drawings, document::Drivers shown) const;

  std::size_t model_;
  std::shared_ptr<const jobs::Frame> frame_;
  std::array<Drawn, layerTotal> layers_;
};

}  // namespace lorica::viewport
