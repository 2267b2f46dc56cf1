#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <array>

#include "presenter.h"

namespace lorica::viewport {

/// What drives the organ that is looked into, in one model. Nothing is built of what is not shown.
class DriverPresenter final : public Presenter {
 public:
  /// \param model index into the frame's models
  DriverPresenter(vtkRenderer* renderer, std::size_t model);
  ~DriverPresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override { frame_ = frame; }
  void restyle(const document::StudyDocument& document) override;

  /// For tests: what is drawn of one kind; without points where nothing is.
  vtkPolyData* drawn(document::Driver driver) const;

 private:
  enum Layer { edges, points, sites, otherSites, rays, anchors, axes, layerTotal };
  struct Drawn {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkActor> actor;
  };

  void scaleToScreen();

  std::size_t model_;
  std::shared_ptr<const jobs::Frame> frame_;
  std::array<Drawn, layerTotal> layers_;
};

}  // namespace lorica::viewport
