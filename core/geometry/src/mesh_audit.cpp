#include "lorica/geometry/mesh_audit.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>

#include "lorica/base/error.h"
#include "lorica/base/parallel.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/winding.h"

namespace lorica::geometry {

namespace {

/// Union-find over vertices; the root of a component is its lowest vertex.
class Forest {
 public:
  explicit Forest(const TriangleMesh& mesh) : parent_(mesh.positions.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (const auto [a, b, c] : mesh.triangles) {
      join(a, b);
      join(b, c);
    }
    shorten();
  }
  std::uint32_t rootOf(std::uint32_t vertex) const { return parent_[vertex]; }

 private:
  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    if (parent_[a] == parent_[b]) {
      return;
    }
    const std::uint32_t ra = root(a);
    const std::uint32_t rb = root(b);
    parent_[std::max(ra, rb)] = std::min(ra, rb);
  }
  /// Puts every vertex right below its root: parents are lower, so they stand there already.
  void shorten() {
    for (std::uint32_t& parent : parent_) {
      parent = parent_[parent];
    }
  }

  std::vector<std::uint32_t> parent_;
};

/// Where the sides of all triangles with the same lower vertex stand together: per vertex, the place of its first; one
/// more at the end, and a spare one.
class Buckets {
 public:
  explicit Buckets(const TriangleMesh& mesh) : begin_(mesh.positions.size() + 2, 0) {
    // Counted two places on, so that filling a bucket moves its place to where the next one begins.
    for (const auto [a, b, c] : mesh.triangles) {
      ++begin_[std::min(a, b) + std::size_t{2}];
      ++begin_[std::min(b, c) + std::size_t{2}];
      ++begin_[std::min(c, a) + std::size_t{2}];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  }
  /// Calls `put(place, side, from, to)` for every side, 3 * triangle + k. Once.
  template <class Put>
  void fill(const TriangleMesh& mesh, const Put& put) {
    std::uint32_t* const next = begin_.data() + 1;
    const auto side = [&](std::size_t number, std::uint32_t from, std::uint32_t to) {
      put(next[std::min(from, to)]++, number, from, to);
    };
    std::size_t number = 0;
    for (const auto [a, b, c] : mesh.triangles) {
      side(number, a, b);
      side(number + 1, b, c);
      side(number + 2, c, a);
      number += 3;
    }
  }
  std::size_t vertices() const { return begin_.size() - 2; }
  std::size_t begin(std::size_t vertex) const { return begin_[vertex]; }
  std::size_t size(std::size_t vertex) const { return begin_[vertex + 1] - begin_[vertex]; }

 private:
  std::vector<std::uint32_t> begin_;
};

/// Whether every edge is used twice, once each way: so is any closed surface without flaws, and of such a one nothing
/// else needs to be known. An audit spends its time here, so a side takes four bytes and nothing branches on the data.
bool everyEdgeIsPaired(const TriangleMesh& mesh) {
  if (mesh.positions.size() >= UINT32_MAX / 8) {
    return false;  // a number of a vertex would not leave the bits that are needed
  }
  Buckets buckets(mesh);
  const auto ends = std::make_unique_for_overwrite<std::uint32_t[]>(3 * mesh.triangles.size());
  buckets.fill(mesh, [&](std::size_t place, std::size_t /*side*/, std::uint32_t from, std::uint32_t to) {
    ends[place] = 2 * std::max(from, to) + (from < to ? 1U : 0U);
  });
  // Per higher vertex: the lower one that was met with it last, and the ways (2 bits) in which it was.
  std::vector<std::uint32_t> met(buckets.vertices(), 0);
  std::uint32_t repeated = 0;
  std::uint32_t pairs = 0;
  std::uint32_t place = 0;
  for (std::size_t v = 0; v < buckets.vertices(); ++v) {
    const std::uint32_t mark = (static_cast<std::uint32_t>(v) + 1) * 4;
    for (const auto bucketEnd = static_cast<std::uint32_t>(buckets.begin(v) + buckets.size(v)); place < bucketEnd;
         ++place) {
      const std::uint32_t end = ends[place];
      const std::uint32_t way = 1 + end % 2;
      const std::uint32_t last = met[end / 2] ^ mark;            // below 4 when the same lower vertex was met
      const std::uint32_t before = last & -((last - 4U) >> 31);  // as a product of bits: a branch would be guessed
      const std::uint32_t ways = before | way;
      repeated |= before & way;
      pairs += (ways + 1) / 4;
      met[end / 2] = mark | ways;
    }
  }
  return repeated == 0 && std::size_t{2} * pairs == 3 * mesh.triangles.size();
}

/// The sides of all triangles, those with the same lower vertex together.
class HalfEdges {
 public:
  struct HalfEdge {
    std::uint32_t high;        // the higher vertex
    std::uint32_t sideAndWay;  // odd: from the lower vertex

