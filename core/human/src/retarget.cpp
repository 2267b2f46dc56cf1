#include "lorica/human/retarget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/human/anatomical_frames.h"

namespace lorica::human {

using geometry::Affine3d;
using geometry::Quatd;
using geometry::Vec3d;

namespace {

constexpr std::array bothSides{Side::left, Side::right};

/// Turn of each part away from the anatomical position, in the body's frame.
using Turns = std::vector<Quatd>;

struct Figure {
  const Skeleton& skeleton;
  const RoleMap& roles;
  AnatomicalFrames frames;
  std::vector<JointIndex> feet;  ///< ankles and the balls of the feet
  double leg = 0.0;              ///< hip to ankle along the bones, metres

  explicit Figure(const Actor& actor)
      : skeleton(actor.skeleton), roles(actor.roles), frames(actor.skeleton, actor.roles) {
    for (const Side side : bothSides) {
      const auto at = [&](Role role) { return skeleton.restPosition(roles.joint(role, side).value()); };
      leg += 0.5 * ((at(Role::knee) - at(Role::hip)).norm() + (at(Role::ankle) - at(Role::knee)).norm());
      feet.push_back(roles.joint(Role::ankle, side).value());
      if (const auto toe = roles.joint(Role::toe, side)) {
        feet.push_back(*toe);
      }
    }
  }

  JointIndex pelvis() const { return roles.joint(Role::pelvis).value(); }

  std::vector<std::size_t> chain(std::initializer_list<Role> wanted, Side side) const {
    std::vector<std::size_t> found;
    for (const Role role : wanted) {
      for (std::size_t p = 0; p < frames.parts().size(); ++p) {
        if (frames.parts()[p].role == role && frames.parts()[p].side == side) {
          found.push_back(p);
        }
      }
    }
    return found;
  }

  Turns turns(const std::vector<Affine3d>& carry) const {
    Turns result;
    result.reserve(frames.parts().size());
    for (const Part& part : frames.parts()) {
      result.push_back(frames.facing().conjugate() * Quatd(carry[part.joint.value].rotation()) * frames.facing() *
                       part.restTurn);
    }
    return result;
  }

  /// How far the foot that is least lifted is above where it rests, metres.
  double leastLift(const std::vector<Affine3d>& carry) const {
    double least = std::numeric_limits<double>::infinity();
    for (const JointIndex foot : feet) {
      const Vec3d rest = skeleton.restPosition(foot);
      least = std::min(least, (carry[foot.value] * rest - rest).y());
    }
    return least;
  }
};

/// What a part of the doer takes from two parts of the one shown.
struct Drive {
  std::size_t part = 0;
  std::size_t from = 0;
  std::size_t to = 0;
  double share = 1.0;  ///< of `to`
};

/// Which part follows which.
class Likeness {
 public:
  Likeness(const Figure& shown, const Figure& doer) : shown_(shown), doer_(doer) {
    match({Role::pelvis}, Side::middle, 0);
    const std::size_t chest = matchTrunk();
    for (const Side side : bothSides) {
      match({Role::clavicle}, side, chest);
      match({Role::shoulder}, side, chest);
      match({Role::elbow}, side, chest);
      match({Role::forearmTwist}, side, chest);
      match({Role::wrist}, side, chest);
      const std::size_t palm = shown.chain({Role::wrist}, side).front();
      for (const Role finger : {Role::thumb, Role::index, Role::middle, Role::ring, Role::little}) {
        match({finger}, side, palm);
      }
      match({Role::hip}, side, 0);
      match({Role::knee}, side, 0);
      match({Role::ankle}, side, 0);
      match({Role::toe}, side, shown.chain({Role::ankle}, side).front());
    }
  }

  /// What the doer's parts take; nothing for a part without its like.
  std::vector<std::optional<Quatd>> apply(const Turns& shown) const {
    std::vector<std::optional<Quatd>> turns(doer_.frames.parts().size());
    for (const Drive& drive : drives_) {
      turns[drive.part] =
          drive.share == 1.0 ? shown[drive.to] : shown[drive.from].slerp(drive.share, shown[drive.to]).normalized();
    }
    for (const Side side : bothSides) {
      shareTwist(shown, side, turns);
    }
    return turns;
  }

 private:
  bool bothHave(Role role) const {
    return !shown_.chain({role}, Side::middle).empty() && !doer_.chain({role}, Side::middle).empty();
  }

