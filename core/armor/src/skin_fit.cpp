#include "skin_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "lorica/raycast/caster.h"

namespace lorica::armor {

using geometry::Mat3d;
using geometry::RigidTransform;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr std::size_t kLeastPoints = 3;
constexpr double kPoints = 120.0;  // about as many places are looked at
constexpr double kFacing = 0.5;    // least cosine of the plate's inner face, and of the skin under it, to its way
constexpr double kReach = 0.10;    // m, from the plate to the skin under it
constexpr double kCarries = 0.02;  // of the skin under a plate, held by a joint that moves the plate
constexpr double kTogether = 0.5;  // of a place, held by such joints: what they hold less of moves apart
constexpr double kLine = 1e-6;     // of the second spread to the first: points along a line do not hold a turn

/// A triangle's middle and its normal, as long as it is large.
struct Facet {
  Vec3d middle;
  Vec3d area;
};

std::vector<Facet> facets(const TriangleMesh& mesh) {
  std::vector<Facet> all;
  all.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0);
    const Vec3d b = mesh.corner(t, 1);
    const Vec3d c = mesh.corner(t, 2);
    all.push_back({(a + b + c) / 3.0, 0.5 * (b - a).cross(c - a)});
  }
  return all;
}

/// How much of the body a ray runs through, m.
double through(raycast::Caster& caster, const Vec3d& from, const Vec3d& way) {
  double length = 0.0;
  for (const raycast::Hit& hit : caster.cast({from.cast<float>(), way.cast<float>()})) {
    length -= hit.sign() * hit.t;
  }
  return length;
}

/// The frame of a plate: across, along and outwards, away from most of the body. An arm may hang on its other side.
Mat3d plateAxes(std::span<const Facet> facets, raycast::Caster& caster) {
  double area = 0.0;
  Vec3d middle = Vec3d::Zero();
  for (const Facet& facet : facets) {
    area += facet.area.norm();
    middle += facet.area.norm() * facet.middle;
  }
  middle /= area;
  Mat3d spread = Mat3d::Zero();
  for (const Facet& facet : facets) {
    spread += facet.area.norm() * (facet.middle - middle) * (facet.middle - middle).transpose();
  }
  Mat3d axes = Eigen::SelfAdjointEigenSolver<Mat3d>(spread).eigenvectors().rowwise().reverse();
  if (through(caster, middle, axes.col(2)) > through(caster, middle, -axes.col(2))) {
    axes.col(2) = -axes.col(2);
  }
  return axes;
}

/// Some of a plate's inner face.
struct Place {
  Vec3d middle = Vec3d::Zero();
  double area = 0.0;  ///< m2, as seen along the plate's axis
};

/// The inner face cut into squares, at their middles.
std::vector<Place> innerFace(std::span<const Facet> facets, const Mat3d& axes) {
  const auto inwards = [&](const Facet& facet) { return -axes.col(2).dot(facet.area); };
  double area = 0.0;
  for (const Facet& facet : facets) {
    area += std::max(0.0, inwards(facet));
  }
  const double cell = std::sqrt(area / kPoints);
  std::map<std::pair<long, long>, Place> cells;
  for (const Facet& facet : facets) {
    if (const double seen = inwards(facet); seen > kFacing * facet.area.norm()) {
      Place& place =
          cells[{std::lround(axes.col(0).dot(facet.middle) / cell), std::lround(axes.col(1).dot(facet.middle) / cell)}];
      place.middle += seen * facet.middle;
      place.area += seen;
    }
  }
  std::vector<Place> places;
  places.reserve(cells.size());
  for (const auto& [at, place] : cells) {
    places.push_back({place.middle / place.area, place.area});
  }
  return places;
}

std::array<double, 3> barycentric(const TriangleMesh& mesh, std::size_t t, const Vec3d& p) {
  const Vec3d a = mesh.corner(t, 0);
  const Vec3d b = mesh.corner(t, 1);
  const Vec3d c = mesh.corner(t, 2);
  const Vec3d normal = (b - a).cross(c - a);
  const double of = normal.squaredNorm();
  const double second = normal.dot((p - a).cross(c - a)) / of;
  const double third = normal.dot((b - a).cross(p - a)) / of;
  return {1.0 - second - third, second, third};
}

Vec3d placeOf(const SkinUnder& point, std::span<const Vec3f> skin) {
  Vec3d place = Vec3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    place += point.shares[c] * skin[point.corners[c]].cast<double>();
  }
  return place;
}