    HalfEdge() = default;
    HalfEdge(std::uint32_t higher, std::size_t side, bool fromLower)
        : high(higher), sideAndWay(static_cast<std::uint32_t>(2 * side + (fromLower ? 1 : 0))) {}
    std::size_t side() const { return sideAndWay / 2; }  // 3 * triangle + side
    /// What one use adds to the tally of its edge.
    std::int64_t tally() const { return 1 + ((std::int64_t{sideAndWay % 2} * 2 - 1) << 32U); }
  };

  explicit HalfEdges(const TriangleMesh& mesh) : buckets_(mesh), edges_(3 * mesh.triangles.size()) {
    LORICA_CHECK(mesh.triangles.size() < UINT32_MAX / 6, "sides are counted in 31 bits");
    buckets_.fill(mesh, [&](std::size_t place, std::size_t side, std::uint32_t from, std::uint32_t to) {
      edges_[place] = {std::max(from, to), side, from < to};
    });
  }

  /// What the edges say of the surface.
  struct Verdict {
    std::vector<std::size_t> openSides;
    std::size_t boundaryEdges = 0;
    std::size_t oddEdges = 0;
  };

  Verdict judge() const {
    Verdict verdict;
    std::vector<Tally> tallies(buckets_.vertices(), 0);  // of the edges from one lower vertex, per higher vertex
    for (std::size_t v = 0; v < buckets_.vertices(); ++v) {
      const std::span<const HalfEdge> bucket(edges_.data() + buckets_.begin(v), buckets_.size(v));
      for (const HalfEdge& edge : bucket) {
        tallies[edge.high] += edge.tally();
      }
      bool paired = true;
      for (const HalfEdge& edge : bucket) {
        paired = paired && tallies[edge.high] == 2;
      }
      if (!paired) {
        judgeOdd(bucket, tallies, verdict);
      }
      for (const HalfEdge& edge : bucket) {
        tallies[edge.high] = 0;  // so that the next vertex finds nothing
      }
    }
    return verdict;
  }

 private:
  /// Uses of an edge, plus 2^32 times those from its lower vertex less those to it: 2 for an edge of a closed surface.
  using Tally = std::int64_t;

  static void judgeOdd(std::span<const HalfEdge> bucket, std::vector<Tally>& tallies, Verdict& verdict) {
    const auto uses = [](Tally tally) { return static_cast<std::uint32_t>(tally); };
    for (const HalfEdge& edge : bucket) {
      if (tallies[edge.high] != uses(tallies[edge.high])) {
        verdict.openSides.push_back(edge.side());
      }
    }
    for (const HalfEdge& edge : bucket) {
      Tally& tally = tallies[edge.high];
      verdict.boundaryEdges += uses(tally) == 1 ? 1 : 0;
      verdict.oddEdges += (uses(tally) > 2 || (uses(tally) == 2 && tally != 2)) ? 1 : 0;
      tally = 0;  // so that every edge counts once
    }
  }

  Buckets buckets_;
  std::vector<HalfEdge> edges_;
};

/// The closed components that may contain others: their boxes, and their triangles when they are asked for.
class Containers {
 public:
  Containers(const TriangleMesh& mesh, const MeshAudit& audit)
      : mesh_(mesh), audit_(audit), boxes_(audit.components.size()), pieces_(audit.components.size()) {
    begin_.assign(audit.components.size() + 1, 0);
    for (std::size_t c = 0; c < audit.components.size(); ++c) {
      begin_[c + 1] = begin_[c] + audit.components[c].triangles;
    }
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    triangles_.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t component = audit.componentOf[t];
      triangles_[next[component]++] = t;
      for (int k = 0; k < 3; ++k) {
        boxes_[component].extend(mesh.corner(t, k));
      }
    }
  }

