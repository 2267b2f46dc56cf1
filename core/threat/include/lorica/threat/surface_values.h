#pragma once

/// \file
/// What reaches a surface: the greatest value over time at each vertex, when it comes, its integral over time, and
/// what that makes of a structure. "No value" is not a number in arrays.

#include <optional>
#include <span>
#include <vector>

#include "lorica/base/progress.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/threat/field_sampler.h"

namespace lorica::threat {

/// Per vertex; of the times of the field's steps, between which the field is linear, so that its extremes are there.
struct Exposure {
  std::vector<float> peak;       ///< greatest value
  std::vector<double> peakTime;  ///< seconds, of the first time it is reached
  /// Of the value over time where it is above zero, attribute's unit times seconds: of pressure the impulse of the
  /// positive phase. Exact for a field linear between its steps; from step to step where both have a value. Empty for
  /// fields of one step.
  std::vector<float> integral;
};

/// \param attribute index; of vectors the length counts
/// \throw base::Cancelled
/// Cost: a stencil per vertex and distinct set of points, then some nanoseconds per vertex and step.
Exposure exposure(const FieldSampler& sampler, std::size_t attribute, std::span<const geometry::Vec3f> positions,
                  base::Threads threads = {}, const base::Progress& progress = {});

/// Of values that are linear over each triangle. Triangles with a corner that has no value are left out.
struct SurfaceStatistics {
  double area = 0.0;                       ///< of all triangles, m2
  double areaWithValue = 0.0;              ///< of those with a value at each corner, m2
  std::optional<float> max;                ///< of all corners that have a value
  std::optional<std::uint32_t> maxVertex;  ///< where it is; of several the lowest index
  std::optional<double> mean;              ///< by area; none without areaWithValue
  std::optional<double> shareAbove;        ///< of areaWithValue on which the value exceeds the threshold, 0 to 1
};

/// \pre a value per position; corners are below that
SurfaceStatistics surfaceStatistics(std::span<const geometry::Vec3f> positions,
                                    std::span<const geometry::Triangle> triangles, std::span<const float> values,
                                    std::optional<double> threshold = {});

/// Share of a triangle on which a function that is linear between its corner values exceeds `threshold`, 0 to 1.
double shareOfTriangleAbove(std::array<double, 3> corners, double threshold);

}  // namespace lorica::threat
