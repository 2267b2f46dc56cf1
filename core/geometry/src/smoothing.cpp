#include "lorica/geometry/smoothing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lorica/base/error.h"

namespace lorica::geometry {

namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Every edge once in each direction, by its first vertex.
Edges edgesOf(const TriangleMesh& mesh, const std::function<bool(std::uint32_t)>& kept) {
  Edges edges;
  edges.reserve(6 * mesh.triangles.size());
  for (const Triangle& corner : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[k];
      const std::uint32_t b = corner[(k + 1) % 3];
      if (a != b && (!kept || (kept(a) && kept(b)))) {
        edges.emplace_back(a, b);
        edges.emplace_back(b, a);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

std::size_t SurfaceNeighbours::stepsFor(double length) const {
  // A step spreads by half of an edge squared. More than the bound would take longer than it is worth.
  constexpr double most = 1000.0;
  return squaredEdge > 0.0 ? static_cast<std::size_t>(std::min(std::ceil(2.0 * length * length / squaredEdge), most))
                           : 0;
}

SurfaceNeighbours surfaceNeighbours(const TriangleMesh& mesh, const std::function<bool(std::uint32_t)>& kept) {
  const Edges edges = edgesOf(mesh, kept);
  SurfaceNeighbours result;
  result.first.assign(mesh.positions.size() + 1, 0);
  for (const auto& [from, to] : edges) {
    ++result.first[from + 1];
    const double length = (mesh.positions[to].cast<double>() - mesh.positions[from].cast<double>()).norm();
    result.vertex.push_back(to);
    result.share.push_back(length);
    result.squaredEdge += length * length / static_cast<double>(edges.size());
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    result.first[v + 1] += result.first[v];
  }
  const double shortest = 1e-6 * std::sqrt(result.squaredEdge);
  for (double& share : result.share) {
    share = 1.0 / std::max({share, shortest, std::numeric_limits<double>::min()});
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    double sum = 0.0;
    for (std::size_t e = result.first[v]; e < result.first[v + 1]; ++e) {
      sum += result.share[e];
    }
    for (std::size_t e = result.first[v]; e < result.first[v + 1]; ++e) {
      result.share[e] /= sum;
    }
  }
  return result;
}

Positions taubinSmoothed(const TriangleMesh& mesh, const TaubinOptions& options) {
  LORICA_CHECK(options.rounds >= 0 && options.lambda > 0.0 && options.mu > options.lambda && options.mu < 1.0,
               "a step and a longer one back");
  const SurfaceNeighbours neighbours = surfaceNeighbours(mesh);
  std::vector<Vec3d> places;
  for (const Vec3f& place : mesh.positions) {
    places.emplace_back(place.cast<double>());
  }
  std::vector<Vec3d> moved(places.size());
  for (int half = 0; half < 2 * options.rounds; ++half) {
    const double share = half % 2 == 0 ? options.lambda : -options.mu;
    for (std::size_t v = 0; v < places.size(); ++v) {
      moved[v] = places[v] + share * (neighbours.mean<Vec3d>(places, v, places[v]) - places[v]);
    }
    places.swap(moved);
  }
  Positions result(places.size());
  std::transform(places.begin(), places.end(), result.begin(), [](const Vec3d& place) { return place.cast<float>(); });
  return result;
}

}  // namespace lorica::geometry
