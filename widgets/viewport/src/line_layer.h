#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <QColor>
#include <span>

#include "source_shapes.h"

namespace lorica::viewport {

/// Unlit lines or balls of one colour, as large to the eye on every screen.
class LineLayer {
 public:
  /// \param size of lines or balls, logical pixels
  LineLayer(vtkRenderer* renderer, const QColor& colour, float size, double opacity = 1.0);
  ~LineLayer();
  LineLayer(const LineLayer&) = delete;
  LineLayer& operator=(const LineLayer&) = delete;

  /// Takes the place of what was drawn before.
  void draw(std::span<const Polyline> lines, std::span<const geometry::Vec3d> balls = {});

 private:
  vtkRenderer* renderer_;
  float size_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkActor> actor_;
};

}  // namespace lorica::viewport
