#include "lorica/geometry/measures.h"

#include <cmath>

namespace lorica::geometry {

Box3d bounds(std::span<const Vec3f> points) {
  Box3d box;
  for (const Vec3f& p : points) {
    box.extend(p.cast<double>());
  }
  return box;
}

double area(const TriangleMesh& mesh) {
  double doubled = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0);
    doubled += (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
  }
  return doubled / 2.0;
}

std::vector<double> vertexAreas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.positions.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0);
    const double third = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm() / 6.0;
    for (const std::uint32_t v : mesh.triangles[t]) {
      areas[v] += third;
    }
  }
  return areas;
}

double signedVolume(const TriangleMesh& mesh) {
  // Summed about the box centre, so that a mesh far from the origin loses no digits.
  const Box3d box = bounds(mesh.positions);
  if (box.isEmpty()) {
    return 0.0;
  }
  const Vec3d centre = box.center();
  double sixfold = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sixfold += (mesh.corner(t, 0) - centre).dot((mesh.corner(t, 1) - centre).cross(mesh.corner(t, 2) - centre));
  }
  return sixfold / 6.0;
}

Vec3d centroid(const TriangleMesh& mesh) {
  const Box3d box = bounds(mesh.positions);
  if (box.isEmpty()) {
    return Vec3d::Zero();
  }
  const Vec3d centre = box.center();
  double sixfold = 0.0;
  double doubledArea = 0.0;
  Vec3d volumeMoment = Vec3d::Zero();
  Vec3d areaMoment = Vec3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0) - centre;
    const Vec3d b = mesh.corner(t, 1) - centre;
    const Vec3d c = mesh.corner(t, 2) - centre;
    const double volume = a.dot(b.cross(c));
    const double doubled = (b - a).cross(c - a).norm();
    sixfold += volume;
    volumeMoment += volume * (a + b + c) / 4.0;
    doubledArea += doubled;
    areaMoment += doubled * (a + b + c) / 3.0;
  }
  // An open shell has no volume to speak of: its surface then says where it is.
  const double boxVolume = box.volume();
  if (std::abs(sixfold) / 6.0 > 1e-3 * boxVolume && sixfold != 0.0) {
    const Vec3d middle = centre + volumeMoment / sixfold;
    if (box.contains(middle)) {
      return middle;
    }
  }
  return doubledArea > 0.0 ? Vec3d(centre + areaMoment / doubledArea) : centre;
}

std::vector<Vec3f> vertexNormals(std::span<const Vec3f> positions, std::span<const Triangle> triangles) {
  std::vector<Vec3d> sums(positions.size(), Vec3d::Zero());
  for (const Triangle& triangle : triangles) {
    const Vec3d a = positions[triangle[0]].cast<double>();
    const Vec3d normal = (positions[triangle[1]].cast<double>() - a).cross(positions[triangle[2]].cast<double>() - a);
    for (const std::uint32_t vertex : triangle) {
      sums[vertex] += normal;
    }
  }
  std::vector<Vec3f> normals(positions.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double length = sums[v].norm();
    normals[v] = length > 0.0 ? Vec3f((sums[v] / length).cast<float>()) : Vec3f::Zero();
  }
  return normals;
}

}  // namespace lorica::geometry
