#include "lorica/armor/piece_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::armor {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

/// The piece's weights on the body's joints; nothing when a joint has no namesake there.
std::optional<human::SkinWeights> renamed(const human::SkinWeights& own, const human::Skeleton& from,
                                          const human::Skeleton& to, std::string& missing) {
  std::vector<std::uint32_t> joint(from.size(), 0);
  std::vector<char> used(from.size(), 0);
  for (std::size_t i = 0; i < own.joints.size(); ++i) {
    used[own.joints[i]] = used[own.joints[i]] != 0 || own.weights[i] > 0.0F ? 1 : 0;
  }
  for (std::size_t j = 0; j < from.size(); ++j) {
    const auto namesake = to.find(from.joints()[j].name);
    if (used[j] != 0 && !namesake) {
      missing = from.joints()[j].name;
      return std::nullopt;
    }
    joint[j] = namesake ? namesake->value : 0;
  }
  human::SkinWeights result = own;
  for (std::uint32_t& j : result.joints) {
    j = joint[j];
  }
  return result;
}

/// A corner of the skin's triangle under a vertex, and how much the vertex takes from it.
struct SkinCorner {
  std::uint32_t vertex = 0;
  double share = 0.0;
};
using SkinPlace = std::array<SkinCorner, 3>;

/// The nearest place on the skin, for every vertex.
std::vector<SkinPlace> nearestSkin(std::span<const Vec3f> positions, const parenting::BodyRig& body,
                                   base::Threads threads) {
  std::vector<SkinPlace> places(positions.size());
  base::parallelFor(positions.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto nearest = raycast::closestPoint(body.restScene(), positions[v].cast<double>());
      for (std::size_t c = 0; c < 3 && nearest; ++c) {
        places[v][c] = {body.body().skin.triangles[nearest->triangle][c],
                        std::max(0.0, nearest->barycentric[static_cast<Eigen::Index>(c)])};
      }
    }
  });
  return places;
}

human::SkinWeights weightsAt(std::span<const SkinPlace> places, const human::SkinWeights& skin) {
  const std::size_t stride = 3 * skin.influences;
  std::vector<human::Influence> influences(places.size() * stride);
  for (std::size_t v = 0; v < places.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < skin.influences; ++k) {
        const std::size_t at = places[v][c].vertex * skin.influences + k;
        influences[v * stride + c * skin.influences + k] = {skin.joints[at],
                                                            places[v][c].share * static_cast<double>(skin.weights[at])};
      }
    }
  }
  return human::normaliseWeights(influences, stride).weights;
}

/// The skin's centres of rotation under a piece. Corners that one joint holds have none that says anything; over three
/// of those a vertex is its own centre.
std::vector<Vec3f> centresAt(std::span<const SkinPlace> places, std::span<const Vec3f> positions,
                             const parenting::BodyRig& body) {
  if (body.centres().empty()) {
    return {};
  }
  std::vector<Vec3f> centres(places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    Vec3d sum = Vec3d::Zero();
    double share = 0.0;
    for (const SkinCorner& corner : places[v]) {
      if (body.body().weights->isShared(corner.vertex)) {
        sum += corner.share * body.centres()[corner.vertex].cast<double>();
        share += corner.share;
      }
    }
    centres[v] = share > 0.0 ? Vec3f((sum / share).cast<float>()) : positions[v];
  }
  return centres;
}

/// How far two sets of weights agree: 1 when they are the same, 0 when they have no joint in common.
double agreement(const human::SkinWeights& weights, std::size_t vertex, const human::SkinWeights& skin,
                 const SkinPlace& place) {
  double shared = 0.0;
  for (const SkinCorner& corner : place) {
    for (std::size_t k = 0; k < skin.influences; ++k) {
      for (std::size_t o = 0; o < weights.influences; ++o) {
        const std::size_t theirs = corner.vertex * skin.influences + k;
        const std::size_t mine = vertex * weights.influences + o;
        if (weights.joints[mine] == skin.joints[theirs]) {
          shared += corner.share * static_cast<double>(std::min(weights.weights[mine], skin.weights[theirs]));
        }
      }
    }
  }
  return shared;
}

/// A way off the skin.
struct Lift {
  float height = 0.0F;  ///< of the vertex over the plane of the triangle under it, m
  Vec3f normal = Vec3f::Zero();
};

Lift liftOver(const SkinFoot& foot, const Vec3f& p, std::span<const Vec3f> skin) {
  const Vec3f& a = skin[foot.corners[0]];
  const Vec3f normal = (skin[foot.corners[1]] - a).cross(skin[foot.corners[2]] - a).normalized();
  return {normal.dot(p - a), normal};
}

// Nothing is lower: such a vertex is never lifted.
constexpr float kAnyHeight = -1e6F;

/// The triangle under each vertex. Across the fold of an armpit the nearest skin may be the arm's, which does not carry
/// a vest: where the skin moves with other joints than the vertex there is nothing to be held off from.
std::vector<SkinFoot> feetOf(std::span<const SkinPlace> places, std::span<const Vec3f> positions,
                             const human::SkinWeights& weights, const parenting::BodyRig& body) {
  constexpr double together = 0.5;
  constexpr float pressed = 0.3F;        // share of the height at rest
  constexpr float pressedMost = 0.002F;  // m
  std::vector<SkinFoot> feet(places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    SkinFoot& foot = feet[v];
    foot.corners = {places[v][0].vertex, places[v][1].vertex, places[v][2].vertex};
    const float height = liftOver(foot, positions[v], body.body().skin.positions).height;
    const bool carried = agreement(weights, v, *body.body().weights, places[v]) > together;
    foot.least = carried && height > 0.0F ? height - std::min(pressed * height, pressedMost) : kAnyHeight;
  }
  return feet;
}

