#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

namespace lorica::viewport {

/// Turns about the body with up staying up; pans with the middle button, zooms with wheel and right button. Keys are
/// the window's, not VTK's.
class CameraStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static CameraStyle* New();
  vtkTypeMacro(CameraStyle, vtkInteractorStyleTrackballCamera);

  void Rotate() override;
  void OnChar() override {}
  void OnKeyPress() override {}
  void OnKeyRelease() override {}
};

}  // namespace lorica::viewport
