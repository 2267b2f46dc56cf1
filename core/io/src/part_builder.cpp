#include "part_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lorica/base/parallel.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/geometry/weld.h"

namespace lorica::io {

using geometry::Positions;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;
using human::SkinWeights;

namespace {

constexpr double weldedWeights = 1e-3;  // sum of differences up to which two vertices have the same weights

/// Removes the vertices that no triangle uses; the old index of each one that stays, or nothing when all stay.
std::optional<std::vector<std::uint32_t>> removeUnusedVertices(TriangleMesh& mesh) {
  std::vector<char> used(mesh.positions.size(), 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      used[vertex] = 1;
    }
  }
  if (std::find(used.begin(), used.end(), 0) == used.end()) {
    return std::nullopt;
  }
  std::vector<std::uint32_t> newIndex(used.size(), 0);
  std::vector<std::uint32_t> kept;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] != 0) {
      newIndex[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(static_cast<std::uint32_t>(v));
    }
  }
  Positions positions;
  positions.reserve(kept.size());
  for (const std::uint32_t vertex : kept) {
    positions.push_back(mesh.positions[vertex]);
  }
  mesh.positions = std::move(positions);
  for (Triangle& triangle : mesh.triangles) {
    triangle = {newIndex[triangle[0]], newIndex[triangle[1]], newIndex[triangle[2]]};
  }
  return kept;
}

/// The rows of `values`, `width` long, that belong to the kept vertices.
template <class T>
std::vector<T> rows(const std::vector<T>& values, std::size_t width, const std::vector<std::uint32_t>& kept) {
  std::vector<T> result;
  result.reserve(kept.size() * width);
  for (const std::uint32_t vertex : kept) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(vertex * width);
    result.insert(result.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

void keepRows(SkinWeights& weights, const std::vector<std::uint32_t>& kept) {
  weights.joints = rows(weights.joints, weights.influences, kept);
  weights.weights = rows(weights.weights, weights.influences, kept);
}

double weightDifference(const SkinWeights& weights, std::size_t a, std::size_t b) {
  const std::size_t n = weights.influences;
  double sum = 0.0;
  double shared = 0.0;  // weight of b on joints of a
  for (std::size_t i = a * n; i < (a + 1) * n && weights.weights[i] > 0.0F; ++i) {
    double other = 0.0;
    for (std::size_t k = b * n; k < (b + 1) * n && weights.weights[k] > 0.0F; ++k) {
      other += weights.joints[k] == weights.joints[i] ? static_cast<double>(weights.weights[k]) : 0.0;
    }
    sum += std::abs(static_cast<double>(weights.weights[i]) - other);
    shared += other;
  }
  return sum + std::max(0.0, 1.0 - shared);
}

/// Vertices at one position get the same number when their weights agree.
std::vector<std::uint32_t> weightGroups(const Positions& positions, const SkinWeights& weights) {
  constexpr std::size_t compared = 64;  // bounds the work when a file has thousands of vertices at one place
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3f& p = positions[a];
    const Vec3f& q = positions[b];
    return std::tuple(p.x(), p.y(), p.z(), a) < std::tuple(q.x(), q.y(), q.z(), b);
  });
  std::vector<std::uint32_t> group(positions.size(), 0);
  std::vector<std::uint32_t> firstOfGroup;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t vertex = order[i];
    if (i == 0 || positions[order[i - 1]] != positions[vertex]) {
      firstOfGroup.clear();
    }
    std::size_t g = firstOfGroup.size() > compared ? firstOfGroup.size() - compared : 0;
    while (g < firstOfGroup.size() && weightDifference(weights, firstOfGroup[g], vertex) > weldedWeights) {
      ++g;
    }
    if (g == firstOfGroup.size()) {
      firstOfGroup.push_back(vertex);
    }
    group[vertex] = static_cast<std::uint32_t>(g);
  }
  return group;
}

SkinWeights normalised(const RawPart& raw, const std::vector<human::Influence>& used,
                       const std::vector<std::uint32_t>& sourceOf, const std::string& name, Reading& reading) {
  human::NormalisedWeights result = human::normaliseWeights(used, raw.influences);
  if (result.unweightedVertices > 0) {
    const std::size_t vertex = sourceOf.empty() ? result.firstUnweighted : sourceOf[result.firstUnweighted];
    reading.fail(name,
                 fmt::format("vertex {} has weights that sum to zero; every vertex of a skin needs a joint", vertex));
  }
  if (result.unnormalisedVertices > 0) {
    reading.warn(name, fmt::format("the weights of {} vertices did not sum to 1 and were normalised over all {} places",
                                   result.unnormalisedVertices, raw.influences));
  }
  if (result.truncatedVertices > 0) {
    reading.note(name, fmt::format("{} vertices follow more than {} joints; the strongest were kept",
                                   result.truncatedVertices, result.weights.influences));
  }
  return std::move(result.weights);
}

