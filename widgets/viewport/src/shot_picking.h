#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "lorica/geometry/vectors.h"

namespace lorica::viewport {

/// A shot as it is drawn.
struct DrawnShot {
  std::uint64_t number = 0;  ///< of the shot in its trial
  geometry::Vec3d from = geometry::Vec3d::Zero();
  geometry::Vec3d to = geometry::Vec3d::Zero();
};

/// How a place in the scene comes to the screen.
struct ScreenView {
  Eigen::Matrix4d toClip = Eigen::Matrix4d::Identity();  ///< clip space, each axis within -w to w
  Eigen::Vector2d size = Eigen::Vector2d::Ones();        ///< pixels

  /// Pixels from the lower left corner. \pre the place lies before the camera
  Eigen::Vector2d pixel(const geometry::Vec3d& place) const;
};

/// The shot whose line passes nearest to a place on the screen, within some pixels; of those that pass alike the
/// nearest to the camera. Index into `shots`.
std::optional<std::size_t> shotAt(std::span<const DrawnShot> shots, const ScreenView& view,
                                  const Eigen::Vector2d& place, double tolerance);

}  // namespace lorica::viewport
