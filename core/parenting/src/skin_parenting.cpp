#include "lorica/parenting/skin_parenting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lorica::parenting {

using geometry::Mat3d;
using geometry::Quatd;
using geometry::RigidTransform;
using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3f;

namespace {

Vec3d placeOf(const SkinAnchor& anchor, std::span<const Triangle> triangles, std::span<const Vec3f> positions) {
  const Triangle& corner = triangles[anchor.triangle];
  return anchor.barycentric[0] * positions[corner[0]].cast<double>() +
         anchor.barycentric[1] * positions[corner[1]].cast<double>() +
         anchor.barycentric[2] * positions[corner[2]].cast<double>();
}

/// Eq 4-6 with the anchors as C0..C2 and q, the point in their plane, as V_t; normalised. Nothing when the anchors are
/// collinear or q meets C0.
std::optional<Mat3d> frameOf(const std::array<Vec3d, 3>& anchor, const Vec3d& q) {
  const Vec3d side1 = anchor[1] - anchor[0];
  const Vec3d side2 = anchor[2] - anchor[0];
  const Vec3d normal = side1.cross(side2);
  const double longest = std::max({side1.squaredNorm(), side2.squaredNorm(), (side2 - side1).squaredNorm()});
  const Vec3d towards = anchor[0] - q;
  // Flatter than a thousandth, the plane's direction would be noise.
  if (!(normal.norm() > 1e-3 * longest) || !(towards.squaredNorm() > 1e-8 * longest)) {
    return std::nullopt;
  }
  Mat3d frame;
  frame.col(0) = normal.normalized();
  frame.col(1) = towards.normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1)).normalized();
  return frame;
}

struct RayTriple {
  std::array<Vec3d, 3> directions;
};

RayTriple tripleIn(const Vec3d& u, const Vec3d& v, double startDegrees) {
  RayTriple triple;
  for (int k = 0; k < 3; ++k) {
    const double angle = (startDegrees + 120.0 * k) * std::numbers::pi / 180.0;
    triple.directions[static_cast<std::size_t>(k)] = std::cos(angle) * u + std::sin(angle) * v;
  }
  return triple;
}

/// The fixed fan: planes square to the 13 axes of a cube (through faces, edges and corners), two turns in each.
const std::vector<RayTriple>& fan() {
  static const std::vector<RayTriple> triples = [] {
    std::vector<RayTriple> made;
    for (int code = 1; code < 27; ++code) {
      // The three digits of the code to base 3, each from -1 to 1.
      const int x = code % 3 - 1;
      const int y = code / 3 % 3 - 1;
      const int z = code / 9 - 1;
      // One of each pair of opposite axes.
      const bool positive = z > 0 || (z == 0 && (y > 0 || (y == 0 && x > 0)));
      if (!positive) {
        continue;
      }
      const Vec3d normal = Vec3d(x, y, z).normalized();
      const Vec3d u = normal.unitOrthogonal();
      const Vec3d v = normal.cross(u);
      made.push_back(tripleIn(u, v, 0.0));
      made.push_back(tripleIn(u, v, 60.0));
    }
    return made;
  }();
  return triples;
}

struct Found {
  std::array<SkinAnchor, 3> anchors;
  double reach = 0.0;  // sum of the three distances
};

/// The anchors of one triple; nothing when a ray misses or meets the skin from outside first.
std::optional<Found> anchorsOf(const Vec3d& point, const RayTriple& triple, raycast::Caster& caster,
                               const raycast::Scene& scene, raycast::MeshIndex skinMesh, AnchorKind kind) {
  Found found;
  const auto& triangles = scene.topology(skinMesh).triangles;
  const Vec3f* positions = scene.positions(skinMesh);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d& direction = triple.directions[k];
    const auto hits = caster.cast({point.cast<float>(), direction.cast<float>()});
    const auto first =
        std::find_if(hits.begin(), hits.end(), [&](const raycast::Hit& hit) { return hit.mesh == skinMesh.value; });
    if (first == hits.end() || first->entering) {
      return std::nullopt;
    }
    found.anchors[k].triangle = first->triangle;
    found.reach += first->t;
    if (kind == AnchorKind::faceCentroid) {
      found.anchors[k].barycentric = Vec3d::Constant(1.0 / 3.0);
    } else {
      const Triangle& corner = triangles[first->triangle];
      found.anchors[k].barycentric =
          barycentricWeights(point + first->t * direction, positions[corner[0]].cast<double>(),
                             positions[corner[1]].cast<double>(), positions[corner[2]].cast<double>());
    }
  }
  return found;
}

}  // namespace

