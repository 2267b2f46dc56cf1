#pragma once

/// \file
/// Vectors and matrices. Vertices are float, as Embree and the graphics card read them; everything computed from them
/// is double. Frame: metres, right-handed, y up, the person faces +z, x to the person's left.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace lorica::geometry {

using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;
using Quatd = Eigen::Quaterniond;
using Affine3d = Eigen::Affine3d;
using Box3d = Eigen::AlignedBox3d;

static_assert(sizeof(Vec3f) == 12, "vertex arrays are tightly packed");

/// Allocates 16 bytes more than asked for: Embree reads the last float3 of a shared buffer as 16 bytes.
template <class T>
struct PaddedAllocator {
  using value_type = T;
  PaddedAllocator() = default;
  template <class U>
  PaddedAllocator(const PaddedAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): rebinding
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T) + 16)); }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete(p); }
  template <class U>
  bool operator==(const PaddedAllocator<U>&) const noexcept {
    return true;
  }
};

/// Vertex positions of one mesh; may be shared with the ray tracer and the graphics card without a copy.
using Positions = std::vector<Vec3f, PaddedAllocator<Vec3f>>;

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

}  // namespace lorica::geometry
