#include <fmt/format.h>

#include "body_shape.h"
#include "plain_parts.h"

namespace lorica::manikin {

namespace {

struct Named {
  const char* name;
  Bone parent;  ///< itself for the root
};

constexpr std::array<Named, toe + 1> kNames{{{"pelvis_root", pelvisRoot},
                                             {"spine_L5S1", pelvisRoot},
                                             {"spine_L3L4", spineL5S1},
                                             {"spine_L1L2", spineL3L4},
                                             {"spine_T10T11", spineL1L2},
                                             {"spine_T6T7", spineT10T11},
                                             {"spine_T2T3", spineT6T7},
                                             {"spine_C7T1", spineT2T3},
                                             {"head_C0C1", spineC7T1},
                                             {"sternoclavicular", spineT2T3},
                                             {"glenohumeral", sternoclavicular},
                                             {"elbow", glenohumeral},
                                             {"wrist", elbow},
                                             {"hip", pelvisRoot},
                                             {"knee", hip},
                                             {"ankle", knee},
                                             {"toe_MTP", ankle}}};

constexpr std::size_t kInfluences = 8;  ///< before the strongest four are kept

/// What the joints have of a vertex; shares of nothing are left out.
class Shares {
 public:
  void add(std::uint32_t joint, double weight) {
    if (weight > 0.0) {
      influences_.at(used_++) = {joint, weight};
    }
  }
  const std::array<human::Influence, kInfluences>& influences() const { return influences_; }