Vec3d barycentricWeights(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  const Vec3d normal = ab.cross(ac);
  const double doubled = normal.squaredNorm();
  if (doubled == 0.0) {
    return Vec3d::Constant(1.0 / 3.0);
  }
  const Vec3d ap = p - a;
  const double v = ap.cross(ac).dot(normal) / doubled;
  const double w = ab.cross(ap).dot(normal) / doubled;
  return {1.0 - v - w, v, w};
}

std::optional<SkinSite> siteOnAnchors(const Vec3d& point, const std::array<SkinAnchor, 3>& anchors,
                                      std::span<const Triangle> triangles, std::span<const Vec3f> restSkin) {
  SkinSite site;
  site.rest = point;
  site.anchors = anchors;
  for (std::size_t k = 0; k < 3; ++k) {
    site.restAnchors[k] = placeOf(anchors[k], triangles, restSkin);
  }
  site.weights = barycentricWeights(point, site.restAnchors[0], site.restAnchors[1], site.restAnchors[2]);
  const Vec3d q = site.weights[0] * site.restAnchors[0] + site.weights[1] * site.restAnchors[1] +
                  site.weights[2] * site.restAnchors[2];
  const std::optional<Mat3d> frame = frameOf(site.restAnchors, q);
  if (!frame) {
    return std::nullopt;
  }
  site.restFrame = *frame;
  site.residual = frame->transpose() * (point - q);
  return site;
}

SiteBinding bindToSkin(const Vec3d& point, raycast::Caster& caster, const raycast::Scene& scene,
                       raycast::MeshIndex skinMesh, const ParentingOptions& options) {
  if (raycast::windingNumber(caster, skinMesh, point) < 1) {
    return {std::nullopt, "the point is not inside the skin"};
  }
  const std::span triangles(scene.topology(skinMesh).triangles);
  const std::span restSkin(scene.positions(skinMesh), scene.topology(skinMesh).vertices);
  SiteBinding best;
  double bestReach = std::numeric_limits<double>::infinity();
  const auto consider = [&](const RayTriple& triple) {
    const auto found = anchorsOf(point, triple, caster, scene, skinMesh, options.anchors);
    if (!found || found->reach >= bestReach) {
      return;
    }
    if (auto site = siteOnAnchors(point, found->anchors, triangles, restSkin)) {
      best.site = std::move(site);
      bestReach = found->reach;
    }
  };
  if (options.plane == RayPlane::transverse) {
    consider(tripleIn(Vec3d::UnitZ(), Vec3d::UnitX(), 0.0));
  } else {
    for (const RayTriple& triple : fan()) {
      consider(triple);
    }
  }
  if (!best.site) {
    best.trouble = "no three rays from the point leave the skin at places that span a plane";
  }
  return best;
}

std::optional<RigidTransform> carry(const SkinSite& site, std::span<const Triangle> triangles,
                                    std::span<const Vec3f> posedSkin) {
  std::array<Vec3d, 3> anchor;
  for (std::size_t k = 0; k < 3; ++k) {
    anchor[k] = placeOf(site.anchors[k], triangles, posedSkin);
  }
  if (anchor == site.restAnchors) {
    return RigidTransform{};
  }
  const Vec3d q = site.weights[0] * anchor[0] + site.weights[1] * anchor[1] + site.weights[2] * anchor[2];
  const std::optional<Mat3d> frame = frameOf(anchor, q);
  if (!frame) {
    return std::nullopt;
  }
  const Mat3d turn = *frame * site.restFrame.transpose();
  const Vec3d posed = q + *frame * site.residual;
  RigidTransform transform;
  transform.rotation = Quatd(turn).normalized();
  transform.translation = posed - transform.rotation * site.rest;
  return transform;
}

}  // namespace lorica::parenting
