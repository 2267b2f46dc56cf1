#include "lorica/human/clip.h"

#include <algorithm>

#include "lorica/base/error.h"

namespace lorica::human {

using Eigen::Vector4d;
using geometry::Quatd;

namespace {

Quatd quaternion(const Vector4d& v) {
  return Quatd(v.w(), v.x(), v.y(), v.z()).normalized();
}

/// Value of a channel between keys `k` and `k + 1`, `u` from 0 to 1 between them (glTF 2.0, appendix C).
Vector4d between(const Channel& channel, std::size_t k, double u) {
  if (channel.interpolation == Interpolation::cubicSpline) {
    const double step = channel.times[k + 1] - channel.times[k];
    const Vector4d& value0 = channel.values[3 * k + 1];
    const Vector4d& out0 = channel.values[3 * k + 2];
    const Vector4d& in1 = channel.values[3 * (k + 1)];
    const Vector4d& value1 = channel.values[3 * (k + 1) + 1];
    const double u2 = u * u;
    const double u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * value0 + step * (u3 - 2 * u2 + u) * out0 + (-2 * u3 + 3 * u2) * value1 +
           step * (u3 - u2) * in1;
  }
  if (channel.interpolation == Interpolation::step || u == 0.0) {
    return channel.values[k];
  }
  if (channel.path == ChannelPath::rotation) {
    return quaternion(channel.values[k]).slerp(u, quaternion(channel.values[k + 1])).coeffs();
  }
  return (1.0 - u) * channel.values[k] + u * channel.values[k + 1];
}

Vector4d valueAt(const Channel& channel, double seconds) {
  const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), seconds);
  const bool cubic = channel.interpolation == Interpolation::cubicSpline;
  const auto key = [&](std::size_t k) { return channel.values[cubic ? 3 * k + 1 : k]; };
  if (after == channel.times.begin()) {
    return key(0);
  }
  const auto k = static_cast<std::size_t>(after - channel.times.begin()) - 1;
  if (after == channel.times.end()) {
    return key(k);
  }
  return between(channel, k, (seconds - channel.times[k]) / (channel.times[k + 1] - channel.times[k]));
}

}  // namespace

double Clip::duration() const {
  double last = 0.0;
  for (const Channel& channel : channels) {
    last = channel.times.empty() ? last : std::max(last, channel.times.back());
  }
  return last;
}

Pose sample(const Clip& clip, const Skeleton& skeleton, double seconds) {
  Pose pose = restPose(skeleton);
  for (const Channel& channel : clip.channels) {
    LORICA_CHECK(channel.joint.value < skeleton.size() && !channel.times.empty(), "channels belong to the skeleton");
    const Vector4d value = valueAt(channel, seconds);
    Trs& local = pose.local[channel.joint.value];
    switch (channel.path) {
      case ChannelPath::translation:
        local.translation = value.head<3>();
        break;
      case ChannelPath::rotation:
        local.rotation = quaternion(value);
        break;
      case ChannelPath::scale:
        local.scale = value.head<3>();
        break;
    }
  }
  return pose;
}

Clip clipThrough(std::string name, const Skeleton& skeleton, const std::vector<double>& times,
                 const std::vector<Pose>& poses, std::span<const JointIndex> turned, JointIndex moved) {
  LORICA_CHECK(!times.empty() && times.size() == poses.size(), "a time for every pose");
  Clip clip{std::move(name), {}};
  const auto channelOf = [&](JointIndex joint, ChannelPath path, const auto& valueOf) {
    Channel channel{joint, path, Interpolation::linear, times, {}};
    channel.values.reserve(poses.size());
    for (const Pose& pose : poses) {
      Vector4d value = valueOf(pose.local[joint.value]);
      if (path == ChannelPath::rotation && !channel.values.empty() && channel.values.back().dot(value) < 0.0) {
        value = -value;
      }
      channel.values.push_back(value);
    }
    return channel;
  };
  const auto translation = [](const Trs& local) {
    return Vector4d(local.translation.x(), local.translation.y(), local.translation.z(), 0.0);
  };
  const auto rotation = [](const Trs& local) { return Vector4d(local.rotation.coeffs()); };
  const auto addWhereMoved = [&](JointIndex joint, ChannelPath path, const auto& valueOf) {
    Channel channel = channelOf(joint, path, valueOf);
    const Vector4d rest = valueOf(skeleton.joint(joint).rest);
    if (std::any_of(channel.values.begin(), channel.values.end(), [&](const Vector4d& v) { return v != rest; })) {
      clip.channels.push_back(std::move(channel));
    }
  };
  addWhereMoved(moved, ChannelPath::translation, translation);
  for (const JointIndex joint : turned) {
    addWhereMoved(joint, ChannelPath::rotation, rotation);
  }
  if (clip.channels.empty()) {
    // Rest all the time is a motion too, as long as it lasts.
    clip.channels.push_back(channelOf(moved, ChannelPath::translation, translation));
  }
  return clip;
}

}  // namespace lorica::human
