#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "lorica/base/error.h"
#include "lorica/human/joint_limits.h"
#include "role_checks.h"

namespace lorica::human {

namespace {

/// What a joint's name says: its words without side, numbers and the prefixes that rigs share.
struct Spelling {
  std::string key;           ///< words joined, lower case: "upleg"
  std::vector<int> numbers;  ///< in their order
  Side side = Side::middle;
};

enum class Letter { lower, upper, digit, other };

Letter letterOf(char c) {
  const auto u = static_cast<unsigned char>(c);
  if (std::isdigit(u) != 0) {
    return Letter::digit;
  }
  if (std::isalpha(u) == 0) {
    return Letter::other;
  }
  return std::isupper(u) != 0 ? Letter::upper : Letter::lower;
}

/// "mixamorig:LHipJoint_01" gives l, hip, joint, 01.
std::vector<std::string> wordsOf(std::string_view name) {
  name.remove_prefix(std::min(name.rfind(':') + 1, name.size()));
  std::vector<std::string> words;
  Letter before = Letter::other;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const Letter now = letterOf(name[i]);
    const Letter after = i + 1 < name.size() ? letterOf(name[i + 1]) : Letter::other;
    const bool hump =
        now == Letter::upper && (before == Letter::lower || (before == Letter::upper && after == Letter::lower));
    const bool digits = (now == Letter::digit) != (before == Letter::digit);
    if (now != Letter::other) {
      if (before == Letter::other || hump || digits) {
        words.emplace_back();
      }
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    before = now;
  }
  return words;
}

Spelling spellingOf(std::string_view name) {
  // Rig makers' marks: Mixamo, Rigify (deform, original), VRoid (J_Bip_C_), 3ds Max and Source (Bip01, ValveBiped).
  static constexpr std::array<std::string_view, 8> marks{"mixamorig", "def", "org", "j", "bip", "c", "valve", "biped"};
  Spelling spelling;
  for (const std::string& word : wordsOf(name)) {
    if (word == "left" || word == "l") {
      spelling.side = Side::left;
    } else if (word == "right" || word == "r") {
      spelling.side = Side::right;
    } else if (letterOf(word.front()) == Letter::digit) {
      spelling.numbers.push_back(word.size() < 4 ? std::stoi(word) : 0);
    } else if (std::find(marks.begin(), marks.end(), word) == marks.end()) {
      spelling.key += word;
    }
  }
  // All in lower case, "leftarm".
  for (const auto& [word, side] : {std::pair{std::string_view("left"), Side::left}, {"right", Side::right}}) {
    if (spelling.side == Side::middle && spelling.key.starts_with(word) && spelling.key.size() > word.size()) {
      spelling.side = side;
      spelling.key.erase(0, word.size());
    }
  }
  return spelling;
}

using Keys = std::span<const std::string_view>;

constexpr std::array<std::string_view, 4> kPelvis{"pelvisroot", "pelvis", "hips", "hip"};
constexpr std::array<std::string_view, 1> kRoot{"root"};
constexpr std::array<std::string_view, 1> kHead{"head"};
constexpr std::array<std::string_view, 7> kShoulder{"glenohumeral", "upperarm", "uparm",   "arm",
                                                    "shldr",        "humerus",  "shoulder"};
constexpr std::array<std::string_view, 7> kClavicle{"sternoclavicular", "acromioclavicular", "clavicle", "collar",
                                                    "collarbone",       "scapula",           "shoulder"};
constexpr std::array<std::string_view, 4> kElbow{"elbow", "forearm", "lowerarm", "lowarm"};
constexpr std::array<std::string_view, 5> kTwist{"radioulnar", "forearmtwist", "lowerarmtwist", "forearmroll",
                                                 "foretwist"};
constexpr std::array<std::string_view, 2> kWrist{"wrist", "hand"};
constexpr std::array<std::string_view, 5> kHip{"upleg", "upperleg", "thigh", "femur", "hip"};
constexpr std::array<std::string_view, 7> kKnee{"knee", "lowerleg", "lowleg", "shin", "calf", "shank", "leg"};
constexpr std::array<std::string_view, 2> kAnkle{"ankle", "foot"};
constexpr std::array<std::string_view, 5> kToe{"toemtp", "toebase", "toe", "toes", "ball"};

std::optional<Role> fingerOf(const Spelling& spelling) {
  const std::string& key = spelling.key;
  const auto says = [&](std::string_view word) { return key.find(word) != std::string::npos; };
  if (says("thumb")) {
    return Role::thumb;
  }
  if (says("metacarpal")) {
    return std::nullopt;
  }
  if (says("index")) {
    return Role::index;
  }
  if (says("middle")) {
    return Role::middle;
  }
  if (says("ring")) {
    return Role::ring;
  }
  if (says("little") || says("pinky")) {
    return Role::little;
  }
  // MakeHuman counts the fingers; motion-capture rigs have one for all.
  constexpr std::array counted{Role::thumb, Role::index, Role::middle, Role::ring, Role::little};
  if (key == "finger" && spelling.numbers.size() == 2 && spelling.numbers[0] >= 1 && spelling.numbers[0] <= 5) {
    return counted.at(static_cast<std::size_t>(spelling.numbers[0] - 1));
  }
  return says("finger") ? std::optional(Role::middle) : std::nullopt;
}

class Finder {
 public:
  explicit Finder(const Skeleton& skeleton) : skeleton_(skeleton) {
    spellings_.reserve(skeleton.size());
    for (const Joint& joint : skeleton.joints()) {
      spellings_.push_back(spellingOf(joint.name));
    }
  }

