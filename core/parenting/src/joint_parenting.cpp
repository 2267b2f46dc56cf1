#include "lorica/parenting/joint_parenting.h"

#include "lorica/base/error.h"

namespace lorica::parenting {

using geometry::Affine3d;
using geometry::RigidTransform;
using geometry::Vec3d;

human::JointIndex nearestJoint(const human::Skeleton& skeleton, const Vec3d& point) {
  LORICA_CHECK(skeleton.size() > 0, "a skeleton with joints");
  human::JointIndex nearest{0};
  for (std::size_t j = 1; j < skeleton.size(); ++j) {
    const human::JointIndex joint{j};
    if ((skeleton.restPosition(joint) - point).squaredNorm() < (skeleton.restPosition(nearest) - point).squaredNorm()) {
      nearest = joint;
    }
  }
  return nearest;
}

std::vector<RigidTransform> carryJoints(const human::Skeleton& skeleton, const human::Pose& pose) {
  const std::vector<Affine3d> carry = human::carryTransforms(skeleton, pose);
  std::vector<RigidTransform> result(carry.size());
  for (std::size_t j = 0; j < carry.size(); ++j) {
    if (carry[j].matrix() == Affine3d::Identity().matrix()) {
      continue;
    }
    const Vec3d origin = skeleton.restPosition(human::JointIndex{j});
    result[j].rotation = geometry::Quatd(carry[j].rotation()).normalized();
    result[j].translation = carry[j] * origin - result[j].rotation * origin;
  }
  return result;
}

}  // namespace lorica::parenting
