#include <algorithm>

#include "embree.h"

namespace lorica::raycast {

using geometry::Vec3d;

namespace {

/// Barycentric weights of the point of a triangle nearest to p (Ericson 2005, section 5.1.5).
Vec3d nearestOnTriangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  const Vec3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return {1, 0, 0};
  }
  const Vec3d bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) {
    return {0, 1, 0};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const Vec3d cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) {
    return {0, 0, 1};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

struct Search {
  const Scene::Impl* scene;
  Vec3d query;
  std::optional<SurfacePoint> best;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  const auto& mesh = search.scene->meshes[arguments->geomID];
  const geometry::Triangle& corner = mesh.topology->triangles[arguments->primID];
  const Vec3d a = mesh.positions[corner[0]].cast<double>();
  const Vec3d b = mesh.positions[corner[1]].cast<double>();
  const Vec3d c = mesh.positions[corner[2]].cast<double>();
  const Vec3d weights = nearestOnTriangle(search.query, a, b, c);
  const Vec3d point = weights[0] * a + weights[1] * b + weights[2] * c;
  const double distance = (point - search.query).norm();
  const SurfacePoint found{MeshIndex{arguments->geomID}, arguments->primID, weights, point, distance};
  const auto& best = search.best;
  const bool wins =
      !best || distance < best->distance ||
      (distance == best->distance && std::pair(found.mesh, found.triangle) < std::pair(best->mesh, best->triangle));
  if (!wins) {
    return false;
  }
  search.best = found;
  // A little wider than the distance: the query's own radius is single precision.
  arguments->query->radius = static_cast<float>(distance * (1.0 + 1e-5) + 1e-6);
  return true;
}

}  // namespace

std::optional<SurfacePoint> closestPoint(const Scene& scene, const Vec3d& query, double radius) {
  Search search{&SceneAccess::of(scene), query, std::nullopt};
  RTCPointQuery pointQuery{};
  pointQuery.x = static_cast<float>(query.x());
  pointQuery.y = static_cast<float>(query.y());
  pointQuery.z = static_cast<float>(query.z());
  pointQuery.radius = static_cast<float>(radius);
  RTCPointQueryContext context{};
  rtcInitPointQueryContext(&context);
  rtcPointQuery(search.scene->scene, &pointQuery, &context, visit, &search);
  if (search.best && search.best->distance > radius) {
    return std::nullopt;
  }
  return search.best;
}

}  // namespace lorica::raycast
