#pragma once

/// \file
/// Where shots come from and which way they go. A shot is a function of (seed, source, trial, shot) and of nothing
/// else: every model, pose and armor system is met by the same shots.

#include <span>
#include <string>

#include "lorica/geometry/vectors.h"
#include "lorica/raycast/caster.h"
#include "lorica/stats/philox.h"

namespace lorica::shotline {

enum class Sampler {
  cone,   ///< uniform in the solid angle of a cone; every result is a share of that solid angle
  thesis  ///< Eq 15: (target - position) times a random vector in [-10, 10]^3, component by component. For comparison:
          ///< half of its shots go backwards and its hit rate depends on the world's axes
};

/// A point that shots come from, ready to use.
struct PointSource {
  std::string name;
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< metres
  geometry::Vec3d target = geometry::Vec3d::Zero();    ///< the cone's axis runs through it
  Sampler sampler = Sampler::cone;
  double halfAngle = 0.0;  ///< of the cone, radians, 0 to pi
};

/// Half-angle at `position` of the cone around the axis to `target` that holds all points of the posed skins; pi, all
/// directions, when it would reach 90 degrees (the source is at the body or in it).
/// \pre position != target, and there are points
double boundingHalfAngle(const geometry::Vec3d& position, const geometry::Vec3d& target,
                         std::span<const std::span<const geometry::Vec3f>> posedSkins);

/// Solid angle of a cone, steradians.
double solidAngle(double halfAngle);

/// Turns shot numbers into rays. Immutable, thread-safe.
class ShotGenerator {
 public:
  /// \pre position != target
  ShotGenerator(const PointSource& source, std::uint64_t seed, std::uint32_t trial);
  raycast::Ray shot(std::uint64_t number) const;

 private:
  PointSource source_;
  stats::ShotKey key_;
  geometry::Vec3f origin_;
  double widestDrop_ = 0.0;  ///< 1 - cos of the half-angle
  geometry::Mat3d axes_;     ///< columns: two across the cone's axis, then the axis
};

}  // namespace lorica::shotline