  /// \return the last part of the trunk of the one shown
  std::size_t matchTrunk() {
    const std::vector<std::size_t> trunk = shown_.chain({Role::lumbar, Role::thoracic}, Side::middle);
    const std::size_t chest = trunk.back();
    if (bothHave(Role::lumbar) && bothHave(Role::thoracic)) {
      match({Role::lumbar}, Side::middle, 0);
      match({Role::thoracic}, Side::middle, shown_.chain({Role::lumbar}, Side::middle).back());
    } else {
      match({Role::lumbar, Role::thoracic}, Side::middle, 0);
    }
    if (bothHave(Role::neck) && bothHave(Role::head)) {
      match({Role::neck}, Side::middle, chest);
      match({Role::head}, Side::middle, shown_.chain({Role::neck}, Side::middle).back());
    } else {
      match({Role::neck, Role::head}, Side::middle, chest);
    }
    return chest;
  }

  /// Joints of one chain follow those of another, by how far along it they are.
  /// \param base part of the one shown that carries the chain
  void match(std::initializer_list<Role> roles, Side side, std::size_t base) {
    const std::vector<std::size_t> from = shown_.chain(roles, side);
    const std::vector<std::size_t> to = doer_.chain(roles, side);
    for (std::size_t k = 0; k < to.size() && !from.empty(); ++k) {
      const std::size_t whole = (k + 1) * from.size() / to.size();
      const std::size_t rest = (k + 1) * from.size() % to.size();
      const std::size_t low = whole == 0 ? base : from[whole - 1];
      if (rest == 0) {
        drives_.push_back({to[k], low, low, 1.0});
      } else {
        drives_.push_back({to[k], low, from[whole], static_cast<double>(rest) / static_cast<double>(to.size())});
      }
    }
  }

  /// A forearm that turns in a joint of its own, and one whose pronation elbow and hand share.
  void shareTwist(const Turns& shown, Side side, std::vector<std::optional<Quatd>>& turns) const {
    const auto shownTwist = shown_.frames.part(Role::forearmTwist, side);
    const auto twist = doer_.frames.part(Role::forearmTwist, side);
    if (shownTwist.has_value() == twist.has_value()) {
      return;
    }
    const Quatd& upperArm = shown[*shown_.frames.part(Role::shoulder, side)];
    const Quatd& elbow = shown[*shown_.frames.part(Role::elbow, side)];
    const std::size_t forearm = *doer_.frames.part(Role::elbow, side);
    if (twist) {
      JointAngles bend = angles(Role::elbow, side, upperArm.conjugate() * elbow);
      bend.axial = 0.0;
      const Quatd unpronated = upperArm * turn(Role::elbow, side, bend);
      const Quatd& hand = shown[*shown_.frames.part(Role::wrist, side)];
      const double pronation = angles(Role::wrist, side, unpronated.conjugate() * hand).axial;
      turns[forearm] = unpronated;
      turns[*twist] = unpronated * turn(Role::elbow, side, {0.0, 0.0, pronation});
    } else {
      const double pronation = angles(Role::elbow, side, elbow.conjugate() * shown[*shownTwist]).axial;
      turns[forearm] = elbow * turn(Role::elbow, side, {0.0, 0.0, 0.5 * pronation});
    }
  }

