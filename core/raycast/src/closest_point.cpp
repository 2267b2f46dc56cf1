#include <algorithm>

#include "embree.h"
#include "lorica/geometry/closest_point.h"

namespace lorica::raycast {

using geometry::Vec3d;

namespace {

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
  const Vec3d weights = geometry::closestBarycentric(search.query, a, b, c);
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
