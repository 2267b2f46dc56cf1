#include "lorica/geometry/remesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "lorica/base/error.h"

namespace lorica::geometry {

namespace {

using Id = std::uint32_t;
constexpr Id kNone = 0xFFFFFFFF;

/// Half-edges of a closed mesh. Half-edges 3f, 3f + 1, 3f + 2 belong to face f in order; removed faces have kNone in
/// their `to`.
class HalfEdgeMesh {
 public:
  explicit HalfEdgeMesh(const TriangleMesh& mesh);

  std::vector<Vec3d> points;
  std::vector<Id> out;   ///< of a vertex: one half-edge that leaves it; kNone when the vertex is gone
  std::vector<Id> to;    ///< of a half-edge: the vertex it points to
  std::vector<Id> twin;  ///< of a half-edge

  static Id next(Id h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Id previous(Id h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Id from(Id h) const { return to[previous(h)]; }
  Id apex(Id h) const { return to[next(h)]; }
  bool alive(Id h) const { return to[h] != kNone; }
  double length(Id h) const { return (points[to[h]] - points[from(h)]).norm(); }
  Vec3d middle(Id h) const { return 0.5 * (points[to[h]] + points[from(h)]); }

  /// Calls `use(h)` for every half-edge that leaves a vertex, in fan order.
  template <class Use>
  void around(Id vertex, Use use) const {
    const Id first = out[vertex];
    Id h = first;
    do {
      use(h);
      h = twin[previous(h)];
    } while (h != first);
  }
  std::size_t valence(Id vertex) const {
    std::size_t count = 0;
    around(vertex, [&](Id) { ++count; });
    return count;
  }
  bool joined(Id a, Id b) const {
    bool found = false;
    around(a, [&](Id h) { found = found || to[h] == b; });
    return found;
  }
  Vec3d faceNormal(Id face) const {
    const Vec3d& a = points[to[3 * face]];
    return (points[to[3 * face + 1]] - a).cross(points[to[3 * face + 2]] - a);
  }

  void split(Id h, const Vec3d& place);
  bool mayCollapse(Id h, const Vec3d& place, double longest) const;
  void collapse(Id h, const Vec3d& place);
  bool mayFlip(Id h) const;
  void flip(Id h);
  TriangleMesh triangles() const;

 private:
  void link(Id a, Id b) {
    twin[a] = b;
    twin[b] = a;
  }
};

HalfEdgeMesh::HalfEdgeMesh(const TriangleMesh& mesh) {
  points.reserve(mesh.positions.size());
  for (const Vec3f& p : mesh.positions) {
    points.emplace_back(p.cast<double>());
  }
  out.assign(points.size(), kNone);
  to.resize(3 * mesh.triangles.size());
  twin.assign(to.size(), kNone);
  std::unordered_map<std::uint64_t, Id> open;
  open.reserve(to.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto h = static_cast<Id>(3 * t + k);
      const std::uint64_t start = mesh.triangles[t][k];
      const std::uint64_t end = mesh.triangles[t][(k + 1) % 3];
      to[h] = static_cast<Id>(end);
      out[start] = h;
      if (const auto other = open.find(end << 32U | start); other != open.end()) {
        link(h, other->second);
        open.erase(other);
      } else {
        LORICA_CHECK(open.emplace(start << 32U | end, h).second, "an edge has two triangles");
      }
    }
  }
  LORICA_CHECK(open.empty(), "the mesh is closed");
}

void HalfEdgeMesh::split(Id h, const Vec3d& place) {
  // h runs a -> b with apex c; its twin b -> a with apex d. The new vertex m gets two new faces (m, b, c), (m, a, d)
  // ... whose third sides are the old outer ones.
  const Id g = twin[h];
  const Id b = to[h];
  const Id a = to[g];
  const Id c = apex(h);
  const Id d = apex(g);
  const Id bc = next(h);
  const Id ad = next(g);
  const Id bcTwin = twin[bc];
  const Id adTwin = twin[ad];
  const auto m = static_cast<Id>(points.size());
  points.emplace_back(place);
  const auto h1 = static_cast<Id>(to.size());  // m -> b, b -> c, c -> m
  const Id g1 = h1 + 3;                        // m -> a, a -> d, d -> m
  to.insert(to.end(), {b, c, m, a, d, m});
  twin.resize(to.size());
  to[h] = m;   // a -> m -> c
  to[g] = m;   // b -> m -> d
  to[bc] = c;  // m -> c
  to[ad] = d;  // m -> d
  link(h1 + 1, bcTwin);
  link(g1 + 1, adTwin);
  link(bc, h1 + 2);
  link(ad, g1 + 2);
  link(h, g1);
  link(g, h1);
  out.push_back(h1);
  out[b] = h1 + 1;
  out[a] = g1 + 1;
  out[c] = h1 + 2;
  out[d] = g1 + 2;
}

bool HalfEdgeMesh::mayCollapse(Id h, const Vec3d& place, double longest) const {
  const Id a = from(h);
  const Id b = to[h];
  // The two ends may have two neighbours in common only, else the surface would pinch.
  std::size_t common = 0;
  around(a, [&](Id e) {
    if (to[e] != b && joined(to[e], b)) {
      ++common;
    }
  });
  if (common != 2 || valence(apex(h)) < 4 || valence(apex(twin[h])) < 4) {
    return false;
  }
  bool fine = true;
  for (const Id end : {a, b}) {
    around(end, [&](Id e) {
      if (!fine || to[e] == a || to[e] == b) {
        return;
      }
      if ((points[to[e]] - place).norm() > longest) {
        fine = false;
        return;
      }
      const Id third = to[next(e)];
      if (third == a || third == b) {
        return;
      }
      // No triangle may turn over, nor become a sliver.
      const Vec3d before = (points[to[e]] - points[end]).cross(points[third] - points[end]);
      const Vec3d u = points[to[e]] - place;
      const Vec3d v = points[third] - place;
      const Vec3d after = u.cross(v);
      const double longestSide = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
      fine = after.dot(before) > 0.5 * after.norm() * before.norm() && after.norm() > 0.1 * longestSide;
    });
  }
  return fine;
}

void HalfEdgeMesh::collapse(Id h, const Vec3d& place) {
  const Id g = twin[h];
  const Id a = from(h);
  const Id b = to[h];
  const Id c = apex(h);
  const Id d = apex(g);
  const Id bcTwin = twin[next(h)];
  const Id caTwin = twin[previous(h)];
  const Id adTwin = twin[next(g)];
  const Id dbTwin = twin[previous(g)];
  std::vector<Id> incoming;
  around(a, [&](Id e) { incoming.push_back(twin[e]); });
  for (const Id e : incoming) {
    to[e] = b;
  }
  points[b] = place;
  for (const Id face : {h / 3, g / 3}) {
    for (Id k = 0; k < 3; ++k) {
      to[3 * face + k] = kNone;
    }
  }
  link(bcTwin, caTwin);
  link(adTwin, dbTwin);
  out[a] = kNone;
  out[b] = caTwin;
  out[c] = bcTwin;
  out[d] = adTwin;
}

bool HalfEdgeMesh::mayFlip(Id h) const {
  const Id c = apex(h);
  const Id d = apex(twin[h]);
  const Id a = from(h);
  const Id b = to[h];
  if (c == d || valence(a) < 4 || valence(b) < 4 || joined(c, d)) {
    return false;
  }
  const Vec3d n1 = faceNormal(h / 3);
  const Vec3d n2 = faceNormal(twin[h] / 3);
  // Creases stay, and both new triangles face as the old ones do.
  if (n1.dot(n2) < 0.7 * n1.norm() * n2.norm()) {
    return false;
  }
  const Vec3d middle = n1 + n2;
  const Vec3d new1 = (points[d] - points[c]).cross(points[b] - points[c]);
  const Vec3d new2 = (points[a] - points[c]).cross(points[d] - points[c]);
  return new1.dot(middle) > 0.3 * new1.norm() * middle.norm() && new2.dot(middle) > 0.3 * new2.norm() * middle.norm();
}

void HalfEdgeMesh::flip(Id h) {
  // Faces (a, b, c) and (b, a, d) become (d, c, a) and (c, d, b).
  const Id g = twin[h];
  const Id b = to[h];
  const Id a = to[g];
  const Id c = apex(h);
  const Id d = apex(g);
  const Id bcTwin = twin[next(h)];
  const Id caTwin = twin[previous(h)];
  const Id adTwin = twin[next(g)];
  const Id dbTwin = twin[previous(g)];
  const Id h1 = next(h);
  const Id h2 = previous(h);
  const Id g1 = next(g);
  const Id g2 = previous(g);
  to[h] = c;  // d -> c -> a -> d
  to[h1] = a;
  to[h2] = d;
  to[g] = d;  // c -> d -> b -> c
  to[g1] = b;
  to[g2] = c;
  link(h1, caTwin);
  link(h2, adTwin);
  link(g1, dbTwin);
  link(g2, bcTwin);
  out[d] = h;
  out[c] = g;
  out[a] = h2;
  out[b] = g2;
}

TriangleMesh HalfEdgeMesh::triangles() const {
  TriangleMesh mesh;
  std::vector<Id> renamed(points.size(), kNone);
  for (Id face = 0; face < to.size() / 3; ++face) {
    if (!alive(3 * face)) {
      continue;
    }
    Triangle triangle{};
    for (Id k = 0; k < 3; ++k) {
      // Half-edge k runs from corner k to corner k + 1.
      const Id vertex = from(3 * face + k);
      if (renamed[vertex] == kNone) {
        renamed[vertex] = static_cast<Id>(mesh.positions.size());
        mesh.positions.push_back(points[vertex].cast<float>());
      }
      triangle[k] = renamed[vertex];
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh, const RemeshOptions& options) : mesh_(mesh), options_(options) {}

  TriangleMesh run() {
    for (int round = 0; round < options_.rounds; ++round) {
      splitLong();
      collapseShort();
      const bool last = round + 1 == options_.rounds;
      evenOutValences();
      relax();
      relax();
      flipByAngles();
      if (last) {
        relax();
        flipByAngles();
      }
    }
    return mesh_.triangles();
  }

 private:
  static constexpr double kLong = 4.0 / 3.0;
  static constexpr double kShort = 4.0 / 5.0;

  /// Wanted length at an edge: the finer of its ends, lest a coarse neighbour eat a fine place.
  double wanted(Id h) const {
    return std::min(options_.edgeLength(mesh_.points[mesh_.to[h]]), options_.edgeLength(mesh_.points[mesh_.from(h)]));
  }

  /// Longest first, and back to good triangles after each pass: a half-length edge is not worth a sliver.
  void splitLong() {
    for (int pass = 0; pass < 8; ++pass) {
      std::vector<std::pair<double, Id>> tooLong;
      for (Id h = 0; h < mesh_.to.size(); ++h) {
        if (mesh_.alive(h) && h < mesh_.twin[h]) {
          const double ratio = mesh_.length(h) / wanted(h);
          if (ratio > kLong) {
            tooLong.emplace_back(-ratio, h);
          }
        }
      }
      if (tooLong.empty()) {
        return;
      }
      std::sort(tooLong.begin(), tooLong.end());
      for (const auto& [ratio, h] : tooLong) {
        // An earlier split may have shortened it.
        if (mesh_.length(h) > kLong * wanted(h)) {
          mesh_.split(h, options_.project(mesh_.middle(h)));
        }
      }
      flipByAngles();
    }
  }

  void collapseShort() {
    const auto count = static_cast<Id>(mesh_.to.size());
    for (Id h = 0; h < count; ++h) {
      if (!mesh_.alive(h) || h > mesh_.twin[h]) {
        continue;
      }
      const double target = wanted(h);
      if (mesh_.length(h) >= kShort * target) {
        continue;
      }
      const Vec3d place = options_.project(mesh_.middle(h));
      if (mesh_.mayCollapse(h, place, kLong * target)) {
        mesh_.collapse(h, place);
      }
    }
  }

  void evenOutValences() {
    const auto off = [&](Id vertex, int change) {
      const int valence = static_cast<int>(mesh_.valence(vertex)) + change - 6;
      return valence * valence;
    };
    for (Id h = 0; h < mesh_.to.size(); ++h) {
      if (!mesh_.alive(h) || h > mesh_.twin[h] || !mesh_.mayFlip(h)) {
        continue;
      }
      const Id a = mesh_.from(h);
      const Id b = mesh_.to[h];
      const Id c = mesh_.apex(h);
      const Id d = mesh_.apex(mesh_.twin[h]);
      if (off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) < off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0)) {
        mesh_.flip(h);
      }
    }
  }

