#pragma once

/// \file
/// Where the plain human's joints are and the three fields whose union is its skin.

#include <array>
#include <cstdint>

#include "fields.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/skeleton.h"

namespace lorica::manikin {

inline constexpr double kStature = 1.755;

/// The joints in the order of the skeleton; each right-hand joint stands `kSideStride` places behind its left one.
enum Bone : std::uint32_t {
  pelvisRoot,
  spineL5S1,
  spineL3L4,
  spineL1L2,
  spineT10T11,
  spineT6T7,
  spineT2T3,
  spineC7T1,
  headC0C1,
  sternoclavicular,
  glenohumeral,
  elbow,
  wrist,
  hip,
  knee,
  ankle,
  toe,
};
inline constexpr std::uint32_t kSideStride = 8;
inline constexpr std::uint32_t kBones = toe + 1 + kSideStride;

/// Left or middle joints, at rest.
const std::array<Vec3d, toe + 1>& restPositions();

/// The fields of the person's left half; callers mirror points with x < 0.
double trunkField(const Vec3d& mirrored);
double armField(const Vec3d& mirrored);
double legField(const Vec3d& mirrored);

geometry::TriangleMesh skinSurface();

}  // namespace lorica::manikin
