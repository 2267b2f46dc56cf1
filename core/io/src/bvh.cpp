#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "lorica/base/files.h"
#include "lorica/base/units.h"
#include "lorica/io/motion.h"
#include "names.h"
#include "text_lines.h"

namespace lorica::io {

namespace {

using geometry::Quatd;
using geometry::Vec3d;

constexpr std::array<std::string_view, 6> channelWords{"Xposition", "Yposition", "Zposition",
                                                       "Xrotation", "Yrotation", "Zrotation"};
constexpr std::size_t kMostChannels = 6;
constexpr std::size_t kMostJoints = 10000;

/// One number of every frame.
struct FrameChannel {
  std::uint32_t joint = 0;
  std::size_t axis = 0;
  bool turns = false;
};

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\v\f";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Reads the hierarchy, then the motion.
class BvhReader {
 public:
  BvhReader(std::string_view bytes, Reading& reading) : lines_(bytes, reading), reading_(reading) {}

  Motion read(std::optional<UpAxis> up) {
    expect("HIERARCHY");
    while (!same(next("a ROOT or the word MOTION"), "MOTION")) {
      readTree();
    }
    if (joints_.empty()) {
      lines_.fail("the motion begins, and there was no ROOT before it");
    }
    if (channels_.empty()) {
      lines_.fail("no joint has CHANNELS, so there is nothing that moves");
    }
    Motion motion;
    readTiming(motion);
    motion.upGuessed = !up;
    motion.up = up.value_or(guessedUp());
    readFrames(motion);
    motion.skeleton = skeleton(motion.up);
    return motion;
  }

 private:
  std::string_view next(std::string_view what) {
    std::string_view word = lines_.word();
    while (word.empty()) {
      lines_.nextWith(what);
      word = lines_.word();
    }
    word_ = word;
    return word;
  }

  void expect(std::string_view wanted) {
    if (!same(next(wanted), wanted)) {
      unexpected(wanted);
    }
  }

  /// A word that some programs write without its colon.
  void expectLabel(std::string_view wanted) {
    const std::string_view word = next(wanted);
    if (!same(word, wanted) && !same(word, wanted.substr(0, wanted.size() - 1))) {
      unexpected(wanted);
    }
  }

  [[noreturn]] void unexpected(std::string_view wanted) {
    lines_.fail(fmt::format("{} was expected, not '{}'", wanted, oneLine(word_, 40)));
  }

  double number(std::string_view what) {
    const std::optional<double> value = numberIn(next(what));
    if (!value) {
      unexpected(what);
    }
    return *value;
  }

  Vec3d offset() {
    const double x = number("the x of an OFFSET");
    const double y = number("the y of an OFFSET");
    return {x, y, number("the z of an OFFSET")};
  }

  /// A name is what remains of the line; the brace may stand on it too.
  std::string takeName(bool& opened) {
    std::string_view rest = trimmed(lines_.remainder());
    opened = rest.ends_with('{');
    rest = trimmed(rest.substr(0, rest.size() - (opened ? 1 : 0)));
    while (!lines_.word().empty()) {
    }
    return names_.take(rest, fmt::format("joint_{}", joints_.size()));
  }

  void beginJoint(std::optional<std::uint32_t> parent) {
    if (joints_.size() == kMostJoints) {
      lines_.fail(fmt::format("has more than {} joints", kMostJoints));
    }
    bool opened = false;
    human::Joint joint{takeName(opened), std::nullopt, {}};
    if (parent) {
      joint.parent = human::JointIndex{*parent};
    }
    joints_.push_back(std::move(joint));
    if (!opened) {
      expect("{");
    }
  }

  /// A ROOT and all that hangs on it.
  void readTree() {
    if (!same(word_, "ROOT")) {
      unexpected("ROOT or MOTION");
    }
    std::vector<std::uint32_t> open;
    const auto begin = [&](std::optional<std::uint32_t> parent) {
      beginJoint(parent);
      open.push_back(static_cast<std::uint32_t>(joints_.size() - 1));
    };
    begin(std::nullopt);
    while (!open.empty()) {
      const std::string_view word = next("a JOINT, an End Site or a closing brace");
      if (same(word, "OFFSET")) {
        joints_[open.back()].rest.translation = offset();
      } else if (same(word, "CHANNELS")) {
        readChannels(open.back());
      } else if (same(word, "JOINT")) {
        begin(open.back());
      } else if (same(word, "End")) {
        readEnd(open.back());
      } else if (word == "}") {
        open.pop_back();
      } else {
        unexpected("OFFSET, CHANNELS, JOINT, End Site or a closing brace");
      }
    }
  }

