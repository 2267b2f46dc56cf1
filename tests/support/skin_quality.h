#pragma once

/// \file
/// How well a posed skin keeps the shape of the rest skin.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "lorica/geometry/measures.h"
#include "lorica/human/skinning.h"

namespace lorica::test {

struct SkinQuality {
  double volumeChange = 0.0;  ///< (posed - rest) / rest, signed volumes: what lies in itself counts twice
  double flippedShare = 0.0;  ///< of the rest area: triangles that face away from where their joints turned them
  double worstStretch = 1.0;  ///< longest posed edge length over its rest length
  double worstSqueeze = 1.0;  ///< shortest
};

/// The unit quaternion (x, y, z, w) of the turn that a vertex' weights imply: the normalised blend of its joints'
/// turns.
inline Eigen::Vector4d impliedTurn(const human::SkinWeights& weights, const human::SkinningDeltas& deltas,
                                   std::size_t vertex) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < weights.influences; ++k) {
    const std::size_t at = vertex * weights.influences + k;
    sum += static_cast<double>(weights.weights[at]) * deltas.joints[weights.joints[at]].col(4).cast<double>();
  }
  return sum.normalized();
}

/// A triangle is flipped when its posed normal points against its rest normal turned by the mean of its corners'
/// implied turns. That asks nothing of the method that posed it: linear blending is judged by the same turns.
inline SkinQuality skinQuality(const geometry::TriangleMesh& rest, const human::SkinWeights& weights,
                               const human::SkinningDeltas& deltas, std::span<const geometry::Vec3f> posed) {
  geometry::TriangleMesh moved = rest;
  std::copy(posed.begin(), posed.end(), moved.positions.begin());
  std::vector<Eigen::Vector4d> turns;
  for (std::size_t v = 0; v < rest.positions.size(); ++v) {
    turns.push_back(impliedTurn(weights, deltas, v));
  }
  const auto normal = [](const geometry::TriangleMesh& mesh, std::size_t t) {
    return geometry::Vec3d((mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)));
  };
  SkinQuality quality;
  const double restVolume = geometry::signedVolume(rest);
  quality.volumeChange = (geometry::signedVolume(moved) - restVolume) / restVolume;
  double area = 0.0;
  double flipped = 0.0;
  for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
    const geometry::Triangle& corner = rest.triangles[t];
    const Eigen::Vector4d turn = turns[corner[0]] + turns[corner[1]] + turns[corner[2]];
    const geometry::Vec3d before = normal(rest, t);
    const geometry::Vec3d expected = geometry::Quatd(turn.normalized()) * before;
    area += before.norm();
    flipped += normal(moved, t).dot(expected) < 0.0 ? before.norm() : 0.0;
    for (int k = 0; k < 3; ++k) {
      const double ratio = (moved.corner(t, k) - moved.corner(t, (k + 1) % 3)).norm() /
                           (rest.corner(t, k) - rest.corner(t, (k + 1) % 3)).norm();
      quality.worstStretch = std::max(quality.worstStretch, ratio);
      quality.worstSqueeze = std::min(quality.worstSqueeze, ratio);
    }
  }
  quality.flippedShare = flipped / area;
  return quality;
}

}  // namespace lorica::test
