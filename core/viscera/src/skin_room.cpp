#include "lorica/viscera/skin_room.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::viscera {

using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr std::array trunkRegions = {"chest_front", "chest_back", "abdomen_front", "abdomen_back", "pelvis"};

std::vector<Triangle> trunkTriangles(const parenting::Body& body) {
  std::vector<bool> isTrunk;
  for (const std::string& region : body.regions.names) {
    isTrunk.push_back(std::find(trunkRegions.begin(), trunkRegions.end(), region) != trunkRegions.end());
  }
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < body.skin.triangles.size(); ++t) {
    if (isTrunk[body.regions.ofTriangle[t]]) {
      triangles.push_back(body.skin.triangles[t]);
    }
  }
  return triangles;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Directed edges that close the holes of a patch: the reverse of those that no other triangle of it has.
std::vector<Edge> holeEdges(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> uses;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      uses[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  std::vector<Edge> edges;
  for (const auto& [edge, sum] : uses) {
    for (int n = 0; n < std::abs(sum); ++n) {
      edges.push_back(sum > 0 ? Edge{edge.second, edge.first} : edge);
    }
  }
  return edges;
}

/// Edges that hang together, by their vertices, in the order of their first edge.
std::vector<std::vector<Edge>> loopsOf(const std::vector<Edge>& edges) {
  std::map<std::uint32_t, std::uint32_t> parent;
  const auto root = [&](std::uint32_t v) {
    while (parent.try_emplace(v, v).first->second != v) {
      v = parent[v];
    }
    return v;
  };
  for (const auto& [a, b] : edges) {
    parent[root(a)] = root(b);
  }
  std::map<std::uint32_t, std::vector<Edge>> loops;
  for (const Edge& edge : edges) {
    loops[root(edge.first)].push_back(edge);
  }
  std::vector<std::vector<Edge>> result;
  result.reserve(loops.size());
  for (auto& [first, loop] : loops) {
    result.push_back(std::move(loop));
  }
  return result;
}

double sixfold(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return a.dot(b.cross(c));
}

}  // namespace

SkinRoom skinRoom(const parenting::Body& body, std::span<const Vec3f> posedSkin) {
  LORICA_CHECK(posedSkin.size() == body.skin.positions.size(), "one place per vertex of the skin");
  const geometry::Box3d box = geometry::bounds(posedSkin);
  if (box.isEmpty()) {
    return {};
  }
  const Vec3d centre = box.center();
  const auto at = [&](std::uint32_t v) -> Vec3d { return posedSkin[v].cast<double>() - centre; };
  SkinRoom room;
  for (const Triangle& t : body.skin.triangles) {
    room.whole += sixfold(at(t[0]), at(t[1]), at(t[2])) / 6.0;
  }
  const std::vector<Triangle> trunk = trunkTriangles(body);
  for (const Triangle& t : trunk) {
    room.torso += sixfold(at(t[0]), at(t[1]), at(t[2])) / 6.0;
  }
  for (const std::vector<Edge>& loop : loopsOf(holeEdges(trunk))) {
    Vec3d middle = Vec3d::Zero();
    for (const auto& [a, b] : loop) {
      middle += at(a) / static_cast<double>(loop.size());
    }
    for (const auto& [a, b] : loop) {
      room.torso += sixfold(at(a), at(b), middle) / 6.0;
    }
  }
  return room;
}

}  // namespace lorica::viscera