  void readEnd(std::uint32_t joint) {
    expect("Site");
    expect("{");
    expect("OFFSET");
    ends_.emplace_back(joint, offset());
    expect("}");
  }

  void readChannels(std::uint32_t joint) {
    const double count = number("the number of channels");
    if (count < 0.0 || count > static_cast<double>(kMostChannels) || count != std::floor(count)) {
      lines_.fail(fmt::format("a joint has 0 to {} channels, not {}", kMostChannels, count));
    }
    if (std::any_of(channels_.begin(), channels_.end(), [&](const FrameChannel& c) { return c.joint == joint; })) {
      lines_.fail(fmt::format("the joint \"{}\" has two lists of channels", joints_[joint].name));
    }
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const std::string_view word = next("the name of a channel");
      const auto found = std::find_if(channelWords.begin(), channelWords.end(),
                                      [&](std::string_view known) { return same(known, word); });
      if (found == channelWords.end()) {
        unexpected("Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation");
      }
      const auto which = static_cast<std::size_t>(found - channelWords.begin());
      channels_.push_back({joint, which % 3, which >= 3});
    }
  }

  void readTiming(Motion& motion) {
    expectLabel("Frames:");
    const double frames = number("the number of frames");
    if (frames < 1.0 || frames != std::floor(frames)) {
      lines_.fail("the number of frames was expected, a whole number of at least 1");
    }
    expect("Frame");
    expectLabel("Time:");
    motion.frameSeconds = number("the seconds of a frame");
    if (motion.frameSeconds <= 0.0) {
      lines_.fail("the time of a frame was expected, seconds above 0");
    }
    // A number takes two letters at least, the last one its digit alone.
    if (frames * static_cast<double>(channels_.size()) > static_cast<double>(lines_.bytesLeft() / 2 + 1)) {
      lines_.fail(fmt::format("says that {} frames of {} numbers follow, and the file is too short for them", frames,
                              channels_.size()));
    }
    motion.frames = static_cast<std::size_t>(frames);
  }

  Vec3d along(const Vec3d& v, UpAxis up) const { return up == UpAxis::y ? v : Vec3d(v.x(), v.z(), -v.y()); }

  std::vector<Vec3d> restPlaces() const {
    std::vector<Vec3d> places;
    places.reserve(joints_.size() + ends_.size());
    for (const human::Joint& joint : joints_) {
      places.emplace_back(joint.rest.translation + (joint.parent ? places[joint.parent->value] : Vec3d::Zero()));
    }
    for (const auto& [joint, offset] : ends_) {
      places.emplace_back(places[joint] + offset);
    }
    return places;
  }

  /// Nobody is deeper than tall.
  UpAxis guessedUp() const {
    Eigen::AlignedBox3d box;
    for (const Vec3d& place : restPlaces()) {
      box.extend(place);
    }
    return box.sizes().z() > box.sizes().y() ? UpAxis::z : UpAxis::y;
  }

  human::Skeleton skeleton(UpAxis up) {
    for (human::Joint& joint : joints_) {
      joint.rest.translation = along(joint.rest.translation, up);
    }
    return human::Skeleton(joints_);
  }

