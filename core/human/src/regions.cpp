#include "lorica/human/regions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "lorica/base/error.h"

namespace lorica::human {

using geometry::Vec3d;

namespace {

/// What a joint's name says, before left and right, front and back are told apart.
enum class Zone {
  head,
  neck,
  chest,
  abdomen,
  pelvis,
  shoulder,
  upperArm,
  forearm,
  hand,
  thigh,
  lowerLeg,
  foot,
  unknown
};

struct ZoneWord {
  std::string_view word;
  Zone zone;
};

// Tried in this order on the lower-case name: longer and more special words stand first, so that "forearm" is not
// taken for an arm, "lowerleg" not for a leg, a finger's "metacarpal" not for the wrist.
constexpr std::array zoneWords = std::to_array<ZoneWord>({
    {"jaw", Zone::head},           {"eye", Zone::head},
    {"tongue", Zone::head},        {"skull", Zone::head},
    {"levator", Zone::head},       {"oris", Zone::head},
    {"oculi", Zone::head},         {"orbicularis", Zone::head},
    {"risorius", Zone::head},      {"temporalis", Zone::head},
    {"special", Zone::head},       {"head", Zone::head},
    {"c0c1", Zone::head},          {"neck", Zone::neck},
    {"c3c4", Zone::neck},          {"c7t1", Zone::neck},
    {"cervical", Zone::neck},      {"thumb", Zone::hand},
    {"index", Zone::hand},         {"middle", Zone::hand},
    {"ring_", Zone::hand},         {"little", Zone::hand},
    {"pinky", Zone::hand},         {"finger", Zone::hand},
    {"metacarpal", Zone::hand},    {"wrist", Zone::hand},
    {"hand", Zone::hand},          {"forearm", Zone::forearm},
    {"lowerarm", Zone::forearm},   {"elbow", Zone::forearm},
    {"radioulnar", Zone::forearm}, {"radius", Zone::forearm},
    {"ulna", Zone::forearm},       {"sternoclav", Zone::shoulder},
    {"clav", Zone::shoulder},      {"scapula", Zone::shoulder},
    {"collar", Zone::shoulder},    {"glenohumeral", Zone::upperArm},
    {"upperarm", Zone::upperArm},  {"humer", Zone::upperArm},
    {"shldr", Zone::upperArm},     {"toe", Zone::foot},
    {"mtp", Zone::foot},           {"foot", Zone::foot},
    {"ankle", Zone::foot},         {"heel", Zone::foot},
    {"lowerleg", Zone::lowerLeg},  {"knee", Zone::lowerLeg},
    {"shin", Zone::lowerLeg},      {"shank", Zone::lowerLeg},
    {"calf", Zone::lowerLeg},      {"tibia", Zone::lowerLeg},
    {"upperleg", Zone::thigh},     {"upleg", Zone::thigh},
    {"thigh", Zone::thigh},        {"femur", Zone::thigh},
    {"hipjoint", Zone::pelvis},    {"hips", Zone::pelvis},
    {"hip_", Zone::thigh},         {"pelvis", Zone::pelvis},
    {"root", Zone::pelvis},        {"breast", Zone::chest},
    {"chest", Zone::chest},        {"thorax", Zone::chest},
    {"ribs", Zone::chest},         {"t10t11", Zone::chest},
    {"t6t7", Zone::chest},         {"t2t3", Zone::chest},
    {"lumbar", Zone::abdomen},     {"abdomen", Zone::abdomen},
    {"l1l2", Zone::abdomen},       {"l3l4", Zone::abdomen},
    {"l5s1", Zone::abdomen},       {"lowerback", Zone::abdomen},
    {"belly", Zone::abdomen},      {"spine05", Zone::abdomen},
    {"spine04", Zone::abdomen},    {"spine03", Zone::abdomen},
    {"spine02", Zone::chest},      {"spine01", Zone::chest},
    {"spine1", Zone::chest},       {"spine2", Zone::chest},
    {"spine3", Zone::chest},       {"spine", Zone::abdomen},
    {"torso", Zone::chest},        {"arm", Zone::upperArm},
    {"leg", Zone::lowerLeg},       {"shoulder", Zone::shoulder},
    {"hip", Zone::thigh},
});

Zone zoneOf(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = std::find_if(zoneWords.begin(), zoneWords.end(),
                                  [&](const ZoneWord& z) { return lower.find(z.word) != std::string::npos; });
  return found == zoneWords.end() ? Zone::unknown : found->zone;
}

/// Zone of every joint; a joint whose name says nothing has its parent's.
std::vector<Zone> zonesOf(const Skeleton& skeleton) {
  std::vector<Zone> zones(skeleton.size(), Zone::unknown);
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const Joint& joint = skeleton.joints()[j];
    zones[j] = zoneOf(joint.name);
    if (zones[j] == Zone::unknown && joint.parent) {
      zones[j] = zones[joint.parent->value];
    }
  }
  return zones;
}

constexpr std::array<std::string_view, 20> regionNames = {
    "head",       "neck",           "chest_front",     "chest_back",     "abdomen_front",   "abdomen_back",
    "pelvis",     "upper_arm_left", "upper_arm_right", "forearm_left",   "forearm_right",   "hand_left",
    "hand_right", "thigh_left",     "thigh_right",     "lower_leg_left", "lower_leg_right", "foot_left",
    "foot_right", "unassigned"};

std::size_t regionOf(Zone zone, bool left, bool front) {
  const std::size_t side = left ? 0 : 1;
  const std::size_t face = front ? 0 : 1;
  switch (zone) {
    case Zone::head:
      return 0;
    case Zone::neck:
      return 1;
    case Zone::chest:
    case Zone::shoulder:
      return 2 + face;
    case Zone::abdomen:
      return 4 + face;
    case Zone::pelvis:
      return 6;
    case Zone::upperArm:
      return 7 + side;
    case Zone::forearm:
      return 9 + side;
    case Zone::hand:
      return 11 + side;
    case Zone::thigh:
      return 13 + side;
    case Zone::lowerLeg:
      return 15 + side;
    case Zone::foot:
      return 17 + side;
    case Zone::unknown:
      return 19;
  }
  return 19;
}

std::optional<bool> leftByName(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto ends = [&](std::string_view tail) { return lower.ends_with(tail); };
  if (lower.find("left") != std::string::npos || ends("_l") || ends(".l")) {
    return true;
  }
  if (lower.find("right") != std::string::npos || ends("_r") || ends(".r")) {
    return false;
  }
  return std::nullopt;
}

/// The joint that holds most of a triangle.
std::uint32_t dominantJoint(const geometry::Triangle& triangle, const SkinWeights& weights) {
  std::uint32_t best = weights.strongest(triangle[0]).value;
  double most = -1.0;
  for (const std::uint32_t candidateVertex : triangle) {
    for (std::size_t c = 0; c < weights.influences; ++c) {
      const std::uint32_t joint = weights.joints[candidateVertex * weights.influences + c];
      double share = 0.0;
      for (const std::uint32_t vertex : triangle) {
        for (std::size_t k = 0; k < weights.influences; ++k) {
          const std::size_t at = vertex * weights.influences + k;
          share += weights.joints[at] == joint ? static_cast<double>(weights.weights[at]) : 0.0;
        }
      }
      if (share > most || (share == most && joint < best)) {
        most = share;
        best = joint;
      }
    }
  }
  return best;
}

}  // namespace

