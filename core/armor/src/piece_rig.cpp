#include "lorica/armor/piece_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hold_off.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "skin_fit.h"

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
struct SkinPlace {
  std::uint32_t triangle = 0;
  std::array<SkinCorner, 3> corners{};
};

/// The nearest place on the skin, for every vertex.
std::vector<SkinPlace> nearestSkin(std::span<const Vec3f> positions, const parenting::BodyRig& body,
                                   base::Threads threads) {
  std::vector<SkinPlace> places(positions.size());
  base::parallelFor(positions.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto nearest = raycast::closestPoint(body.restScene(), positions[v].cast<double>());
      places[v].triangle = nearest ? nearest->triangle : 0;
      for (std::size_t c = 0; c < 3 && nearest; ++c) {
        places[v].corners[c] = {body.body().skin.triangles[nearest->triangle][c],
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
        const std::size_t at = places[v].corners[c].vertex * skin.influences + k;
        influences[v * stride + c * skin.influences + k] = {
            skin.joints[at], places[v].corners[c].share * static_cast<double>(skin.weights[at])};
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
    for (const SkinCorner& corner : places[v].corners) {
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
  for (const SkinCorner& corner : place.corners) {
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

// What agrees less moves apart.
constexpr double kTogether = 0.5;

/// How high each vertex is held over the skin. Across the fold of an armpit the nearest skin may be the arm's, which
/// does not carry a vest: where the skin moves with other joints than the vertex there is nothing to be held off from.
std::vector<float> leastHeights(std::span<const SkinPlace> places, std::span<const Vec3f> positions,
                                const human::SkinWeights& weights, const parenting::BodyRig& body) {
  constexpr float pressed = 0.3F;        // share of the height at rest
  constexpr float pressedMost = 0.002F;  // m
  std::vector<float> least(places.size(), kAnyHeight);
  for (std::size_t v = 0; v < places.size(); ++v) {
    const geometry::Triangle& corners = body.body().skin.triangles[places[v].triangle];
    const float height = heightOver(corners, positions[v], body.body().skin.positions);
    if (height > 0.0F && agreement(weights, v, *body.body().weights, places[v]) > kTogether) {
      least[v] = height - std::min(pressed * height, pressedMost);
    }
  }
  return least;
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
    std::vector<std::uint32_t> triangles(places.size());
    std::transform(places.begin(), places.end(), triangles.begin(), [](const SkinPlace& p) { return p.triangle; });
    const auto carries = [&](std::size_t v, std::uint32_t t) {
      const geometry::Triangle& corners = body.body().skin.triangles[t];
      constexpr double third = 1.0 / 3.0;
      const SkinPlace middle{t, {{{corners[0], third}, {corners[1], third}, {corners[2], third}}}};
      return agreement(*piece.weights, v, *body.body().weights, middle) > kTogether;
    };
    setFeet(piece, triangles, leastHeights(places, piece.rest.positions, *piece.weights, body), body.body().skin,
            carries);
    piece.around = geometry::surfaceNeighbours(piece.rest);
  }
}

geometry::RigidTransform carried(const PieceRig& piece, const parenting::PosedBody& pose) {
  if (!piece.under.empty()) {
    if (const auto bySkin = carriedBySkin(piece, pose.skin)) {
      return *bySkin;
    }
  }
  return piece.hasSite ? pose.sites.carry[piece.site] : geometry::RigidTransform{};
}

}  // namespace

PieceRig bindPiece(geometry::TriangleMesh rest, const std::string& name, Carriage carriage,
                   const parenting::BodyRig& body, const human::SkinWeights* ownWeights,
                   const human::Skeleton* ownSkeleton, base::Threads threads, const RigidCarrier& carrier,
                   SoftFit fit) {
  LORICA_CHECK(!rest.positions.empty(), "a piece with vertices");
  PieceRig piece;
  piece.rest = std::move(rest);
  piece.carriage = carriage;
  if (carriage == Carriage::skinned) {
    bindSoft(piece, name, body, ownWeights, ownSkeleton, fit, threads);
    return piece;
  }
  if (carrier.by == CarriedBy::skin) {
    findUnder(piece, carrier.plate != nullptr ? *carrier.plate : piece.rest, body);
  }
  if (body.sites().empty() && piece.under.empty()) {
    piece.issues.push_back({base::Severity::warning, "", name,
                            "the body has no interior site that could carry this rigid piece; it stays where it is"});
    return piece;
  }
  if (!body.sites().empty()) {
    piece.site = parenting::nearestSite(body.sites(), carrier.at ? *carrier.at : geometry::centroid(piece.rest));
    piece.hasSite = true;
  }
  return piece;
}

void posePiece(const PieceRig& piece, const parenting::PosedBody& pose, std::span<Vec3f> posed, base::Threads threads) {
  LORICA_CHECK(posed.size() == piece.rest.positions.size(), "one place per vertex");
  if (piece.carriage == Carriage::skinned && piece.weights) {
    human::skin(piece.rest.positions, *piece.weights, piece.centres, pose.deltas, posed, threads);
    if (!piece.feet.empty()) {
      holdOff(piece, pose.skin, posed, threads);
    }
    return;
  }
  const geometry::Positions moved = geometry::transformed(piece.rest.positions, carried(piece, pose));
  std::copy(moved.begin(), moved.end(), posed.begin());
}

}  // namespace lorica::armor
