#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include "presenter.h"

namespace lorica::viewport {

/// Where shots come from: a ball at every source and a line to what it aims at.
class SourcePresenter final : public Presenter {
 public:
  explicit SourcePresenter(vtkRenderer* renderer);
  ~SourcePresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override;
  void restyle(const document::StudyDocument& document) override;

 private:
  geometry::Vec3d middle_ = geometry::Vec3d::Zero();  ///< of the posed skin
  bool shown_ = false;
  vtkNew<vtkPolyData> balls_;
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkActor> ballActor_;
  vtkNew<vtkActor> lineActor_;
};

}  // namespace lorica::viewport
