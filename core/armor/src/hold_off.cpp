#include "hold_off.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lorica/geometry/sides.h"

namespace lorica::armor {

using geometry::Triangle;
using geometry::Vec3f;

namespace {

// What has sunk further than this has not been pressed: the skin has folded beneath it, and the further the less its
// triangles say where outside is.
constexpr float kSunk = 0.006F;  // m

// Other skin than the foot's may come so near, and what it has to be lifted further off than this lies in a crease.
constexpr float kBeside = 0.0018F;   // m
constexpr float kCreased = 0.0025F;  // m
constexpr float kSameWay = 0.5F;     // cosine to the foot's normal of skin that lifts

// Only of vertices that lie nearer at rest is the skin about their feet looked at: what lies over other layers has them
// between itself and the skin.
constexpr float kNear = 0.008F;  // m

// How many triangles away from its foot a vertex may find itself.
constexpr int kRings = 4;

// The skin about a foot is felt for in one of so many of its triangles.
constexpr std::uint32_t kFelt = 3;

// A triangle over each edge of each triangle, from each corner to the next.
constexpr std::uint32_t kNone = UINT32_MAX;
using Across = std::array<std::uint32_t, 3>;

std::vector<Across> trianglesAcross(std::span<const Triangle> triangles) {
  const std::vector<geometry::TriangleSide> sides = geometry::sidesByEdge(triangles);
  std::vector<Across> across(triangles.size(), {kNone, kNone, kNone});
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const geometry::TriangleSide& a = sides[i];
    const geometry::TriangleSide& b = sides[i + 1];
    if (a.sameEdge(b)) {
      across[a.triangle][a.corner] = b.triangle;
      across[b.triangle][b.corner] = a.triangle;
    }
  }
  return across;
}

/// A way off the skin.
struct Lift {
  float height = 0.0F;  ///< of the vertex over the plane of the triangle under it, m
  Vec3f normal = Vec3f::Zero();
};

Lift liftOver(const Triangle& corners, const Vec3f& p, std::span<const Vec3f> skin) {
  const Vec3f& a = skin[corners[0]];
  const Vec3f normal = (skin[corners[1]] - a).cross(skin[corners[2]] - a).normalized();
  return {normal.dot(p - a), normal};
}

/// Whether a point lies over a triangle, or not far beside it.
bool isOver(const Triangle& corners, const Lift& lift, const Vec3f& p, std::span<const Vec3f> skin) {
  constexpr float beside = 0.001F;  // m
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f& a = skin[corners[k]];
    const Vec3f edge = skin[corners[(k + 1) % 3]] - a;
    if (lift.normal.cross(edge).dot(p - a) < -beside * edge.norm()) {
      return false;
    }
  }
  return true;
}

/// Whether the skin about a foot rises towards a vertex, as in a crease.
bool skinRises(const PieceRig& piece, const SkinFoot& foot, const Lift& own, std::span<const Vec3f> skin) {
  constexpr float near = 0.0025F;  // m below the vertex
  const Vec3f& a = skin[foot.corners[0]];
  for (std::size_t i = foot.feltFirst; i < foot.feltBehind; ++i) {
    if (own.normal.dot(skin[piece.felt[i]] - a) > own.height - near) {
      return true;
    }
  }
  return false;
}

/// Whether a triangle may lift a point by more than it is lifted already. Says no only where that is sure, for less
/// than liftOver() takes.
bool mayLift(const Triangle& corners, const Vec3f& p, std::span<const Vec3f> skin, float most) {
  constexpr float rounding = 1.001F;
  const Vec3f& a = skin[corners[0]];
  const Vec3f normal = (skin[corners[1]] - a).cross(skin[corners[2]] - a);
  const float along = normal.dot(p - a);
  const float highest = kBeside - most;
  const float lowest = kBeside - 2.0F * kCreased + most;
  const float bound = along > 0.0F ? std::max(highest, 0.0F) : std::min(lowest, 0.0F);
  return along * along <= rounding * bound * bound * normal.squaredNorm();
}

/// What takes a vertex as far off the skin as it should be.
Vec3f neededLift(const PieceRig& piece, const SkinFoot& foot, const Vec3f& p, std::span<const Vec3f> skin) {
  const Lift own = liftOver(foot.corners, p, skin);
  const float missing = foot.least - own.height;
  Vec3f needed = Vec3f::Zero();
  if (missing > 0.0F && missing < 2.0F * kSunk) {
    needed = std::min(missing, 2.0F * kSunk - missing) * own.normal;
  }
  if (!skinRises(piece, foot, own, skin)) {
    return needed;
  }
  float most = needed.norm();
  for (std::size_t t = foot.aboutFirst; t < foot.aboutBehind; ++t) {
    if (!mayLift(piece.about[t], p, skin, most)) {
      continue;
    }
    const Lift lift = liftOver(piece.about[t], p, skin);
    const float lacking = kBeside - lift.height;
    const float by = std::min(lacking, 2.0F * kCreased - lacking);
    if (by > most && lift.normal.dot(own.normal) > kSameWay && isOver(piece.about[t], lift, p, skin)) {
      needed = by * lift.normal;
      most = by;
    }
  }
  return needed;
}