  double angleAt(Id h) const {
    // Opposite to the edge h, in its face.
    const Vec3d& apex = mesh_.points[mesh_.apex(h)];
    const Vec3d u = mesh_.points[mesh_.from(h)] - apex;
    const Vec3d v = mesh_.points[mesh_.to[h]] - apex;
    return std::atan2(u.cross(v).norm(), u.dot(v));
  }

  /// Delaunay: an edge goes when the two angles opposite to it sum to more than half a turn.
  void flipByAngles() {
    for (int pass = 0; pass < 3; ++pass) {
      for (Id h = 0; h < mesh_.to.size(); ++h) {
        if (mesh_.alive(h) && h < mesh_.twin[h] && angleAt(h) + angleAt(mesh_.twin[h]) > 3.2 && mesh_.mayFlip(h)) {
          mesh_.flip(h);
        }
      }
    }
  }

  /// Every vertex moves within the surface towards the middle of its neighbours, those of wide places weighing less.
  void relax() {
    std::vector<Vec3d> moved(mesh_.points.size());
    base::parallelFor(mesh_.points.size(), 256, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto vertex = static_cast<Id>(v);
        if (mesh_.out[vertex] == kNone) {
          continue;
        }
        Vec3d sum = Vec3d::Zero();
        Vec3d normal = Vec3d::Zero();
        double weights = 0.0;
        const Vec3d here = mesh_.points[v];
        mesh_.around(vertex, [&](Id h) {
          const Vec3d faceNormal = mesh_.faceNormal(h / 3);
          const Vec3d middle = (here + mesh_.points[mesh_.to[h]] + mesh_.points[mesh_.to[HalfEdgeMesh::next(h)]]) / 3.0;
          const double length = options_.edgeLength(middle);
          const double weight = faceNormal.norm() / (length * length);
          sum += weight * middle;
          weights += weight;
          normal += faceNormal;
        });
        if (weights <= 0.0 || normal.norm() <= 0.0) {
          moved[v] = here;
          continue;
        }
        normal.normalize();
        Vec3d step = sum / weights - here;
        step -= normal.dot(step) * normal;
        moved[v] = options_.project(here + step);
      }
    });
    mesh_.points = std::move(moved);
  }

  HalfEdgeMesh mesh_;
  const RemeshOptions& options_;
};

}  // namespace

TriangleMesh remeshed(const TriangleMesh& mesh, const RemeshOptions& options) {
  LORICA_CHECK(options.edgeLength && options.project, "a wanted length and a surface");
  return Remesher(mesh, options).run();
}

}  // namespace lorica::geometry
