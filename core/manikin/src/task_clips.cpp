#include "lorica/manikin/task_clips.h"

#include <algorithm>
#include <cmath>

#include "tasks.h"

namespace lorica::manikin {

namespace {

std::vector<Task> tasksOf(const Figure& figure) {
  return {toeTouch(figure), bellyTwist(), lateralTwist(), squat(), kneelAim(),
          proneAim(figure), armRaise(),   walk(figure),   sit()};
}

/// Channels of what moves: every part's rotation and the pelvis' place.
human::Clip keyed(const Figure& figure, const human::Skeleton& skeleton, const Task& task) {
  const int last = static_cast<int>(std::lround(task.duration * task.keysPerSecond));
  std::vector<human::Pose> poses;
  std::vector<double> times;
  for (int key = 0; key <= last; ++key) {
    const double u = static_cast<double>(key) / last;
    times.push_back(u * task.duration);
    poses.push_back(figure.pose(task.stance(figure, u)));
  }
  std::vector<human::JointIndex> turned;
  for (const human::Part& part : figure.frames().parts()) {
    turned.push_back(part.joint);
  }
  return human::clipThrough(task.name, skeleton, times, poses, turned, figure.joint(Role::pelvis, Side::middle));
}

}  // namespace

namespace {

/// How far the skin reaches along a direction from a joint, over the vertices that pass.
template <class Keep>
double reachFrom(const Body& body, const Vec3d& joint, const Vec3d& way, const Keep& keep) {
  double reach = 0.0;
  for (const geometry::Vec3f& position : body.skin.positions) {
    const Vec3d d = position.cast<double>() - joint;
    reach = keep(d) ? std::max(reach, d.dot(way)) : reach;
  }
  return reach;
}

std::optional<Vec3d> place(const human::Skeleton& skeleton, const char* joint) {
  const auto found = skeleton.find(joint);
  return found ? std::optional<Vec3d>(skeleton.restPosition(*found)) : std::nullopt;
}

/// What lies between joints and floor, where the skeleton has the joints of the joint table.
void measureThicknesses(const Body& body, TaskOptions& options) {
  const auto knee = place(body.skeleton, "knee_L");
  const auto elbow = place(body.skeleton, "elbow_L");
  const auto wrist = place(body.skeleton, "wrist_L");
  const auto hip = place(body.skeleton, "hip_L");
  const auto waist = place(body.skeleton, "spine_L3L4");
  if (!knee || !elbow || !wrist || !hip || !waist) {
    return;
  }
  const double stature = body.person.stature;
  constexpr double limb = 0.09;   // m, more than half of any
  constexpr double about = 0.01;  // m along the limb
  options.kneeThickness = reachFrom(body, *knee, Vec3d::UnitZ(),
                                    [&](const Vec3d& d) { return d.norm() < limb && std::abs(d.y()) < about; }) /
                          stature;
  const Vec3d forearm = (*wrist - *elbow).normalized();
  // The olecranon stands out when the elbow is bent.
  constexpr double olecranon = 0.003;
  options.elbowThickness =
      (olecranon + reachFrom(body, *elbow, -Vec3d::UnitZ(),
                             [&](const Vec3d& d) { return d.norm() < limb && std::abs(d.dot(forearm)) < about; })) /
      stature;
  // Prone the spine is extended and the pelvis pitched: the belly reaches further below the hips than before them
  // standing. As measured on bodies from small and slim to heavy.
  constexpr double extended = 1.393;
  const double belly = reachFrom(body, *hip, Vec3d::UnitZ(), [&](const Vec3d& d) {
    return d.y() > -0.02 && d.y() < waist->y() - hip->y() + 0.03 && d.x() < 0.05 && d.x() > -2.0 * hip->x() - 0.05;
  });
  options.pelvisThickness = extended * belly / stature;
}

}  // namespace

TaskOptions measuredOn(const Body& body) {
  TaskOptions options;
  options.stature = body.person.stature;
  if (!body.skin.positions.empty()) {
    double lowest = body.skin.positions.front().y();
    for (const geometry::Vec3f& position : body.skin.positions) {
      lowest = std::min(lowest, static_cast<double>(position.y()));
    }
    options.floor = lowest;
    measureThicknesses(body, options);
  }
  return options;
}

std::vector<human::Clip> taskClips(const human::Skeleton& skeleton, const human::RoleMap& roles,
                                   const TaskOptions& options) {
  const Figure figure(skeleton, roles, options);
  std::vector<human::Clip> clips;
  for (const Task& task : tasksOf(figure)) {
    clips.push_back(keyed(figure, skeleton, task));
  }
  return clips;
}

std::vector<std::string> taskClipNames() {
  return {"toe_touch", "belly_twist", "lateral_twist", "squat", "kneel_aim", "prone_aim", "arm_raise", "walk", "sit"};
}

double walkingSpeed(const human::Skeleton& skeleton, const human::RoleMap& roles, const TaskOptions& options) {
  return walkSpeed(Figure(skeleton, roles, options));
}

}  // namespace lorica::manikin