BodyRegions bodyRegions(const geometry::TriangleMesh& skin, const SkinWeights& weights, const Skeleton& skeleton) {
  LORICA_CHECK(weights.vertices() == skin.positions.size(), "one weight set per vertex");
  const std::vector<Zone> zones = zonesOf(skeleton);
  std::vector<std::optional<bool>> leftOf(skeleton.size());
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    leftOf[j] = leftByName(skeleton.joints()[j].name);
  }
  std::array<bool, regionNames.size()> used{};
  std::vector<std::size_t> region(skin.triangles.size());
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const std::uint32_t joint = dominantJoint(skin.triangles[t], weights);
    const Vec3d a = skin.corner(t, 0);
    const Vec3d normal = (skin.corner(t, 1) - a).cross(skin.corner(t, 2) - a);
    const bool left = leftOf[joint].value_or(a.x() > skeleton.restPosition(JointIndex{joint}).x());
    region[t] = regionOf(zones[joint], left, normal.z() >= 0.0);
    used[region[t]] = true;
  }
  BodyRegions result;
  std::array<std::uint16_t, regionNames.size()> rank{};
  for (std::size_t r = 0; r < regionNames.size(); ++r) {
    if (used[r]) {
      rank[r] = static_cast<std::uint16_t>(result.names.size());
      result.names.emplace_back(regionNames[r]);
    }
  }
  result.ofTriangle.reserve(region.size());
  for (const std::size_t r : region) {
    result.ofTriangle.push_back(rank[r]);
  }
  return result;
}

}  // namespace lorica::human