// What has sunk further than this has not been pressed: the skin has folded beneath it, and the further the less its
// triangles say where outside is.
constexpr float kSunk = 0.006F;  // m

/// What takes each vertex as far off the skin as its foot says.
std::vector<Vec3f> neededLifts(const PieceRig& piece, std::span<const Vec3f> skin, std::span<const Vec3f> posed,
                               base::Threads threads) {
  std::vector<Vec3f> lifts(posed.size(), Vec3f::Zero());
  base::parallelFor(posed.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const SkinFoot& foot = piece.feet[v];
      const Lift lift = liftOver(foot, posed[v], skin);
      const float missing = foot.least - lift.height;
      if (missing > 0.0F && missing < 2.0F * kSunk) {
        lifts[v] = std::min(missing, 2.0F * kSunk - missing) * lift.normal;
      }
    }
  });
  return lifts;
}

/// Spreads the lifts over what surrounds them; each stays as long as it was along its own way.
void spread(const geometry::SurfaceNeighbours& around, std::vector<Vec3f>& lifts) {
  const std::vector<Vec3f> needed = lifts;
  std::vector<Vec3f> smoother(lifts.size());
  for (int round = 0; round < 3; ++round) {
    for (std::size_t v = 0; v < lifts.size(); ++v) {
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

/// Lifts what lies too near to the skin under it.
void holdOff(const PieceRig& piece, std::span<const Vec3f> skin, std::span<Vec3f> posed, base::Threads threads) {
  std::vector<Vec3f> lifts = neededLifts(piece, skin, posed, threads);
  if (std::all_of(lifts.begin(), lifts.end(), [](const Vec3f& lift) { return lift.isZero(0.0F); })) {
    return;
  }
  spread(piece.around, lifts);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    posed[v] += lifts[v];
  }
}

/// The weights a soft piece is carried by; true when they are its own.
bool takeWeights(PieceRig& piece, const std::string& name, const parenting::BodyRig& body,
                 std::span<const SkinPlace> places, const human::SkinWeights* ownWeights,
                 const human::Skeleton* ownSkeleton) {
  if (ownWeights != nullptr && ownSkeleton != nullptr) {
    std::string missing;
    piece.weights = renamed(*ownWeights, *ownSkeleton, *body.body().skeleton, missing);
    if (piece.weights) {
      return true;
    }
    piece.issues.push_back({base::Severity::note, "", name,
                            fmt::format("is skinned to a joint \"{}\" that the body does not have; it takes the "
                                        "weights of the nearest skin instead of its own",
                                        missing)});
  }
  piece.weights = weightsAt(places, *body.body().weights);
  return false;
}

void bindSoft(PieceRig& piece, const std::string& name, const parenting::BodyRig& body,
              const human::SkinWeights* ownWeights, const human::Skeleton* ownSkeleton, SoftFit fit,
              base::Threads threads) {
  if (!body.body().skeleton) {
    return;
  }
  const std::vector<SkinPlace> places = nearestSkin(piece.rest.positions, body, threads);
  piece.centres = centresAt(places, piece.rest.positions, body);
  const bool own = takeWeights(piece, name, body, places, ownWeights, ownSkeleton);
  if (!own || fit == SoftFit::heldOff) {
    piece.feet = feetOf(places, piece.rest.positions, *piece.weights, body);
    piece.around = geometry::surfaceNeighbours(piece.rest);
  }
}

}  // namespace

PieceRig bindPiece(geometry::TriangleMesh rest, const std::string& name, Carriage carriage,
                   const parenting::BodyRig& body, const human::SkinWeights* ownWeights,
                   const human::Skeleton* ownSkeleton, base::Threads threads,
                   const std::optional<geometry::Vec3d>& carriedAt, SoftFit fit) {
  LORICA_CHECK(!rest.positions.empty(), "a piece with vertices");
  PieceRig piece;
  piece.rest = std::move(rest);
  piece.carriage = carriage;
  if (carriage == Carriage::skinned) {
    bindSoft(piece, name, body, ownWeights, ownSkeleton, fit, threads);
    return piece;
  }
  if (body.sites().empty()) {
    piece.issues.push_back({base::Severity::warning, "", name,
                            "the body has no interior site that could carry this rigid piece; it stays where it is"});
    return piece;
  }
  piece.site = parenting::nearestSite(body.sites(), carriedAt ? *carriedAt : geometry::centroid(piece.rest));
  piece.hasSite = true;
  return piece;
}

human::SkinningDeltas pieceDeltas(const parenting::BodyRig& body, const std::optional<human::Pose>& pose) {
  if (!body.body().skeleton) {
    return {};
  }
  return human::skinningDeltas(*body.body().skeleton, pose ? *pose : human::restPose(*body.body().skeleton));
}

void posePiece(const PieceRig& piece, const parenting::PosedBody& pose, const human::SkinningDeltas& deltas,
               std::span<Vec3f> posed, base::Threads threads) {
  LORICA_CHECK(posed.size() == piece.rest.positions.size(), "one place per vertex");
  if (piece.carriage == Carriage::skinned && piece.weights) {
    human::skin(piece.rest.positions, *piece.weights, piece.centres, deltas, posed, threads);
    if (!piece.feet.empty()) {
      holdOff(piece, pose.skin, posed, threads);
    }
    return;
  }
  const bool carried = piece.carriage == Carriage::rigid && piece.hasSite;
  const geometry::Positions moved =
      carried ? geometry::transformed(piece.rest.positions, pose.sites.carry[piece.site]) : piece.rest.positions;
  std::copy(moved.begin(), moved.end(), posed.begin());
}

}  // namespace lorica::armor