  bool contain(std::size_t component) {
    const Vec3d probe = mesh_.corner(triangles_[begin_[component]], 0);
    for (std::size_t other = 0; other < boxes_.size(); ++other) {
      const bool bounds = audit_.components[other].closed && audit_.components[other].signedVolume > 0.0;
      if (other != component && bounds && boxes_[other].contains(probe) && windingNumber(piece(other), probe) > 0.5) {
        return true;
      }
    }
    return false;
  }

 private:
  const TriangleMesh& piece(std::size_t component) {
    TriangleMesh& piece = pieces_[component];
    if (piece.triangles.empty()) {
      for (std::size_t i = begin_[component]; i < begin_[component + 1]; ++i) {
        const auto corner = static_cast<std::uint32_t>(piece.positions.size());
        piece.triangles.push_back({corner, corner + 1, corner + 2});
        for (const std::uint32_t vertex : mesh_.triangles[triangles_[i]]) {
          piece.positions.push_back(mesh_.positions[vertex]);
        }
      }
    }
    return piece;
  }

  const TriangleMesh& mesh_;
  const MeshAudit& audit_;
  std::vector<Box3d> boxes_;
  std::vector<TriangleMesh> pieces_;
  std::vector<std::size_t> begin_;      // per component, into triangles_
  std::vector<std::size_t> triangles_;  // component by component
};

}  // namespace

bool MeshAudit::closed() const {
  return !components.empty() &&
         std::all_of(components.begin(), components.end(), [](const Component& c) { return c.closed; });
}

namespace {

/// Finds the components and measures them.
void measureComponents(const TriangleMesh& mesh, MeshAudit& result) {
  const Forest forest(mesh);
  const Box3d box = bounds(mesh.positions);
  const Vec3d centre = box.isEmpty() ? Vec3d(Vec3d::Zero()) : Vec3d(box.center());
  std::vector<std::uint32_t> componentOfRoot(mesh.positions.size(), UINT32_MAX);
  result.componentOf.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& number = componentOfRoot[forest.rootOf(mesh.triangles[t][0])];
    if (number == UINT32_MAX) {
      number = static_cast<std::uint32_t>(result.components.size());
      result.components.push_back({0, true, 0.0});
    }
    result.componentOf[t] = number;
    Component& component = result.components[number];
    ++component.triangles;
    const Vec3d a = mesh.corner(t, 0) - centre;
    const Vec3d b = mesh.corner(t, 1) - centre;
    const Vec3d c = mesh.corner(t, 2) - centre;
    const Vec3d normal = (b - a).cross(c - a);
    component.signedVolume += a.dot(normal) / 6.0;
    result.degenerateTriangles += normal.squaredNorm() == 0.0 ? 1 : 0;
  }
}

}  // namespace

MeshAudit audit(const TriangleMesh& mesh) {
  MeshAudit result;
  result.openEdge.assign(mesh.triangles.size() * 3, false);
  HalfEdges::Verdict edges;
  constexpr std::size_t tooSmallToShare = 4096;
  base::parallelFor(2, mesh.triangles.size() < tooSmallToShare ? 2 : 1, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      if (task == 0) {
        measureComponents(mesh, result);
      } else if (!everyEdgeIsPaired(mesh)) {
        edges = HalfEdges(mesh).judge();
      }
    }
  });
  result.boundaryEdges = edges.boundaryEdges;
  result.oddEdges = edges.oddEdges;
  for (const std::size_t side : edges.openSides) {
    result.openEdge[side] = true;
    result.components[result.componentOf[side / 3]].closed = false;
  }
  return result;
}

std::size_t turnInsideOutComponents(TriangleMesh& mesh, MeshAudit& audit) {
  const auto isInsideOut = [](const Component& c) { return c.closed && c.signedVolume < 0.0; };
  if (std::none_of(audit.components.begin(), audit.components.end(), isInsideOut)) {
    return 0;
  }
  Containers containers(mesh, audit);
  std::vector<bool> turn(audit.components.size(), false);
  for (std::size_t c = 0; c < audit.components.size(); ++c) {
    turn[c] = isInsideOut(audit.components[c]) && !containers.contain(c);
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