TriangleMesh floatMesh(RawPart& raw, const std::string& name, const Reading& reading) {
  TriangleMesh mesh;
  mesh.triangles = std::move(raw.triangles);
  mesh.positions.reserve(raw.positions.size());
  for (const Vec3d& position : raw.positions) {
    mesh.positions.push_back(position.cast<float>());
    if (!mesh.positions.back().allFinite()) {
      reading.fail(name, fmt::format("vertex {} is further away than a number can say; check the units",
                                     mesh.positions.size() - 1));
    }
  }
  return mesh;
}

bool hasArea(const TriangleMesh& mesh, std::size_t t) {
  const Vec3d a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).squaredNorm() > 0.0;
}

/// Drops triangles without area from open components; in closed ones they carry the neighbourhood of their edges.
std::size_t dropThinTriangles(TriangleMesh& mesh, const geometry::MeshAudit& audit) {
  std::vector<Triangle> kept;
  kept.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (audit.components[audit.componentOf[t]].closed || hasArea(mesh, t)) {
      kept.push_back(mesh.triangles[t]);
    }
  }
  std::swap(kept, mesh.triangles);
  return kept.size() - mesh.triangles.size();
}

/// Cleans and turns the surface; how many triangles without area it had, those counted in that collapsed before.
std::size_t orient(Part& part, std::size_t collapsed, Reading& reading) {
  geometry::MeshAudit audit = geometry::audit(part.mesh);
  std::size_t thin = 0;
  if (audit.degenerateTriangles > 0) {
    thin = dropThinTriangles(part.mesh, audit);
    if (thin > 0) {
      audit = geometry::audit(part.mesh);
    }
    if (audit.degenerateTriangles > 0) {
      reading.note(part.name, fmt::format("{} triangles without area were kept: they join closed surfaces",
                                          audit.degenerateTriangles));
    }
  }
  if (collapsed + thin > 0) {
    reading.note(part.name, fmt::format("{} triangles without area were dropped", collapsed + thin));
  }
  const std::size_t turned = geometry::turnInsideOutComponents(part.mesh, audit);
  if (turned > 0) {
    reading.note(part.name, fmt::format("{} closed surfaces were inside out and have been turned", turned));
  }
  return collapsed + thin;
}

}  // namespace

std::optional<Part> buildPart(RawPart raw, const std::string& name, Reading& reading) {
  Part part;
  part.name = name;
  part.protects = raw.protects;
  TriangleMesh mesh = floatMesh(raw, name, reading);
  const auto used = removeUnusedVertices(mesh);
  const std::size_t vertices = mesh.positions.size();
  // Weights may keep vertices apart that were welded, which is known only then.
  const TriangleMesh unwelded = raw.influences > 0 ? mesh : TriangleMesh();
  geometry::Welded welded = geometry::weld(std::move(mesh));
  const auto readWeights = [&](Reading& issues) {
    part.weights = used ? normalised(raw, rows(raw.weights, raw.influences, *used), *used, name, issues)
                        : normalised(raw, raw.weights, {}, name, issues);
  };
  std::size_t dropped = 0;
  if (raw.influences > 0 && welded.sourceOf.size() == vertices) {
    // Nothing to weld, as in most skins: the weights do not bear on the surface.
    Reading ofWeights = reading.branch();
    Reading ofSurface = reading.branch();
    part.mesh = std::move(welded.mesh);
    base::parallelFor(2, 1, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t task = begin; task < end; ++task) {
        if (task == 0) {
          readWeights(ofWeights);
        } else {
          dropped = orient(part, welded.droppedTriangles, ofSurface);
        }
      }
    });
    reading.join(std::move(ofWeights));
    reading.join(std::move(ofSurface));
  } else {
    if (raw.influences > 0) {
      readWeights(reading);
      welded = geometry::weld(unwelded, weightGroups(unwelded.positions, *part.weights));
      keepRows(*part.weights, welded.sourceOf);
    }
    part.mesh = std::move(welded.mesh);
    dropped = orient(part, welded.droppedTriangles, reading);
  }
  if (part.mesh.triangles.empty()) {
    reading.note(name, "has no triangles with area and was left out");
    return std::nullopt;
  }
  if (dropped > 0) {
    if (const auto kept = removeUnusedVertices(part.mesh); kept && part.weights) {
      keepRows(*part.weights, *kept);
    }
  }
  return part;
}

}  // namespace lorica::io
