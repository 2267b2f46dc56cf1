#include "lorica/geometry/transform.h"

#include <algorithm>

namespace lorica::geometry {

Positions transformed(const Positions& points, const RigidTransform& transform) {
  if (transform.isIdentity()) {
    return points;
  }
  const Mat3d rotation = transform.rotation.toRotationMatrix();
  Positions moved(points.size());
  std::transform(points.begin(), points.end(), moved.begin(), [&](const Vec3f& p) -> Vec3f {
    return (rotation * p.cast<double>() + transform.translation).cast<float>();
  });
  return moved;
}

Mat3d zUpToYUp() {
  Mat3d turn;
  turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return turn;
}

}  // namespace lorica::geometry
