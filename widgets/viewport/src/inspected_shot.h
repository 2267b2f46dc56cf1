#pragma once

#include "line_layer.h"
#include "lorica/jobs/shot_inspector.h"
#include "presenter.h"

namespace lorica::viewport {

/// The shot that is looked into: its whole line, with a ball where it enters and a smaller one where it leaves.
class InspectedShotPresenter final : public Presenter {
 public:
  /// \param model of the frame's models whose organs are marked
  InspectedShotPresenter(vtkRenderer* renderer, std::size_t model);
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override;
  void restyle(const document::StudyDocument& document) override;
  /// Null: no shot. It is drawn while the pose it was looked into is shown.
  void inspect(std::shared_ptr<const jobs::ShotInspection> inspection) { inspection_ = std::move(inspection); }

 private:
  std::size_t model_;
  std::shared_ptr<const jobs::Frame> frame_;
  std::shared_ptr<const jobs::ShotInspection> inspection_;
  LineLayer line_;
  LineLayer inside_;
  LineLayer entries_;
  LineLayer exits_;
};

}  // namespace lorica::viewport