/// The skin that a ray from a plate's inner face meets; its `play` is the whole gap, its weight the area.
std::optional<SkinUnder> skinBelow(const Place& place, const Vec3d& inwards, raycast::Caster& caster,
                                   const TriangleMesh& skin) {
  const auto hits = caster.cast({place.middle.cast<float>(), inwards.cast<float>()});
  if (hits.empty() || !hits.front().entering || hits.front().t > kReach) {
    return std::nullopt;
  }
  const double gap = hits.front().t;
  const std::uint32_t t = hits.front().triangle;
  const Vec3d normal = (skin.corner(t, 1) - skin.corner(t, 0)).cross(skin.corner(t, 2) - skin.corner(t, 0));
  if (-normal.dot(inwards) < kFacing * normal.norm()) {
    return std::nullopt;
  }
  SkinUnder point{skin.triangles[t], barycentric(skin, t, place.middle + gap * inwards), {}, place.area, gap};
  point.rest = placeOf(point, skin.positions);
  return point;
}

/// Leaves out what joints hold most of that hold next to nothing of all this skin: arms and legs at a plate's edge.
void leaveOutLimbs(std::vector<SkinUnder>& under, const human::SkinWeights& weights) {
  std::map<std::uint32_t, double> ofJoint;
  const auto eachInfluence = [&](const SkinUnder& point, const auto& use) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t at = point.corners[c] * weights.influences; at < (point.corners[c] + 1) * weights.influences;
           ++at) {
        use(weights.joints[at], point.shares[c] * static_cast<double>(weights.weights[at]));
      }
    }
  };
  double area = 0.0;
  for (const SkinUnder& point : under) {
    area += point.weight;
    eachInfluence(point, [&](std::uint32_t joint, double share) { ofJoint[joint] += point.weight * share; });
  }
  std::erase_if(under, [&](const SkinUnder& point) {
    double carried = 0.0;
    eachInfluence(
        point, [&](std::uint32_t joint, double share) { carried += ofJoint[joint] > kCarries * area ? share : 0.0; });
    return carried < kTogether;
  });
}

}  // namespace

void findUnder(PieceRig& piece, const TriangleMesh& plate, const parenting::BodyRig& body) {
  raycast::Caster caster(body.restScene());
  const std::vector<Facet> all = facets(plate);
  const Mat3d axes = plateAxes(all, caster);
  std::vector<SkinUnder> under;
  for (const Place& place : innerFace(all, axes)) {
    if (const auto point = skinBelow(place, -axes.col(2), caster, body.body().skin)) {
      under.push_back(*point);
    }
  }
  if (body.body().weights) {
    leaveOutLimbs(under, *body.body().weights);
  }
  if (under.size() < kLeastPoints) {
    return;
  }
  double area = 0.0;
  double nearest = kReach;
  for (const SkinUnder& point : under) {
    area += point.weight;
    nearest = std::min(nearest, point.play);
  }
  for (SkinUnder& point : under) {
    point.weight /= area;
    point.play -= nearest;
  }
  piece.under = std::move(under);
  piece.outwards = axes.col(2);
}

std::optional<RigidTransform> carriedBySkin(const PieceRig& piece, std::span<const Vec3f> skin) {
  std::vector<Vec3d> now(piece.under.size());
  Vec3d from = Vec3d::Zero();
  Vec3d to = Vec3d::Zero();
  bool still = true;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const SkinUnder& point = piece.under[i];
    now[i] = placeOf(point, skin);
    still = still && now[i] == point.rest;
    from += point.weight * point.rest;
    to += point.weight * now[i];
  }
  if (still) {
    return RigidTransform{};
  }
  Mat3d covariance = Mat3d::Zero();
  for (std::size_t i = 0; i < now.size(); ++i) {
    covariance += piece.under[i].weight * (now[i] - to) * (piece.under[i].rest - from).transpose();
  }
  const Eigen::JacobiSVD<Mat3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.singularValues()[1] <= kLine * svd.singularValues()[0]) {
    return std::nullopt;
  }
  Mat3d u = svd.matrixU();
  u.col(2) *= (u * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;  // a turn, never a mirror
  RigidTransform carry;
  carry.rotation = geometry::Quatd(Mat3d(u * svd.matrixV().transpose())).normalized();
  carry.translation = to - carry.rotation * from;
  // Onto the skin: what carries it best may lie in it.
  const Vec3d outwards = carry.rotation * piece.outwards;
  double lift = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < now.size(); ++i) {
    lift = std::max(lift, outwards.dot(now[i] - carry * piece.under[i].rest) - piece.under[i].play);
  }
  carry.translation += lift * outwards;
  return carry;
}

}  // namespace lorica::armor
