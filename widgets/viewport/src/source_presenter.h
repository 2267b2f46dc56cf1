#pragma once

#include <vtkBillboardTextActor3D.h>
#include <vtkSmartPointer.h>

#include "line_layer.h"
#include "presenter.h"

namespace lorica::viewport {

/// Where shots come from, each source by its shape, the selected one stronger; around the body, what azimuth and
/// elevation mean, while a source is selected.
class SourcePresenter final : public Presenter {
 public:
  explicit SourcePresenter(vtkRenderer* renderer);
  ~SourcePresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) override;
  void restyle(const document::StudyDocument& document) override;
  /// Whether azimuth and elevation are drawn at all.
  void setCompass(bool on) { compassOn_ = on; }
  /// Hides labels that would lie over others as the camera stands now.
  void placeLabels();

 private:
  std::span<const raycast::Ray> listedBy(const std::string& source) const;
  void drawCompass(const std::optional<Compass>& compass);

  std::shared_ptr<const jobs::Frame> frame_;
  bool compassOn_ = true;
  LineLayer lines_;
  LineLayer balls_;
  LineLayer selectedLines_;
  LineLayer selectedBalls_;
  LineLayer compass_;
  LineLayer direction_;
  std::vector<CompassLabel> shownLabels_;
  std::vector<vtkSmartPointer<vtkBillboardTextActor3D>> labels_;  ///< as many at least
};

/// Where a source is aimed at in a posed scene, and the radius of the ball around that which holds the skin.
geometry::Vec3d aimIn(const jobs::Frame& frame, const study::Source& source);
double radiusIn(const jobs::Frame& frame, const geometry::Vec3d& aim);

}  // namespace lorica::viewport
