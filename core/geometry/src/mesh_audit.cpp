#include "lorica/geometry/mesh_audit.h"

#include <algorithm>
#include <numeric>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/winding.h"

namespace lorica::geometry {

namespace {

/// Union-find over vertices.
class Forest {
 public:
  explicit Forest(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ra = root(a);
    const std::uint32_t rb = root(b);
    parent_[std::max(ra, rb)] = std::min(ra, rb);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct HalfEdge {
  std::uint64_t key;   // low vertex in the high word, high vertex in the low word
  std::uint32_t side;  // 3 * triangle + side
  bool forward;        // from the low vertex to the high one
};

std::vector<HalfEdge> sortedHalfEdges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[t][k];
      const std::uint32_t to = mesh.triangles[t][(k + 1) % 3];
      const std::uint64_t key = (std::uint64_t{std::min(from, to)} << 32U) | std::max(from, to);
      edges.push_back({key, static_cast<std::uint32_t>(3 * t + k), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.key != b.key ? a.key < b.key : a.side < b.side; });
  return edges;
}

/// The triangles of one component as a mesh that shares the vertex array's numbering.
TriangleMesh componentMesh(const TriangleMesh& mesh, const MeshAudit& audit, std::uint32_t component) {
  TriangleMesh piece;
  std::vector<std::uint32_t> newIndex(mesh.positions.size(), UINT32_MAX);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (audit.componentOf[t] != component) {
      continue;
    }
    Triangle moved{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& index = newIndex[mesh.triangles[t][k]];
      if (index == UINT32_MAX) {
        index = static_cast<std::uint32_t>(piece.positions.size());
        piece.positions.push_back(mesh.positions[mesh.triangles[t][k]]);
      }
      moved[k] = index;
    }
    piece.triangles.push_back(moved);
  }
  return piece;
}

}  // namespace

bool MeshAudit::closed() const {
  return !components.empty() &&
         std::all_of(components.begin(), components.end(), [](const Component& c) { return c.closed; });
}

MeshAudit audit(const TriangleMesh& mesh) {
  MeshAudit result;
  result.openEdge.assign(mesh.triangles.size() * 3, false);

  Forest forest(mesh.positions.size());
  for (const Triangle& triangle : mesh.triangles) {
    forest.join(triangle[0], triangle[1]);
    forest.join(triangle[1], triangle[2]);
  }
  std::vector<std::uint32_t> componentOfRoot(mesh.positions.size(), UINT32_MAX);
  result.componentOf.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& component = componentOfRoot[forest.root(mesh.triangles[t][0])];
    if (component == UINT32_MAX) {
      component = static_cast<std::uint32_t>(result.components.size());
      result.components.push_back({0, true, 0.0});
    }
    result.componentOf[t] = component;
    ++result.components[component].triangles;
  }

  const std::vector<HalfEdge> edges = sortedHalfEdges(mesh);
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    std::ptrdiff_t balance = 0;
    while (end < edges.size() && edges[end].key == edges[begin].key) {
      balance += edges[end].forward ? 1 : -1;
      ++end;
    }
    const std::size_t uses = end - begin;
    result.boundaryEdges += uses == 1 ? 1 : 0;
    result.oddEdges += (uses > 2 || (uses == 2 && balance != 0)) ? 1 : 0;
    if (balance != 0) {
      for (std::size_t e = begin; e < end; ++e) {
        result.openEdge[edges[e].side] = true;
        result.components[result.componentOf[edges[e].side / 3]].closed = false;
      }
    }
    begin = end;
  }

  const Box3d box = bounds(mesh.positions);
  const Vec3d centre = box.isEmpty() ? Vec3d(Vec3d::Zero()) : Vec3d(box.center());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0) - centre;
    const Vec3d b = mesh.corner(t, 1) - centre;
    const Vec3d c = mesh.corner(t, 2) - centre;
    result.components[result.componentOf[t]].signedVolume += a.dot(b.cross(c)) / 6.0;
    result.degenerateTriangles += (b - a).cross(c - a).squaredNorm() == 0.0 ? 1 : 0;
  }
  return result;
}

std::size_t turnInsideOutComponents(TriangleMesh& mesh, MeshAudit& audit) {
  std::vector<std::uint32_t> firstTriangle(audit.components.size(), UINT32_MAX);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    firstTriangle[audit.componentOf[t]] = static_cast<std::uint32_t>(t);
  }
  std::vector<TriangleMesh> pieces(audit.components.size());
  const auto isInsideAnother = [&](std::uint32_t component) {
    const Vec3d probe = mesh.corner(firstTriangle[component], 0);
    for (std::uint32_t other = 0; other < audit.components.size(); ++other) {
      if (other == component || !audit.components[other].closed || audit.components[other].signedVolume <= 0.0) {
        continue;
      }
      if (pieces[other].triangles.empty()) {
        pieces[other] = componentMesh(mesh, audit, other);
      }
      if (bounds(pieces[other].positions).contains(probe) && windingNumber(pieces[other], probe) > 0.5) {
        return true;
      }
    }
    return false;
  };
  std::vector<bool> turn(audit.components.size(), false);
  for (std::uint32_t c = 0; c < audit.components.size(); ++c) {
    turn[c] = audit.components[c].closed && audit.components[c].signedVolume < 0.0 && !isInsideAnother(c);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (turn[audit.componentOf[t]]) {
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      // Sides are renumbered by the swap: (0,1) (1,2) (2,0) become (0,2) (2,1) (1,0).
      const bool side0 = audit.openEdge[3 * t];
      audit.openEdge[3 * t] = audit.openEdge[3 * t + 2];
      audit.openEdge[3 * t + 2] = side0;
    }
  }
  for (std::size_t c = 0; c < turn.size(); ++c) {
    audit.components[c].signedVolume *= turn[c] ? -1.0 : 1.0;
  }
  return static_cast<std::size_t>(std::count(turn.begin(), turn.end(), true));
}

}  // namespace lorica::geometry