  RoleMap find() {
    for (const Side side : {Side::left, Side::right}) {
      findArm(side);
      findLeg(side);
    }
    findPelvis();
    findSpine();
    return std::move(roles_);
  }

 private:
  std::vector<JointIndex> named(Keys keys, Side side) const {
    std::vector<JointIndex> found;
    for (std::size_t j = 0; j < spellings_.size(); ++j) {
      const Spelling& spelling = spellings_[j];
      if (spelling.side == side && std::find(keys.begin(), keys.end(), spelling.key) != keys.end()) {
        found.emplace_back(j);
      }
    }
    return found;
  }

  /// The uppermost joint with the first key that any joint has.
  std::vector<JointIndex> first(Keys keys, Side side) const {
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::vector<JointIndex> found = named(keys.subspan(k, 1), side);
      if (!found.empty()) {
        return {found.front()};
      }
    }
    return {};
  }

  /// From the joint up to the root.
  std::vector<JointIndex> pathUp(JointIndex joint) const {
    std::vector<JointIndex> path;
    for (std::optional<JointIndex> j = joint; j; j = skeleton_.joint(*j).parent) {
      path.push_back(*j);
    }
    return path;
  }

  bool isBelow(JointIndex joint, JointIndex ancestor) const {
    const std::vector<JointIndex> path = pathUp(joint);
    return joint != ancestor && std::find(path.begin(), path.end(), ancestor) != path.end();
  }

  std::optional<JointIndex> commonAbove(Role role) const {
    const auto left = roles_.joint(role, Side::left);
    const auto right = roles_.joint(role, Side::right);
    if (!left || !right) {
      return std::nullopt;
    }
    for (const JointIndex joint : pathUp(*left)) {
      if (isBelow(*right, joint)) {
        return joint;
      }
    }
    return std::nullopt;
  }

  void findArm(Side side) {
    roles_.set(Role::shoulder, side, first(kShoulder, side));
    const auto shoulder = roles_.joint(Role::shoulder, side);
    if (!shoulder) {
      return;
    }
    std::vector<JointIndex> girdle;
    for (const JointIndex joint : named(kClavicle, side)) {
      if (isBelow(*shoulder, joint)) {
        girdle.push_back(joint);
      }
    }
    roles_.set(Role::clavicle, side, std::move(girdle));
    roles_.set(Role::elbow, side, first(kElbow, side));
    roles_.set(Role::wrist, side, first(kWrist, side));
    const auto elbow = roles_.joint(Role::elbow, side);
    const auto wrist = roles_.joint(Role::wrist, side);
    if (!elbow || !wrist) {
      return;
    }
    // A forearm cut in two twists at its second half.
    for (const Keys keys : {Keys(kTwist), Keys(kElbow)}) {
      for (const JointIndex joint : named(keys, side)) {
        if (isBelow(joint, *elbow) && isBelow(*wrist, joint) && !roles_.joint(Role::forearmTwist, side)) {
          roles_.set(Role::forearmTwist, side, {joint});
        }
      }
    }
    findFingers(side, *wrist);
  }

  void findFingers(Side side, JointIndex wrist) {
    std::array<std::vector<JointIndex>, kRoles> fingers;
    for (std::size_t j = 0; j < spellings_.size(); ++j) {
      const auto finger = fingerOf(spellings_[j]);
      if (finger && spellings_[j].side == side && isBelow(JointIndex{j}, wrist)) {
        fingers.at(static_cast<std::size_t>(*finger)).emplace_back(j);
      }
    }
    for (const Role finger : {Role::thumb, Role::index, Role::middle, Role::ring, Role::little}) {
      roles_.set(finger, side, std::move(fingers.at(static_cast<std::size_t>(finger))));
    }
  }