  const Figure& shown_;
  const Figure& doer_;
  std::vector<Drive> drives_;
};

std::vector<double> keyTimes(const Clip& clip) {
  std::vector<double> times;
  for (const Channel& channel : clip.channels) {
    times.insert(times.end(), channel.times.begin(), channel.times.end());
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// The turn about the vertical that makes a pelvis face ahead; of one who lies, by where the head points.
double ahead(const Quatd& pelvis) {
  constexpr double lying = 0.3;  // of the pelvis' front, along the floor
  const auto level = [](const Vec3d& v) { return Vec3d(v.x(), 0.0, v.z()); };
  const Vec3d front = pelvis * Vec3d::UnitZ();
  const Vec3d way =
      level(front).norm() > lying ? level(front) : level((front.y() < 0.0 ? 1.0 : -1.0) * (pelvis * Vec3d::UnitY()));
  return -std::atan2(way.x(), way.z());
}

/// The doer's pose once the turns of its parts are known, its pelvis where it rests.
class Doing {
 public:
  explicit Doing(const Figure& doer) : doer_(doer), partOf_(doer.skeleton.size()) {
    for (std::size_t p = 0; p < doer.frames.parts().size(); ++p) {
      partOf_[doer.frames.parts()[p].joint.value] = p;
    }
    for (std::size_t j = 0; j < doer.skeleton.size(); ++j) {
      rest_.emplace_back(doer.skeleton.restFrame(JointIndex{j}).rotation());
    }
  }

  Pose pose(const std::vector<std::optional<Quatd>>& turns) const {
    const Quatd& facing = doer_.frames.facing();
    Pose pose = restPose(doer_.skeleton);
    std::vector<Quatd> carry(doer_.skeleton.size(), Quatd::Identity());
    for (std::size_t j = 0; j < carry.size(); ++j) {
      const auto parent = doer_.skeleton.joints()[j].parent;
      if (parent) {
        carry[j] = carry[parent->value];
      }
      if (!partOf_[j] || !turns[*partOf_[j]]) {
        continue;
      }
      const Part& part = doer_.frames.parts()[*partOf_[j]];
      carry[j] = facing * *turns[*partOf_[j]] * part.restTurn.conjugate() * facing.conjugate();
      const Quatd above = parent ? carry[parent->value] * rest_[parent->value] : Quatd::Identity();
      pose.local[j].rotation = (above.conjugate() * carry[j] * rest_[j]).normalized();
    }
    return pose;
  }

  /// \param offset of the pelvis from where it rests, metres, in the scene
  void movePelvis(Pose& pose, const Vec3d& offset) const {
    const auto parent = doer_.skeleton.joint(doer_.pelvis()).parent;
    const Affine3d above = parent ? doer_.skeleton.restFrame(*parent) : Affine3d::Identity();
    pose.local[doer_.pelvis().value].translation =
        above.inverse() * (doer_.skeleton.restPosition(doer_.pelvis()) + offset);
  }

 private:
  const Figure& doer_;
  std::vector<std::optional<std::size_t>> partOf_;
  std::vector<Quatd> rest_;
};

}  // namespace

Retargeted retarget(const Clip& clip, const Actor& shown, const Actor& doer, const RetargetOptions& options) {
  const Figure from(shown);
  const Figure to(doer);
  const Likeness likeness(from, to);
  const Doing doing(to);
  const std::vector<double> times = keyTimes(clip);
  LORICA_CHECK(!times.empty(), "a clip with keys");
  const double scale = to.leg / from.leg;

  Quatd heading = Quatd::Identity();
  Vec3d start = Vec3d::Zero();
  double turned = 0.0;
  double floor = std::numeric_limits<double>::infinity();
  std::vector<Pose> poses;
  std::vector<Vec3d> travelled;
  std::vector<double> lifts;
  for (const double time : times) {
    const std::vector<Affine3d> carry = carryTransforms(from.skeleton, sample(clip, from.skeleton, time));
    Turns turns = from.turns(carry);
    const Vec3d pelvis =
        from.frames.facing().conjugate() * (carry[from.pelvis().value] * from.skeleton.restPosition(from.pelvis()));
    if (poses.empty()) {
      const double yaw = ahead(turns.front());
      heading = Quatd(Eigen::AngleAxisd(yaw, Vec3d::UnitY()));
      turned = yaw * 180.0 / std::numbers::pi;
      start = pelvis;
    }
    for (Quatd& turn : turns) {
      turn = heading * turn;
    }
    poses.push_back(doing.pose(likeness.apply(turns)));
    travelled.emplace_back(heading * (pelvis - start));
    lifts.push_back(from.leastLift(carry));
    floor = std::min(floor, lifts.back());
  }
  double farthest = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Vec3d offset = to.frames.facing() * (scale * travelled[k]);
    offset.y() = 0.0;
    farthest = std::max(farthest, offset.norm());
    offset *= options.inPlace ? 0.0 : 1.0;
    offset.y() = scale * (lifts[k] - floor) - to.leastLift(carryTransforms(to.skeleton, poses[k]));
    doing.movePelvis(poses[k], offset);
  }
  std::vector<JointIndex> joints;
  for (const Part& part : to.frames.parts()) {
    joints.push_back(part.joint);
  }
  return {clipThrough(clip.name, to.skeleton, times, poses, joints, to.pelvis()), turned, farthest};
}

}  // namespace lorica::human
