#pragma once

/// \file
/// Joint-based parenting (thesis section 2.4.1), the baseline: a model is rigidly tied to one joint.

#include <vector>

#include "lorica/geometry/transform.h"
#include "lorica/human/skeleton.h"

namespace lorica::parenting {

/// The joint nearest to a point at rest; the first of equally near ones. \pre the skeleton has a joint
human::JointIndex nearestJoint(const human::Skeleton& skeleton, const geometry::Vec3d& point);

/// For every joint the rigid motion from rest to the pose: its rotation about where its origin goes. A clip's scaling
/// of a joint does not scale what is tied to it.
std::vector<geometry::RigidTransform> carryJoints(const human::Skeleton& skeleton, const human::Pose& pose);

}  // namespace lorica::parenting