std::vector<Vec3f> neededLifts(const PieceRig& piece, std::span<const Vec3f> skin, std::span<const Vec3f> posed,
                               base::Threads threads) {
  std::vector<Vec3f> lifts(posed.size(), Vec3f::Zero());
  base::parallelFor(posed.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (piece.feet[v].least != kAnyHeight) {
        lifts[v] = neededLift(piece, piece.feet[v], posed[v], skin);
      }
    }
  });
  return lifts;
}

/// Adds the neighbours of some vertices to them. \param known whether a vertex is among them
void growByRing(const geometry::SurfaceNeighbours& around, std::vector<std::uint32_t>& vertices,
                std::vector<char>& known) {
  for (std::size_t i = 0, inner = vertices.size(); i < inner; ++i) {
    for (std::size_t e = around.first[vertices[i]]; e < around.first[vertices[i] + 1]; ++e) {
      const std::uint32_t next = around.vertex[e];
      if (known[next] == 0) {
        known[next] = 1;
        vertices.push_back(next);
      }
    }
  }
}

/// Spreads the lifts over what surrounds them; each stays as long as it was along its own way.
/// \param lifted vertices with a lift; all that were reached on return
void spread(const geometry::SurfaceNeighbours& around, std::vector<std::uint32_t>& lifted, std::vector<Vec3f>& lifts) {
  const std::vector<Vec3f> needed = lifts;
  std::vector<Vec3f> smoother(lifts.size(), Vec3f::Zero());
  std::vector<char> known(lifts.size(), 0);
  for (const std::uint32_t v : lifted) {
    known[v] = 1;
  }
  for (int round = 0; round < 3; ++round) {
    growByRing(around, lifted, known);
    for (const std::uint32_t v : lifted) {
      Vec3f mean = Vec3f::Zero();
      for (std::size_t e = around.first[v]; e < around.first[v + 1]; ++e) {
        mean += static_cast<float>(around.share[e]) * lifts[around.vertex[e]];
      }
      smoother[v] = 0.5F * (lifts[v] + mean);
      const float squared = needed[v].squaredNorm();
      const float reached = smoother[v].dot(needed[v]);
      if (reached < squared) {
        smoother[v] += (1.0F - reached / squared) * needed[v];
      }
    }
    lifts.swap(smoother);
  }
}

}  // namespace

float heightOver(const Triangle& corners, const Vec3f& p, std::span<const Vec3f> skin) {
  return liftOver(corners, p, skin).height;
}

void setFeet(PieceRig& piece, std::span<const std::uint32_t> triangles, std::span<const float> least,
             const geometry::TriangleMesh& skin, const std::function<bool(std::size_t, std::uint32_t)>& carries) {
  const std::vector<Across> across = trianglesAcross(skin.triangles);
  piece.feet.resize(triangles.size());
  for (std::size_t v = 0; v < triangles.size(); ++v) {
    SkinFoot& foot = piece.feet[v];
    foot.corners = skin.triangles[triangles[v]];
    foot.least = least[v];
    foot.aboutFirst = static_cast<std::uint32_t>(piece.about.size());
    const Lift rest = liftOver(foot.corners, piece.rest.positions[v], skin.positions);
    if (foot.least != kAnyHeight && rest.height < kNear) {
      std::vector<std::uint32_t> reached{triangles[v]};
      std::size_t ring = 0;
      for (int step = 0; step < kRings; ++step) {
        for (const std::size_t end = reached.size(); ring < end; ++ring) {
          for (const std::uint32_t t : across[reached[ring]]) {
            if (t != kNone && carries(v, t) && std::find(reached.begin(), reached.end(), t) == reached.end()) {
              reached.push_back(t);
            }
          }
        }
      }
      std::for_each(reached.begin() + 1, reached.end(),
                    [&](std::uint32_t t) { piece.about.push_back(skin.triangles[t]); });
    }
    foot.aboutBehind = static_cast<std::uint32_t>(piece.about.size());
    foot.feltFirst = static_cast<std::uint32_t>(piece.felt.size());
    for (std::uint32_t t = foot.aboutFirst; t < foot.aboutBehind; t += kFelt) {
      piece.felt.push_back(piece.about[t][0]);
    }
    foot.feltBehind = static_cast<std::uint32_t>(piece.felt.size());
  }
}

void holdOff(const PieceRig& piece, std::span<const Vec3f> skin, std::span<Vec3f> posed, base::Threads threads) {
  std::vector<Vec3f> lifts = neededLifts(piece, skin, posed, threads);
  std::vector<std::uint32_t> lifted;
  for (std::uint32_t v = 0; v < lifts.size(); ++v) {
    if (!lifts[v].isZero(0.0F)) {
      lifted.push_back(v);
    }
  }
  if (lifted.empty()) {
    return;
  }
  spread(piece.around, lifted, lifts);
  for (const std::uint32_t v : lifted) {
    posed[v] += lifts[v];
  }
}

}  // namespace lorica::armor