  void findLeg(Side side) {
    roles_.set(Role::hip, side, first(kHip, side));
    roles_.set(Role::knee, side, first(kKnee, side));
    roles_.set(Role::ankle, side, first(kAnkle, side));
    std::vector<JointIndex> toes = named(kToe, side);
    const std::vector<JointIndex> all = toes;
    std::erase_if(toes, [&](JointIndex joint) {
      return std::any_of(all.begin(), all.end(), [&](JointIndex other) { return isBelow(joint, other); });
    });
    roles_.set(Role::toe, side, std::move(toes));
  }

  void findPelvis() {
    const auto common = commonAbove(Role::hip);
    const auto shoulders = commonAbove(Role::shoulder);
    for (const Keys keys : {Keys(kPelvis), Keys(kRoot)}) {
      for (const JointIndex joint : first(keys, Side::middle)) {
        const bool bears =
            common && (joint == *common || isBelow(*common, joint)) && shoulders && isBelow(*shoulders, joint);
        if (!roles_.joint(Role::pelvis) && bears) {
          roles_.set(Role::pelvis, Side::middle, {joint});
        }
      }
    }
    // Rigs without one by name hang legs and trunk on the same joint.
    if (!roles_.joint(Role::pelvis) && common) {
      roles_.set(Role::pelvis, Side::middle, {*common});
    }
  }

  void findSpine() {
    const auto pelvis = roles_.joint(Role::pelvis);
    const auto top = commonAbove(Role::shoulder);
    if (!pelvis || !top || !isBelow(*top, *pelvis)) {
      return;
    }
    std::vector<JointIndex> lumbar;
    std::vector<JointIndex> thoracic;
    for (const JointIndex joint : pathUp(*top)) {
      if (joint == *pelvis) {
        break;
      }
      (isThoracic(joint) ? thoracic : lumbar).push_back(joint);
    }
    roles_.set(Role::lumbar, Side::middle, std::move(lumbar));
    roles_.set(Role::thoracic, Side::middle, std::move(thoracic));
    findNeck(*top);
  }

  bool isThoracic(JointIndex joint) const {
    if (const auto level = spineLevel(skeleton_.joint(joint).name)) {
      return *level >= kFirstThoracicLevel;
    }
    const auto height = [&](Role role) {
      return 0.5 * (skeleton_.restPosition(*roles_.joint(role, Side::left)).y() +
                    skeleton_.restPosition(*roles_.joint(role, Side::right)).y());
    };
    // Where T12/L1 lies between hip and shoulder joints, a little below it.
    constexpr double border = 0.54;
    const double hips = height(Role::hip);
    return skeleton_.restPosition(joint).y() > hips + border * (height(Role::shoulder) - hips);
  }

  void findNeck(JointIndex top) {
    std::vector<JointIndex> neck;
    std::vector<JointIndex> head = first(kHead, Side::middle);
    for (std::size_t j = 0; j < spellings_.size(); ++j) {
      const std::string& key = spellings_[j].key;
      const bool cervical = spineLevel(skeleton_.joints()[j].name).has_value();
      const bool says = cervical || key.find("neck") != std::string::npos || key == "spine";
      const bool belowHead = !head.empty() && (isBelow(JointIndex{j}, head.front()) || JointIndex{j} == head.front());
      if (says && spellings_[j].side == Side::middle && isBelow(JointIndex{j}, top) && !belowHead) {
        neck.emplace_back(j);
      }
    }
    for (std::size_t j = 0; j < spellings_.size(); ++j) {
      if (skeleton_.joints()[j].name == "head_C0C1") {
        head = {JointIndex{j}};
      }
    }
    // Rigify numbers its spine up to the head.
    if (head.empty() && neck.size() > 1) {
      head = {neck.back()};
      neck.pop_back();
    }
    std::erase_if(neck, [&](JointIndex joint) { return !head.empty() && !isBelow(head.front(), joint); });
    roles_.set(Role::neck, Side::middle, std::move(neck));
    roles_.set(Role::head, Side::middle, std::move(head));
  }

  const Skeleton& skeleton_;
  std::vector<Spelling> spellings_;
  RoleMap roles_;
};

}  // namespace

RoleMap findRoles(const Skeleton& skeleton) {
  RoleMap roles = Finder(skeleton).find();
  const std::vector<std::string> missing = missingRoles(roles);
  if (!missing.empty()) {
    throw base::InputError(
        "", "",
        fmt::format("no joint of the skeleton is known by name as {}; say which they are in \"joint_roles\"",
                    fmt::join(missing, ", ")));
  }
  requireChains(skeleton, roles);
  return roles;
}

}  // namespace lorica::human
