#include "lorica/geometry/winding.h"

#include <cmath>
#include <numbers>

namespace lorica::geometry {

double windingNumber(const TriangleMesh& mesh, const Vec3d& point) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0) - point;
    const Vec3d b = mesh.corner(t, 1) - point;
    const Vec3d c = mesh.corner(t, 2) - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double volume = a.dot(b.cross(c));
    const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    sum += 2.0 * std::atan2(volume, denominator);
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace lorica::geometry