 private:
  std::array<human::Influence, kInfluences> influences_{};
  std::size_t used_ = 0;
};

/// Shares of the spine at a height: each bone rules the middle of its length and shares the rest with its neighbour.
void addSpine(Shares& shares, double height, double whole) {
  const auto& joints = restPositions();
  const auto middle = [&](std::size_t bone) {
    return bone == headC0C1 ? 1.625 : 0.5 * (joints[bone].y() + joints[bone + 1].y());
  };
  if (height <= middle(pelvisRoot)) {
    shares.add(pelvisRoot, whole);
    return;
  }
  for (std::uint32_t bone = pelvisRoot; bone < headC0C1; ++bone) {
    if (height <= middle(bone + 1)) {
      const double upper = smoothStep(middle(bone), middle(bone + 1), height);
      shares.add(bone, whole * (1.0 - upper));
      shares.add(bone + 1, whole * upper);
      return;
    }
  }
  shares.add(headC0C1, whole);
}

/// Signed distance past a joint along its limb.
double past(const Vec3d& p, Bone before, Bone joint, Bone after) {
  const auto& joints = restPositions();
  const Vec3d direction = (joints[joint] - joints[before]).normalized() + (joints[after] - joints[joint]).normalized();
  return (p - joints[joint]).dot(direction.normalized());
}

void addArm(Shares& shares, const Vec3d& mirrored, std::uint32_t side, double whole) {
  const double forearm = smoothStep(-0.045, 0.045, past(mirrored, glenohumeral, elbow, wrist));
  const Vec3d hand = restPositions()[wrist] - restPositions()[elbow];
  const double handShare =
      smoothStep(-0.03, 0.03, (mirrored - restPositions()[wrist]).dot(hand.normalized())) * forearm;
  shares.add(glenohumeral + side, whole * (1.0 - forearm));
  shares.add(elbow + side, whole * (forearm - handShare));
  shares.add(wrist + side, whole * handShare);
}

void addLeg(Shares& shares, const Vec3d& mirrored, std::uint32_t side, double whole) {
  const auto& joints = restPositions();
  const double shank = smoothStep(-0.065, 0.065, past(mirrored, hip, knee, ankle));
  const double foot = smoothStep(-0.035, 0.025, joints[ankle].y() - mirrored.y()) * shank;
  const double toes = smoothStep(-0.03, 0.03, mirrored.z() - joints[toe].z()) * foot;
  shares.add(hip + side, whole * (1.0 - shank));
  shares.add(knee + side, whole * (shank - foot));
  shares.add(ankle + side, whole * (foot - toes));
  shares.add(toe + side, whole * toes);
}

/// Share of the arm: beyond the shoulder joint, and nearer to the arm than to the flank.
double armShare(const Vec3d& mirrored) {
  const auto& joints = restPositions();
  const Vec3d direction = (joints[elbow] - joints[glenohumeral]).normalized();
  const double along = (mirrored - joints[glenohumeral]).dot(direction);
  return smoothStep(-0.05, 0.06, along) * smoothStep(-0.06, 0.06, trunkField(mirrored) - armField(mirrored));
}

/// Share of the leg: below the fold that rises from the crotch to the iliac crest. The skin between the legs belongs
/// to the pelvis, lest it follow both.
double legShare(const Vec3d& mirrored) {
  constexpr double crotch = 0.805;
  const Vec3d& joint = restPositions()[hip];
  const double fold = joint.y() - 0.005 + 0.5 * (mirrored.x() - joint.x());
  const double between = std::max(smoothStep(0.0, 0.06, mirrored.x()), smoothStep(0.0, 0.05, crotch - mirrored.y()));
  return smoothStep(-0.08, 0.08, fold - mirrored.y()) * between;
}

Shares sharesOf(const Vec3d& p) {
  const Vec3d mirrored = mirroredToLeft(p);
  const std::uint32_t side = p.x() < 0.0 ? kSideStride : 0;
  // The chin hangs before the neck but belongs to the head.
  const double chin = 0.5 * std::max(p.z(), 0.0) * smoothStep(1.48, 1.54, p.y());
  Shares shares;
  const bool onArm = armField(mirrored) < std::min(trunkField(mirrored), legField(mirrored));
  const double leg = onArm ? 0.0 : legShare(mirrored);
  if (leg > 0.0) {
    addLeg(shares, mirrored, side, leg);
    addSpine(shares, p.y(), 1.0 - leg);
    return shares;
  }
  // Where the arm begins to have a share, the trunk's has already moved up to the thorax and the collar bone.
  constexpr double begin = 0.3;
  constexpr double thorax = 1.30;
  const double near = armShare(mirrored);
  const double arm = std::max(near - begin, 0.0) / (1.0 - begin);
  const double height = p.y() + chin + smoothStep(0.0, begin, near) * std::max(thorax - p.y(), 0.0);
  const double collar =
      smoothStep(0.05, 0.15, mirrored.x()) * smoothStep(1.33, 1.42, p.y()) * (1.0 - smoothStep(1.50, 1.56, p.y()));
  addArm(shares, mirrored, side, arm);
  shares.add(sternoclavicular + side, (1.0 - arm) * collar);
  addSpine(shares, height, (1.0 - arm) * (1.0 - collar));
  return shares;
}

}  // namespace

human::Skeleton plainSkeleton() {
  const auto& positions = restPositions();
  std::vector<human::Joint> joints(kBones);
  for (std::uint32_t bone = 0; bone <= toe; ++bone) {
    const auto& [name, parent] = kNames[bone];
    const bool sided = bone >= sternoclavicular;
    const bool sidedParent = parent >= sternoclavicular;
    const Vec3d offset = bone == parent ? positions[bone] : Vec3d(positions[bone] - positions[parent]);
    human::Joint& joint = joints[bone];
    joint.name = sided ? fmt::format("{}_L", name) : name;
    joint.rest.translation = offset;
    if (bone != parent) {
      joint.parent = human::JointIndex{parent};
    }
    if (sided) {
      human::Joint& right = joints[bone + kSideStride];
      right.name = fmt::format("{}_R", name);
      right.rest.translation = offset.cwiseProduct(Vec3d(-1.0, 1.0, 1.0));
      right.parent = human::JointIndex{sidedParent ? parent + kSideStride : parent};
    }
  }
  return human::Skeleton(std::move(joints));
}

human::SkinWeights plainWeights(const geometry::TriangleMesh& skin) {
  std::vector<human::Influence> influences;
  influences.reserve(skin.positions.size() * kInfluences);
  for (const geometry::Vec3f& position : skin.positions) {
    const Shares shares = sharesOf(position.cast<double>());
    influences.insert(influences.end(), shares.influences().begin(), shares.influences().end());
  }
  return human::normaliseWeights(influences, kInfluences, 4).weights;
}

}  // namespace lorica::manikin
