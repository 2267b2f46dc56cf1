#include "canvas.h"

#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

namespace lorica::viewport {

void Canvas::paintGL() {
  vtkRenderWindowInteractor* interactor = renderWindow()->GetInteractor();
  interactor->EnableRenderOn();
  QVTKOpenGLNativeWidget::paintGL();
  interactor->EnableRenderOff();
}

}  // namespace lorica::viewport
