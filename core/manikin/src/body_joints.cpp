#include "body_joints.h"

#include <fmt/format.h>

#include <cmath>

#include "lorica/base/units.h"
#include "tables.h"

namespace lorica::manikin {

namespace {

struct Named {
  const char* name;
  BodyJoint parent;  ///< itself for the root
};

constexpr std::array<Named, kLeftAndMiddle> kNames{{{"pelvis_root", jPelvis},
                                                    {"spine_L5S1", jPelvis},
                                                    {"spine_L3L4", jL5S1},
                                                    {"spine_L1L2", jL3L4},
                                                    {"spine_T10T11", jL1L2},
                                                    {"spine_T6T7", jT10T11},
                                                    {"spine_T2T3", jT6T7},
                                                    {"spine_C7T1", jT2T3},
                                                    {"spine_C3C4", jC7T1},
                                                    {"head_C0C1", jC3C4},
                                                    {"jaw", jHead},
                                                    {"eye", jHead},
                                                    {"sternoclavicular", jT2T3},
                                                    {"acromioclavicular", jSternoclavicular},
                                                    {"glenohumeral", jAcromioclavicular},
                                                    {"elbow", jGlenohumeral},
                                                    {"radioulnar", jElbow},
                                                    {"wrist", jRadioulnar},
                                                    {"thumb_CMC", jWrist},
                                                    {"thumb_MCP", jThumb1},
                                                    {"index_MCP", jWrist},
                                                    {"index_PIP", jIndex1},
                                                    {"middle_MCP", jWrist},
                                                    {"middle_PIP", jMiddle1},
                                                    {"ring_MCP", jWrist},
                                                    {"ring_PIP", jRing1},
                                                    {"little_MCP", jWrist},
                                                    {"little_PIP", jLittle1},
                                                    {"hip", jPelvis},
                                                    {"knee", jHip},
                                                    {"ankle", jKnee},
                                                    {"subtalar", jAnkle},
                                                    {"toe_MTP", jSubtalar}}};

/// The table's place of a joint, metres.
Vec3d tablePlace(const human::Person& person, std::string_view joint) {
  const base::Table& table = jointTable();
  const std::size_t row = table.find("joint", joint);
  const char* height = person.sex == human::Sex::male ? "y_up_frac_stature_male" : "y_up_frac_stature_female";
  return person.stature * Vec3d(table.number(row, "x_left_frac_stature"), table.number(row, height),
                                table.number(row, "z_fwd_frac_stature"));
}

/// A finger in the frame of the hand, in shares of the hand's length: along the hand, towards the palm, towards the
/// thumb.
struct FingerShape {
  Vec3d knuckle;
  std::array<double, 3> phalanges;
  double fan;     ///< degrees towards the thumb
  double curl;    ///< degrees towards the palm at each joint
  double radius;  ///< share of the hand's breadth
};

// Knuckles: the joint table's spread; phalanges after de Leva 1996 (wrist to third knuckle 45 % of the hand) with the
// usual proportions of the fingers, radii so that four fingers make the hand's breadth.
constexpr double kThumbFan = 42.0;
const std::array<FingerShape, 5> kFingers{{{{0.12, 0.045, 0.115}, {0.225, 0.165, 0.115}, kThumbFan, 9.0, 0.122},
                                           {{0.450, -0.01, 0.130}, {0.225, 0.130, 0.095}, 7.0, 9.0, 0.104},
                                           {{0.452, -0.02, 0.015}, {0.245, 0.150, 0.105}, 0.5, 10.0, 0.106},
                                           {{0.432, -0.01, -0.095}, {0.225, 0.140, 0.105}, -6.5, 11.0, 0.100},
                                           {{0.400, 0.005, -0.195}, {0.175, 0.105, 0.095}, -14.0, 12.0, 0.090}}};

/// Angle of the arms to the trunk, radians: a gap is left between them at the height where the chest is taped.
double abduction(const Anthropometry& sizes, const Vec3d& shoulder) {
  const double size = sizes.person().stature / 1.755;
  const double arm = 1.06 * sizes.size("bicepscircumferenceflexed", GrowsWith::build) / 6.2832;
  const double trunk = 0.53 * sizes.size("chestbreadth", GrowsWith::build);
  // Where the arm's inner side has to pass: drop below the shoulder joint, and further in by `inwards`.
  const double drop = shoulder.y() - sizes.size("chestheight", GrowsWith::stature);
  const double inwards = shoulder.x() - trunk - 0.022 * size;
  const double away = std::hypot(drop, inwards);
  const double least = base::radians(30.0);
  const double most = base::radians(75.0);
  return arm < away ? std::clamp(std::asin(arm / away) - std::atan2(inwards, drop), least, most) : most;
}

}  // namespace

BodyJoints bodyJoints(const Anthropometry& sizes) {
  using base::radians;
  const human::Person& person = sizes.person();
  BodyJoints joints;
  auto& at = joints.at;
  const auto place = [&](std::string_view name) { return tablePlace(person, name); };
  at[jPelvis] = place("pelvis_root");
  at[jL5S1] = place("spine_L5S1");
  at[jL3L4] = place("spine_L3L4");
  at[jL1L2] = place("spine_L1L2");
  at[jT10T11] = place("spine_T10T11");
  at[jT6T7] = place("spine_T6T7");
  at[jT2T3] = place("spine_T2T3");
  at[jC7T1] = place("spine_C7T1");
  at[jC3C4] = place("spine_C3C4");
  at[jHead] = place("head_C0C1");
  at[jJaw] = place("jaw_TMJ");
  at[jEye] = place("eye_L");
  at[jEye].x() = 0.5 * sizes.size("interpupillarybreadth", GrowsWith::head);
  // The middle of the eyeball; the table's depth is that of the cornea.
  at[jEye].z() -= 0.0065 * person.stature;
  at[jSternoclavicular] = place("sternoclavicular_L");

  // Shoulders are as broad as the survey's, not as stature alone would have them.
  const double shoulder = 0.5 * sizes.size("biacromialbreadth", GrowsWith::stature);
  at[jAcromioclavicular] = place("acromioclavicular_L");
  at[jAcromioclavicular].x() = 0.80 * shoulder;
  at[jGlenohumeral] = place("glenohumeral_L");
  at[jGlenohumeral].x() = 0.846 * shoulder;

  const double hang = abduction(sizes, at[jGlenohumeral]);
  joints.armDirection = Vec3d(std::sin(hang), -std::cos(hang), 0.0);
  joints.palmDirection = Vec3d(-std::cos(hang), -std::sin(hang), 0.0);
  const Vec3d upper = place("elbow_L") - place("glenohumeral_L");
  const Vec3d lower = place("wrist_L") - place("elbow_L");
  at[jElbow] = at[jGlenohumeral] + upper.norm() * joints.armDirection + Vec3d(0.0, 0.0, upper.z());
  at[jWrist] = at[jElbow] + lower.norm() * joints.armDirection + Vec3d(0.0, 0.0, lower.z());
  // Half-way down the forearm, where its skin begins to turn with the hand.
  at[jRadioulnar] = 0.5 * (at[jElbow] + at[jWrist]);

  const double hand = sizes.size("handlength", GrowsWith::stature);
  const double breadth = sizes.size("handbreadth", GrowsWith::stature);
  const Vec3d thumbwards = Vec3d::UnitZ();
  const auto inHand = [&](const Vec3d& shares) -> Vec3d {
    return hand * (shares.x() * joints.armDirection + shares.y() * joints.palmDirection + shares.z() * thumbwards);
  };
  for (std::size_t f = 0; f < kFingers.size(); ++f) {
    const FingerShape& shape = kFingers[f];
    Finger& finger = joints.fingers[f];
    finger.knuckle = at[jWrist] + inHand(shape.knuckle);
    finger.radius = breadth * shape.radius;
    const bool thumb = f == 0;
    const double fan = radians(shape.fan);
    Vec3d* const ends[] = {&finger.second, &finger.third, &finger.tip};
    Vec3d here = finger.knuckle;
    for (std::size_t k = 0; k < 3; ++k) {
      // The thumb stands before the palm and bends little.
      const double curl =
          radians(thumb ? 28.0 - 4.0 * static_cast<double>(k) : shape.curl * static_cast<double>(k + 1));
      const double spread = thumb ? fan - radians(10.0) * static_cast<double>(k) : fan;
      here += shape.phalanges[k] *
              inHand({std::cos(spread) * std::cos(curl), std::sin(curl), std::sin(spread) * std::cos(curl)});
      *ends[k] = here;
    }
  }
  constexpr std::array<std::uint32_t, 5> first{jThumb1, jIndex1, jMiddle1, jRing1, jLittle1};
  for (std::size_t f = 0; f < first.size(); ++f) {
    at[first[f]] = joints.fingers[f].knuckle;
    at[first[f] + 1] = joints.fingers[f].second;
  }

  at[jHip] = place("hip_L");
  at[jKnee] = place("knee_L");
  at[jAnkle] = place("ankle_L");
  // Under the ankle, where anatomy has it; the table's place is the origin of the heel bone's frame.
  at[jSubtalar] = at[jAnkle] + person.stature * Vec3d(0.0, -0.0140, -0.0070);
  at[jToe] = place("toe_MTP_L");
  // The feet a little apart and turned out: the whole leg turns about the hip.
  const double stance = 0.0381 * person.stature;  // further out at the ankle than the table has it
  const double legDrop = at[jHip].y() - at[jAnkle].y();
  at[jKnee].x() += stance * (at[jHip].y() - at[jKnee].y()) / legDrop;
  constexpr double turnedOut = 6.0;  // degrees
  joints.footDirection = Vec3d(std::sin(radians(turnedOut)), 0.0, std::cos(radians(turnedOut)));
  const Vec3d outward(joints.footDirection.z(), 0.0, -joints.footDirection.x());
  const Vec3d ankle = at[jAnkle] + Vec3d(stance, 0.0, 0.0);
  for (const std::uint32_t j : {jSubtalar, jToe}) {
    const Vec3d from = at[j] - at[jAnkle];
    at[j] = ankle + from.x() * outward + Vec3d(0.0, from.y(), 0.0) + from.z() * joints.footDirection;
  }
  at[jAnkle] = ankle;
  return joints;
}

human::Skeleton bodySkeleton(const BodyJoints& places) {
  std::vector<human::Joint> joints(kAllJoints);
  for (std::uint32_t j = 0; j < kLeftAndMiddle; ++j) {
    const auto& [name, parent] = kNames[j];
    const bool root = j == parent;
    const bool sided = j >= jEye;
    const Vec3d offset = root ? places.at[j] : Vec3d(places.at[j] - places.at[parent]);
    joints[j].name = sided ? fmt::format("{}_L", name) : name;
    joints[j].rest.translation = offset;
    if (!root) {
      joints[j].parent = human::JointIndex{static_cast<std::uint32_t>(parent)};
    }
    if (sided) {
      human::Joint& right = joints[rightOf(j)];
      right.name = fmt::format("{}_R", name);
      right.rest.translation = offset.cwiseProduct(Vec3d(-1.0, 1.0, 1.0));
      right.parent = human::JointIndex{parent >= jEye ? rightOf(parent) : static_cast<std::uint32_t>(parent)};
    }
  }
  return human::Skeleton(std::move(joints));
}

}  // namespace lorica::manikin
