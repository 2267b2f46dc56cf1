#include "gltf_animation.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cmath>
#include <set>

#include "gltf_accessor.h"

namespace lorica::io {

using human::Channel;
using human::ChannelPath;
using human::Clip;
using human::Interpolation;

namespace {

constexpr double quaternionTolerance = 1e-3;  // of the length

std::optional<ChannelPath> pathNamed(const std::string& name) {
  if (name == "translation") {
    return ChannelPath::translation;
  }
  if (name == "rotation") {
    return ChannelPath::rotation;
  }
  if (name == "scale") {
    return ChannelPath::scale;
  }
  return std::nullopt;
}

class ClipReader {
 public:
  ClipReader(const tinygltf::Model& model, std::size_t animation, const Rig& rig, Reading& reading)
      : model_(model),
        animation_(model.animations[animation]),
        rig_(rig),
        reading_(reading),
        accessors_(model, reading) {
    clip_.name = oneLine(animation_.name);
    place_ = fmt::format("animation {}{}", animation, clip_.name.empty() ? "" : " '" + clip_.name + "'");
    if (clip_.name.empty()) {
      clip_.name = fmt::format("clip_{}", animation);
    }
  }

  Clip read() {
    for (std::size_t c = 0; c < animation_.channels.size(); ++c) {
      readChannel(animation_.channels[c], fmt::format("{}, channel {}", place_, c));
    }
    if (unused_ > 0) {
      reading_.note(place_, fmt::format("{} of {} channels are not about the skin's joints and are not used", unused_,
                                        animation_.channels.size()));
    }
    if (nonUnit_ > 0) {
      reading_.warn(place_, fmt::format("{} rotations were no unit quaternions and were normalised", nonUnit_));
    }
    return std::move(clip_);
  }

 private:
  void readChannel(const tinygltf::AnimationChannel& source, const std::string& place) {
    if (source.sampler < 0 || static_cast<std::size_t>(source.sampler) >= animation_.samplers.size()) {
      reading_.fail(place, fmt::format("refers to sampler {}, but the animation has {}", source.sampler,
                                       animation_.samplers.size()));
    }
    if (source.target_node >= 0 && static_cast<std::size_t>(source.target_node) >= model_.nodes.size()) {
      reading_.fail(place,
                    fmt::format("moves node {}, but the file has {} nodes", source.target_node, model_.nodes.size()));
    }
    const std::optional<ChannelPath> path = pathNamed(source.target_path);
    const auto joint =
        source.target_node < 0 ? std::nullopt : rig_.jointOf[static_cast<std::size_t>(source.target_node)];
    if (!path || !joint) {
      ++unused_;
      return;
    }
    if (!moved_.insert({joint->value, *path}).second) {
      reading_.fail(place, fmt::format("moves the {} of a node that an earlier channel moves already",
                                       oneLine(source.target_path, 20)));
    }
    Channel channel;
    channel.joint = *joint;
    channel.path = *path;
    const tinygltf::AnimationSampler& sampler = animation_.samplers[static_cast<std::size_t>(source.sampler)];
    channel.interpolation = interpolation(sampler.interpolation, place);
    readTimes(channel, sampler.input, place);
    readValues(channel, sampler.output, place);
    clip_.channels.push_back(std::move(channel));
  }

  Interpolation interpolation(const std::string& name, const std::string& place) const {
    if (name.empty() || name == "LINEAR") {
      return Interpolation::linear;
    }
    if (name == "STEP") {
      return Interpolation::step;
    }
    if (name == "CUBICSPLINE") {
      return Interpolation::cubicSpline;
    }
    reading_.fail(place, fmt::format("has the unknown interpolation '{}'", oneLine(name, 40)));
  }

  void readTimes(Channel& channel, int accessor, const std::string& place) const {
    Elements elements = accessors_.numbers(accessor, Shape::scalar, {}, place + ", times");
    channel.times = std::move(elements.values);
    for (std::size_t k = 1; k < channel.times.size(); ++k) {
      if (channel.times[k] <= channel.times[k - 1]) {
        reading_.fail(place, fmt::format("its times do not rise: key {} is at {} s, the one before at {} s", k,
                                         channel.times[k], channel.times[k - 1]));
      }
    }
  }

  void readValues(Channel& channel, int accessor, const std::string& place) {
    const bool isRotation = channel.path == ChannelPath::rotation;
    const std::size_t width = isRotation ? 4 : 3;
    const Elements elements = accessors_.numbers(accessor, isRotation ? Shape::vec4 : Shape::vec3,
                                                 {.normalisedIntegers = true}, place + ", values");
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    const std::size_t expected = channel.times.size() * (cubic ? 3 : 1);
    if (elements.count != expected) {
      reading_.fail(place, fmt::format("has {} values for {} times; {} were expected", elements.count,
                                       channel.times.size(), expected));
    }
    channel.values.assign(expected, Eigen::Vector4d::Zero());
    for (std::size_t k = 0; k < expected; ++k) {
      for (std::size_t c = 0; c < width; ++c) {
        channel.values[k][static_cast<Eigen::Index>(c)] = elements.values[width * k + c];
      }
      const bool isTangent = cubic && k % 3 != 1;
      if (isRotation && !isTangent) {
        normalise(channel.values[k], k, place);
      }
    }
  }

  void normalise(Eigen::Vector4d& quaternion, std::size_t key, const std::string& place) {
    const double norm = quaternion.norm();
    if (norm == 0.0) {
      reading_.fail(place, fmt::format("value {} is the zero quaternion, which is no rotation", key));
    }
    nonUnit_ += std::abs(norm - 1.0) > quaternionTolerance ? 1 : 0;
    quaternion /= norm;
  }

  const tinygltf::Model& model_;
  const tinygltf::Animation& animation_;
  const Rig& rig_;
  Reading& reading_;
  AccessorReader accessors_;
  Clip clip_;
  std::string place_;
  std::set<std::pair<std::uint32_t, ChannelPath>> moved_;
  std::size_t unused_ = 0;
  std::size_t nonUnit_ = 0;
};

}  // namespace

std::vector<Clip> readClips(const tinygltf::Model& model, const Rig& rig, Reading& reading) {
  std::vector<Clip> clips;
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    Clip clip = ClipReader(model, a, rig, reading).read();
    if (!clip.channels.empty()) {
      clips.push_back(std::move(clip));
    }
  }
  return clips;
}

}  // namespace lorica::io
