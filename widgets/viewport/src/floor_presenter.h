#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include "presenter.h"

namespace lorica::viewport {

/// A grid under the feet: a line every 10 cm, a stronger one every metre.
class FloorPresenter final : public Presenter {
 public:
  explicit FloorPresenter(vtkRenderer* renderer);
  ~FloorPresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override;
  void restyle(const document::StudyDocument&) override {}

 private:
  std::shared_ptr<const analysis::LoadedStudy> study_;
  vtkNew<vtkActor> fine_;
  vtkNew<vtkActor> coarse_;
};

}  // namespace lorica::viewport
