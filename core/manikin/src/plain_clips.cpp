#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "body_shape.h"
#include "lorica/base/units.h"
#include "plain_parts.h"

namespace lorica::manikin {

namespace {

using base::radians;
using geometry::Quatd;

constexpr double kKeysPerSecond = 30.0;

Quatd about(const Vec3d& axis, double degrees) {
  return Quatd(Eigen::AngleAxisd(radians(degrees), axis));
}
Quatd aboutX(double degrees) {
  return about(Vec3d::UnitX(), degrees);
}
Quatd aboutY(double degrees) {
  return about(Vec3d::UnitY(), degrees);
}
Quatd aboutZ(double degrees) {
  return about(Vec3d::UnitZ(), degrees);
}

/// A moment of a motion: turns of joints against rest and where the pelvis is.
struct Moment {
  std::map<std::uint32_t, Quatd> turns;
  Vec3d pelvisShift = Vec3d::Zero();

  void turn(std::uint32_t bone, const Quatd& rotation) { turns[bone] = rotation; }
  /// The same turn on both sides, mirrored.
  void turnBoth(Bone bone, const Quatd& left) {
    turns[bone] = left;
    turns[bone + kSideStride] = Quatd(left.w(), left.x(), -left.y(), -left.z());
  }
};

using Motion = std::function<Moment(double seconds)>;

human::Clip keyed(const std::string& name, double duration, const Motion& motion) {
  const int last = static_cast<int>(std::lround(duration * kKeysPerSecond));
  human::Clip clip{name, {}};
  const auto channel = [&](std::uint32_t bone, human::ChannelPath path) -> human::Channel& {
    for (human::Channel& known : clip.channels) {
      if (known.joint.value == bone && known.path == path) {
        return known;
      }
    }
    clip.channels.push_back({human::JointIndex{bone}, path, human::Interpolation::linear, {}, {}});
    return clip.channels.back();
  };
  const Vec3d pelvis = restPositions()[pelvisRoot];
  for (int key = 0; key <= last; ++key) {
    const double seconds = key / kKeysPerSecond;
    const Moment moment = motion(seconds);
    human::Channel& shift = channel(pelvisRoot, human::ChannelPath::translation);
    shift.times.push_back(seconds);
    const Vec3d place = pelvis + moment.pelvisShift;
    shift.values.emplace_back(place.x(), place.y(), place.z(), 0.0);
    for (const auto& [bone, rotation] : moment.turns) {
      human::Channel& turning = channel(bone, human::ChannelPath::rotation);
      turning.times.push_back(seconds);
      turning.values.push_back(rotation.coeffs());
    }
  }
  return clip;
}

/// From 0 to 1 at half the duration and back, at rest at both ends.
double thereAndBack(double seconds, double duration) {
  const double s = std::sin(std::numbers::pi * seconds / duration);
  return s * s;
}

/// To the left at a quarter of the duration, to the right at three quarters.
double leftAndRight(double seconds, double duration) {
  return std::sin(2.0 * std::numbers::pi * seconds / duration);
}

/// Degrees each spine joint takes of a whole; lumbar, thoracic and neck joints in their order.
void turnSpine(Moment& moment, const std::array<double, 7>& shares, const std::function<Quatd(double)>& rotation) {
  for (std::uint32_t i = 0; i < shares.size(); ++i) {
    const auto bone = static_cast<std::uint32_t>(spineL5S1 + i);
    const auto known = moment.turns.find(bone);
    const Quatd turned = rotation(shares[i]);
    moment.turn(bone, known == moment.turns.end() ? turned : Quatd(known->second * turned));
  }
}

/// Legs in the plane of walking: ankles stay, shank and thigh lean (degrees, positive forward at their upper end).
void standOn(Moment& moment, double pelvisTilt, double shankLean, double thighLean) {
  const auto& joints = restPositions();
  moment.pelvisShift = aboutX(shankLean) * (joints[knee] - joints[ankle]) +
                       aboutX(thighLean) * (joints[hip] - joints[knee]) - (joints[hip] - joints[ankle]);
  moment.turn(pelvisRoot, aboutX(pelvisTilt));
  moment.turnBoth(hip, aboutX(thighLean - pelvisTilt));
  moment.turnBoth(knee, aboutX(shankLean - thighLean));
  moment.turnBoth(ankle, aboutX(-shankLean));
}

Moment toeTouch(double seconds) {
  const double amount = thereAndBack(seconds, 4.0);
  Moment moment;
  standOn(moment, 74.0 * amount, -6.0 * amount, -6.0 * amount);
  turnSpine(moment, {15.0, 15.0, 15.0, 9.0, 9.0, 7.0, 5.0}, [&](double d) { return aboutX(d * amount); });
  moment.turnBoth(sternoclavicular, aboutX(-15.0 * amount));
  moment.turnBoth(glenohumeral, aboutX(-112.0 * amount) * aboutZ(-18.0 * amount));
  return moment;
}

Moment bellyTwist(double seconds) {
  const double amount = leftAndRight(seconds, 4.0);
  Moment moment;
  turnSpine(moment, {3.0, 3.0, 4.0, 10.0, 10.0, 10.0, 8.0}, [&](double d) { return aboutY(d * amount); });
  return moment;
}

Moment lateralTwist(double seconds) {
  const double amount = leftAndRight(seconds, 4.0);
  Moment moment;
  turnSpine(moment, {4.0, 7.0, 7.0, 6.0, 4.0, 2.0, 4.0}, [&](double d) { return aboutZ(-d * amount); });
  turnSpine(moment, {1.0, 1.0, 2.0, 6.0, 6.0, 4.0, 4.0}, [&](double d) { return aboutY(d * amount); });
  return moment;
}

Moment squat(double seconds) {
  const double amount = thereAndBack(seconds, 3.5);
  Moment moment;
  standOn(moment, 25.0 * amount, 28.0 * amount, -72.0 * amount);
  turnSpine(moment, {5.0, 5.0, 5.0, 2.0, 0.0, 0.0, -12.0}, [&](double d) { return aboutX(d * amount); });
  moment.turnBoth(glenohumeral, aboutX(-80.0 * amount) * aboutZ(-15.0 * amount));
  return moment;
}

}  // namespace

std::vector<human::Clip> plainClips() {
  return {keyed("toe_touch", 4.0, toeTouch), keyed("belly_twist", 4.0, bellyTwist),
          keyed("lateral_twist", 4.0, lateralTwist), keyed("squat", 3.5, squat)};
}

}  // namespace lorica::manikin
