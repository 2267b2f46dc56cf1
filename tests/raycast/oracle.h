#pragma once

/// \file
/// All hits of a ray by testing every triangle, in extended precision and by another formula than the program's.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/raycast/caster.h"

namespace lorica::test {

struct OracleHit {
  double t;
  std::uint32_t mesh;
  std::uint32_t triangle;
  bool entering;
};

struct OracleAnswer {
  std::vector<OracleHit> hits;
  /// The ray passes within 1e-6, relative to the distance, of an edge where the surface ends as the ray sees it: an
  /// open edge, or one whose two triangles face opposite ways. Single precision may miss what lies just inside.
  bool nearContour = false;
  bool onEdge = false;  ///< closer than extended precision tells
};

using Vec3l = Eigen::Matrix<long double, 3, 1>;

/// Moeller and Trumbore 1997, in long double.
inline OracleAnswer castByOracle(const raycast::Ray& ray, const std::vector<const geometry::TriangleMesh*>& meshes) {
  OracleAnswer answer;
  const Vec3l o = ray.origin.cast<long double>();
  const Vec3l d = ray.direction.cast<long double>();
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    const geometry::TriangleMesh& mesh = *meshes[m];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      std::array<Vec3l, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = mesh.positions[mesh.triangles[t][k]].cast<long double>();
      }
      const Vec3l e1 = p[1] - p[0];
      const Vec3l e2 = p[2] - p[0];
      const Vec3l q = d.cross(e2);
      const long double det = e1.dot(q);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3l a = p[k] - o;
        const Vec3l edge = p[(k + 1) % 3] - p[k];
        const long double apart = std::abs(d.dot(edge.cross(a))) / std::max(1e-30L, d.cross(edge).norm());
        const long double along = a.dot(d) / d.squaredNorm();
        if (apart <= 1e-6L * std::max(a.norm(), (p[(k + 1) % 3] - o).norm()) && along > -1.0L) {
          answer.nearContour = true;
        }
      }
      if (det == 0) {
        continue;
      }
      const Vec3l s = o - p[0];
      const long double u = s.dot(q) / det;
      const Vec3l r = s.cross(e1);
      const long double v = d.dot(r) / det;
      const long double time = e2.dot(r) / det;
      const long double least = std::min({u, v, 1 - u - v});
      if (std::abs(least) < 1e-12L) {
        answer.onEdge = true;
      }
      if (least > 0 && time >= 0) {
        answer.hits.push_back({static_cast<double>(time), m, t, det > 0});
      }
    }
  }
  std::sort(answer.hits.begin(), answer.hits.end(), [](const OracleHit& a, const OracleHit& b) {
    return a.t != b.t ? a.t < b.t : std::pair(a.mesh, a.triangle) < std::pair(b.mesh, b.triangle);
  });
  return answer;
}

}  // namespace lorica::test