  void readFrames(Motion& motion) {
    std::vector<double> times(motion.frames);
    for (std::size_t f = 0; f < times.size(); ++f) {
      times[f] = static_cast<double>(f) * motion.frameSeconds;
    }
    std::vector<std::optional<std::size_t>> turns(joints_.size());
    std::vector<std::optional<std::size_t>> moves(joints_.size());
    for (const FrameChannel& channel : channels_) {
      auto& place = (channel.turns ? turns : moves)[channel.joint];
      if (!place) {
        place = motion.clip.channels.size();
        motion.clip.channels.push_back({human::JointIndex{std::size_t{channel.joint}},
                                        channel.turns ? human::ChannelPath::rotation : human::ChannelPath::translation,
                                        human::Interpolation::linear, times,
                                        std::vector<Eigen::Vector4d>(motion.frames, Eigen::Vector4d::Zero())});
      }
    }
    std::vector<Quatd> rotation(joints_.size());
    std::vector<Vec3d> translation(joints_.size());
    for (std::size_t f = 0; f < motion.frames; ++f) {
      readFrame(f, rotation, translation);
      for (std::size_t j = 0; j < joints_.size(); ++j) {
        if (turns[j]) {
          const Vec3d axis = along(rotation[j].vec(), motion.up);
          motion.clip.channels[*turns[j]].values[f] << axis, rotation[j].w();
        }
        if (moves[j]) {
          motion.clip.channels[*moves[j]].values[f].head<3>() = along(translation[j], motion.up);
        }
      }
    }
    do {
      if (!lines_.word().empty()) {
        reading_.note(
            fmt::format("line {}", lines_.lineNumber()),
            fmt::format("there is more than {} frames of {} numbers; it is not used", motion.frames, channels_.size()));
        return;
      }
    } while (lines_.next());
  }

  void readFrame(std::size_t frame, std::vector<Quatd>& rotation, std::vector<Vec3d>& translation) {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      rotation[j] = Quatd::Identity();
      translation[j] = joints_[j].rest.translation;
    }
    for (const FrameChannel& channel : channels_) {
      const std::size_t word = channel.axis + (channel.turns ? 3 : 0);
      std::string_view text = lines_.word();
      while (text.empty()) {
        lines_.nextWith(fmt::format("frame {}", frame));
        text = lines_.word();
      }
      const std::optional<double> value = numberIn(text);
      if (!value) {
        lines_.fail(fmt::format("{} of joint \"{}\" in frame {} was expected, not '{}'", channelWords.at(word),
                                joints_[channel.joint].name, frame, oneLine(text, 40)));
      }
      const Vec3d axis = Vec3d::Unit(static_cast<Eigen::Index>(channel.axis));
      if (channel.turns) {
        rotation[channel.joint] = rotation[channel.joint] * Quatd(Eigen::AngleAxisd(base::radians(*value), axis));
      } else {
        translation[channel.joint][static_cast<Eigen::Index>(channel.axis)] = *value;
      }
    }
    for (Quatd& turn : rotation) {
      turn.normalize();
    }
  }

  TextLines lines_;
  Reading& reading_;
  std::string_view word_;
  UniqueNames names_;
  std::vector<human::Joint> joints_;
  std::vector<std::pair<std::uint32_t, Vec3d>> ends_;
  std::vector<FrameChannel> channels_;
};

}  // namespace

namespace {

/// How far a joint turns from frame 0 to frame 1, where that is a jump and not a movement: degrees, else 0.
double jumpAtTheStart(const human::Channel& channel) {
  constexpr double jump = 15.0;  // degrees from frame to frame that nobody turns a joint by
  constexpr double times = 5.0;  // as far as to the frame that follows
  const auto turn = [&](std::size_t frame) {
    return base::degrees(Quatd(channel.values[frame]).angularDistance(Quatd(channel.values[frame + 1])));
  };
  return turn(0) > std::max(jump, times * turn(1)) ? turn(0) : 0.0;
}

void leaveOutCalibration(Motion& motion, Reading& reading) {
  double largest = 0.0;
  for (const human::Channel& channel : motion.clip.channels) {
    if (motion.frames > 2 && channel.path == human::ChannelPath::rotation) {
      largest = std::max(largest, jumpAtTheStart(channel));
    }
  }
  if (largest == 0.0) {
    return;
  }
  for (human::Channel& channel : motion.clip.channels) {
    channel.times.erase(channel.times.begin());
    channel.values.erase(channel.values.begin());
  }
  reading.note("frame 0", fmt::format("is left out: the next one turns a joint by {:.0f} degrees, as after a pose that "
                                      "the recording was calibrated with",
                                      largest));
}

}  // namespace

Motion importMotion(const std::filesystem::path& path, std::optional<UpAxis> up) {
  return importMotion(path, base::readFile(path), up);
}

Motion importMotion(const std::filesystem::path& path, std::string_view bytes, std::optional<UpAxis> up) {
  Reading reading(path);
  Motion motion = BvhReader(bytes, reading).read(up);
  leaveOutCalibration(motion, reading);
  motion.clip.name = oneLine(path.stem().string());
  motion.issues = reading.takeIssues();
  return motion;
}

}  // namespace lorica::io
