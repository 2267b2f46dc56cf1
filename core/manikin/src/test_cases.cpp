#include "lorica/manikin/test_cases.h"

#include <numbers>

#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"

namespace lorica::manikin {

namespace {

using geometry::Vec3d;

Vec3d jointOf(const Body& body, const char* name) {
  const auto joint = body.skeleton.find(name);
  LORICA_CHECK(joint.has_value(), "the body has the joints of the joint table");
  return body.skeleton.restPosition(*joint);
}

/// A box about the origin, turned and moved.
geometry::TriangleMesh placedBox(const Vec3d& size, const geometry::Mat3d& turn, const Vec3d& place) {
  geometry::TriangleMesh mesh = geometry::box(-0.5 * size, 0.5 * size);
  for (geometry::Vec3f& p : mesh.positions) {
    p = (place + turn * p.cast<double>()).cast<float>();
  }
  return mesh;
}

}  // namespace

geometry::TriangleMesh shoulderCube(const Body& body) {
  const double size = body.person.stature / 1.755;
  const Vec3d shoulder = jointOf(body, "glenohumeral_L");
  const Vec3d spine = jointOf(body, "spine_T6T7");
  // Between spine and shoulder joint, in the depth of the spine's discs, where the trunk is thick.
  const Vec3d place(0.62 * shoulder.x(), spine.y() + 0.012 * size, spine.z() + 0.012 * size);
  return placedBox(Vec3d::Constant(0.040 * size), geometry::Mat3d::Identity(), place);
}

geometry::TriangleMesh forearmBox(const Body& body) {
  const double size = body.person.stature / 1.755;
  const Vec3d elbow = jointOf(body, "elbow_L");
  const Vec3d wrist = jointOf(body, "wrist_L");
  // Flat, nearly as wide as the forearm there, and across its thickest part: what turns farther than the skin comes
  // out of it.
  const Vec3d along = (wrist - elbow).normalized();
  const Vec3d sideways = along.cross(Vec3d::UnitZ()).normalized();
  const Vec3d width = Eigen::AngleAxisd(2.0 / 3.0 * std::numbers::pi, along) * sideways;
  geometry::Mat3d turn;
  turn << width, along, along.cross(width) * -1.0;
  return placedBox(Vec3d(0.050, 0.060, 0.010) * size, turn, elbow + 0.55 * (wrist - elbow) - 0.008 * size * width);
}

}  // namespace lorica::manikin
