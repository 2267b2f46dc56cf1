#pragma once

/// \file
/// Motion clips: keyed channels on joints, as glTF 2.0 defines them (appendix C for the interpolations).

#include <span>
#include <string>
#include <vector>

#include "lorica/human/skeleton.h"

namespace lorica::human {

enum class ChannelPath { translation, rotation, scale };
enum class Interpolation { step, linear, cubicSpline };

/// Keys of one property of one joint.
struct Channel {
  JointIndex joint;
  ChannelPath path = ChannelPath::rotation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times;  ///< seconds, strictly rising, at least one
  /// Translation (metres) and scale use x, y, z; rotations are unit quaternions x, y, z, w. One value per time; three
  /// (in-tangent, value, out-tangent) for cubicSpline.
  std::vector<Eigen::Vector4d> values;
};

struct Clip {
  std::string name;
  std::vector<Channel> channels;

  /// Time of the last key of any channel, seconds.
  double duration() const;
};

/// The pose at a time. Joints without a channel are at rest; before the first key and after the last one the nearest
/// key holds.
/// \pre every channel's joint is below skeleton.size()
Pose sample(const Clip& clip, const Skeleton& skeleton, double seconds);

/// The clip that goes through poses, linearly between them. Of the joints in `turned` it has the rotations, of `moved`
/// the translation, each only where it differs from rest at some time. \pre as many times as poses, strictly rising
Clip clipThrough(std::string name, const Skeleton& skeleton, const std::vector<double>& times,
                 const std::vector<Pose>& poses, std::span<const JointIndex> turned, JointIndex moved);

}  // namespace lorica::human
