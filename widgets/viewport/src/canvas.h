#pragma once

#include <QVTKOpenGLNativeWidget.h>

namespace lorica::viewport {

/// VTK's widget, except that it draws by itself only what it must at once, as after a resize. Where VTK would draw on
/// every event (a mouse move, a turn of the wheel) its interactor tells vtkCommand::RenderEvent and nothing more, so
/// that many events can have one drawing.
class Canvas : public QVTKOpenGLNativeWidget {
 public:
  using QVTKOpenGLNativeWidget::QVTKOpenGLNativeWidget;

 protected:
  void paintGL() override;
};

}  // namespace lorica::viewport
