#include "lorica/geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lorica/base/error.h"
#include "lorica/geometry/sides.h"

namespace lorica::geometry {

namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr std::size_t kDepth = 64;  ///< halving 2^32 triangles needs 32

Vec3d onSide(const Vec3d& query, const Vec3d& from, const Vec3d& to, int first, int second) {
  const Vec3d along = to - from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((query - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  Vec3d barycentric = Vec3d::Zero();
  barycentric[first] = 1.0 - t;
  barycentric[second] = t;
  return barycentric;
}

Vec3d onLongestSide(const Vec3d& query, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double ab = (b - a).squaredNorm();
  const double bc = (c - b).squaredNorm();
  const double ca = (a - c).squaredNorm();
  if (ab >= bc && ab >= ca) {
    return onSide(query, a, b, 0, 1);
  }
  return bc >= ca ? onSide(query, b, c, 1, 2) : onSide(query, c, a, 2, 0);
}

double distance2ToBox(const Vec3d& query, const Vec3d& low, const Vec3d& high) {
  return (query - query.cwiseMax(low).cwiseMin(high)).squaredNorm();
}

Vec3d unitOrZero(const Vec3d& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3d(v / length) : Vec3d(Vec3d::Zero());
}

double angleBetween(const Vec3d& u, const Vec3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Sums of the face normals over the triangles that share a side.
std::vector<std::array<Vec3d, 3>> sideNormals(const std::vector<Triangle>& triangles, const std::vector<Vec3d>& faces) {
  const std::vector<TriangleSide> sides = sidesByEdge(triangles);
  std::vector<std::array<Vec3d, 3>> sums(triangles.size());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    Vec3d sum = Vec3d::Zero();
    for (end = begin; end < sides.size() && sides[end].sameEdge(sides[begin]); ++end) {
      sum += faces[sides[end].triangle];
    }
    for (std::size_t i = begin; i < end; ++i) {
      sums[sides[i].triangle][sides[i].corner] = sum;
    }
  }
  return sums;
}

}  // namespace

Vec3d closestBarycentric(const Vec3d& query, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  // Corners in a line but for rounding: the regions below would be decided by it.
  constexpr double thin = 1e-24;
  if (ab.cross(ac).squaredNorm() <= thin * ab.squaredNorm() * ac.squaredNorm()) {
    return onLongestSide(query, a, b, c);
  }
  const Vec3d ap = query - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return {1, 0, 0};
  }
  const Vec3d bp = query - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) {
    return {0, 1, 0};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return onSide(query, a, b, 0, 1);
  }
  const Vec3d cp = query - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) {
    return {0, 0, 1};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return onSide(query, c, a, 2, 0);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return onSide(query, b, c, 1, 2);
  }
  const double total = va + vb + vc;
  const double v = vb / total;
  const double w = vc / total;
  return {std::max(1.0 - v - w, 0.0), v, w};
}

ClosestPointTree::ClosestPointTree(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
  const std::size_t count = triangles_.size();
  faceNormals_.resize(count);
  vertexNormals_.assign(mesh.positions.size(), Vec3d::Zero());
  std::vector<Vec3d> centres(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::array<Vec3d, 3> corner{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    centres[t] = (corner[0] + corner[1] + corner[2]) / 3.0;
    faceNormals_[t] = unitOrZero((corner[1] - corner[0]).cross(corner[2] - corner[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = angleBetween(corner[(k + 1) % 3] - corner[k], corner[(k + 2) % 3] - corner[k]);
      vertexNormals_[triangles_[t][k]] += angle * faceNormals_[t];
    }
  }
  sides_ = sideNormals(triangles_, faceNormals_);
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0U);
  if (count > 0) {
    nodes_.reserve(count);
    build(mesh, centres, 0, static_cast<std::uint32_t>(count));
  }
  corners_.reserve(count);
  for (const std::uint32_t t : order_) {
    corners_.push_back({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
  }
}

std::uint32_t ClosestPointTree::build(const TriangleMesh& mesh, const std::vector<Vec3d>& centres, std::uint32_t begin,
                                      std::uint32_t end) {
  Box3d box;
  Box3d spread;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (int k = 0; k < 3; ++k) {
      box.extend(mesh.corner(order_[i], k));
    }
    spread.extend(centres[order_[i]]);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({box.min(), box.max(), begin, end - begin});
  if (end - begin > kLeaf) {
    Eigen::Index axis = 0;
    spread.sizes().maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t s, std::uint32_t t) {
                       return std::pair(centres[s][axis], s) < std::pair(centres[t][axis], t);
                     });
    build(mesh, centres, begin, middle);
    const std::uint32_t second = build(mesh, centres, middle, end);
    nodes_[index].begin = second;
    nodes_[index].count = 0;
  }
  return index;
}

std::optional<ClosestPoint> ClosestPointTree::closest(const Vec3d& query, double radius) const {
  if (empty()) {
    return std::nullopt;
  }
  double best2 = radius * radius;
  std::optional<ClosestPoint> best;
  struct Waiting {
    std::uint32_t node;
    double distance2;
  };
  std::array<Waiting, kDepth> stack{};
  std::size_t waiting = 0;
  stack[waiting++] = {0, distance2ToBox(query, nodes_[0].low, nodes_[0].high)};
  while (waiting > 0) {
    const auto [index, distance2] = stack[--waiting];
    if (distance2 > best2) {
      continue;
    }
    const Node& node = nodes_[index];
    if (node.count == 0) {
      Waiting near{index + 1, distance2ToBox(query, nodes_[index + 1].low, nodes_[index + 1].high)};
      Waiting far{node.begin, distance2ToBox(query, nodes_[node.begin].low, nodes_[node.begin].high)};
      if (far.distance2 < near.distance2) {
        std::swap(near, far);
      }
      stack[waiting++] = far;
      stack[waiting++] = near;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) {
      const auto& [a, b, c] = corners_[i];
      const Vec3d barycentric = closestBarycentric(query, a, b, c);
      const Vec3d point = barycentric[0] * a + barycentric[1] * b + barycentric[2] * c;
      const double found2 = (point - query).squaredNorm();
      if (found2 < best2 || (found2 == best2 && (!best || order_[i] < best->triangle))) {
        best2 = found2;
        best = ClosestPoint{0.0, order_[i], barycentric, point, Vec3d::Zero()};
      }
    }
  }
  if (best) {
    best->distance = std::sqrt(best2);
    best->pseudoNormal = pseudoNormal(best->triangle, best->barycentric);
  }
  return best;
}

Vec3d ClosestPointTree::pseudoNormal(std::uint32_t triangle, const Vec3d& barycentric) const {
  for (int k = 0; k < 3; ++k) {
    if (barycentric[k] == 1.0) {
      return vertexNormals_[triangles_[triangle][static_cast<std::size_t>(k)]];
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (barycentric[(k + 2) % 3] == 0.0) {
      return sides_[triangle][static_cast<std::size_t>(k)];
    }
  }
  return faceNormals_[triangle];
}

double ClosestPointTree::signedDistance(const Vec3d& query) const {
  LORICA_CHECK(!empty(), "a distance needs a surface");
  const auto found = closest(query);
  return found->pseudoNormal.dot(query - found->point) < 0.0 ? -found->distance : found->distance;
}

}  // namespace lorica::geometry
