#pragma once

/// \file
/// A tape laid around a mesh: the convex hull of a plane section, measured on triangles and nothing else.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::manikin::test {

struct Reading {
  double girth = 0.0;
  double breadth = 0.0;  ///< along the first axis of the plane
  double depth = 0.0;    ///< along the second
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
};

inline double hullLength(std::vector<Eigen::Vector2d> points) {
  // Gift wrapping: slow and simple.
  std::size_t start = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].x() < points[start].x()) {
      start = i;
    }
  }
  double length = 0.0;
  std::size_t here = start;
  for (std::size_t steps = 0; steps <= points.size(); ++steps) {
    std::size_t next = here == 0 ? 1 : 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d a = points[next] - points[here];
      const Eigen::Vector2d b = points[i] - points[here];
      const double turn = a.x() * b.y() - a.y() * b.x();
      if (turn < 0.0 || (turn == 0.0 && b.squaredNorm() > a.squaredNorm())) {
        next = i;
      }
    }
    length += (points[next] - points[here]).norm();
    here = next;
    if (here == start) {
      break;
    }
  }
  return length;
}

/// One reading for each closed piece of the section through `place` with the given normal; `across` gives the first
/// axis of the plane.
inline std::vector<Reading> tapes(const geometry::TriangleMesh& mesh, const geometry::Vec3d& place,
                                  const geometry::Vec3d& normal, const geometry::Vec3d& across) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  const geometry::Vec3d n = normal.normalized();
  const geometry::Vec3d u = (across - across.dot(n) * n).normalized();
  const geometry::Vec3d v = n.cross(u);
  std::map<Edge, std::size_t> pointOf;
  std::vector<Eigen::Vector2d> points;
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k];
      const std::uint32_t b = mesh.triangles[t][(k + 1) % 3];
      const geometry::Vec3d pa = mesh.positions[a].cast<double>() - place;
      const geometry::Vec3d pb = mesh.positions[b].cast<double>() - place;
      const double da = n.dot(pa);
      const double db = n.dot(pb);
      if ((da < 0.0) == (db < 0.0)) {
        continue;
      }
      const auto [entry, fresh] = pointOf.try_emplace({std::min(a, b), std::max(a, b)}, points.size());
      if (fresh) {
        const geometry::Vec3d p = pa + da / (da - db) * (pb - pa);
        points.emplace_back(u.dot(p), v.dot(p));
      }
      ends.push_back(entry->second);
    }
    if (ends.size() == 2) {
      segments.emplace_back(ends[0], ends[1]);
    }
  }
  std::vector<std::size_t> root(points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::size_t i) {
    while (root[i] != i) {
      i = root[i] = root[root[i]];
    }
    return i;
  };
  for (const auto& [a, b] : segments) {
    root[find(a)] = find(b);
  }
  std::map<std::size_t, std::vector<Eigen::Vector2d>> pieces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    pieces[find(i)].push_back(points[i]);
  }
  std::vector<Reading> readings;
  for (const auto& [id, outline] : pieces) {
    Eigen::AlignedBox2d box;
    for (const auto& p : outline) {
      box.extend(p);
    }
    readings.push_back({hullLength(outline), box.sizes().x(), box.sizes().y(), box.center()});
  }
  return readings;
}

/// The piece whose middle is nearest to the place.
inline Reading tapeAt(const geometry::TriangleMesh& mesh, const geometry::Vec3d& place, const geometry::Vec3d& normal,
                      const geometry::Vec3d& across = geometry::Vec3d::UnitX()) {
  const auto all = tapes(mesh, place, normal, across);
  Reading best;
  double nearest = 1e9;
  for (const Reading& reading : all) {
    if (reading.middle.norm() < nearest) {
      nearest = reading.middle.norm();
      best = reading;
    }
  }
  return best;
}

}  // namespace lorica::manikin::test
