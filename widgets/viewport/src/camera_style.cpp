#include "camera_style.h"

#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lorica::viewport {

vtkStandardNewMacro(CameraStyle);

void CameraStyle::Rotate() {
  if (CurrentRenderer == nullptr) {
    return;
  }
  vtkRenderWindowInteractor* interactor = GetInteractor();
  const int* size = CurrentRenderer->GetRenderWindow()->GetSize();
  const int* now = interactor->GetEventPosition();
  const int* before = interactor->GetLastEventPosition();
  vtkCamera* camera = CurrentRenderer->GetActiveCamera();
  // Across the window is a full turn.
  camera->Azimuth(-360.0 * (now[0] - before[0]) / std::max(1, size[0]));
  const double wanted = -180.0 * (now[1] - before[1]) / std::max(1, size[1]);
  const double* direction = camera->GetDirectionOfProjection();
  const double elevation = std::asin(std::clamp(-direction[1], -1.0, 1.0)) * 180.0 / std::numbers::pi;
  constexpr double steepest = 89.0;
  camera->Elevation(std::clamp(elevation + wanted, -steepest, steepest) - elevation);
  camera->SetViewUp(0.0, 1.0, 0.0);
  CurrentRenderer->ResetCameraClippingRange();
  CurrentRenderer->UpdateLightsGeometryToFollowCamera();
  interactor->Render();
}

}  // namespace lorica::viewport
