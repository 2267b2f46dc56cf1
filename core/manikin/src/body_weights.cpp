#include "body_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lorica/geometry/smoothing.h"

namespace lorica::manikin {

namespace {

constexpr std::size_t kInfluences = 10;  ///< before the strongest four are kept

/// From 0 at `low` to 1 at `high`, straight but for rounded ends: at its steepest 1.25 over the width, where smoothStep
/// has 1.5. Skin folds over itself where weights change faster than one over (angle times distance from the joint).
double ramp(double low, double high, double x) {
  constexpr double round = 0.2;
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  const double end = 2.0 * round * (1.0 - round);
  if (t < round) {
    return t * t / end;
  }
  return t > 1.0 - round ? 1.0 - (1.0 - t) * (1.0 - t) / end : (t - 0.5 * round) / (1.0 - round);
}

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

class Weigher {
 public:
  Weigher(const Anthropometry& sizes, const BodyJoints& joints, const BodyField& field)
      : joints_(joints),
        field_(field),
        size_(sizes.person().stature / 1.755),
        crotch_(sizes.size("crotchheight", GrowsWith::stature)),
        axilla_(sizes.size("axillaheight", GrowsWith::stature)) {}

  Shares sharesOf(const Vec3d& p) const {
    const Vec3d mirrored = mirroredToLeft(p);
    const bool right = p.x() < 0.0;
    Shares shares;
    const double armField = field_.arm(mirrored);
    const double trunkField = std::min(field_.trunk(mirrored), field_.head(mirrored));
    const double leg = armField < std::min(trunkField, field_.leg(mirrored)) ? 0.0 : legShare(mirrored);
    if (leg > 0.0) {
      addLeg(shares, mirrored, right, leg);
      addSpine(shares, mirrored.y(), 1.0 - leg);
      return shares;
    }
    // Where the arm begins to have a share, the trunk's has already moved up to the thorax and the collar bone.
    constexpr double begin = 0.05;
    const double near = armShare(mirrored, trunkField - armField);
    const double arm = std::max(near - begin, 0.0) / (1.0 - begin);
    const double thorax = axilla_ - 0.03 * size_;
    const double height = mirrored.y() + smoothStep(0.0, begin, near) * std::max(thorax - mirrored.y(), 0.0);
    const double neck = joints_.at[jC7T1].y();
    const double collar = smoothStep(0.05 * size_, 0.15 * size_, mirrored.x()) *
                          smoothStep(axilla_, axilla_ + 0.09 * size_, mirrored.y()) *
                          (1.0 - smoothStep(neck + 0.02 * size_, neck + 0.08 * size_, mirrored.y()));
    const double blade = smoothStep(0.6, 1.0, mirrored.x() / joints_.at[jAcromioclavicular].x());
    addArm(shares, mirrored, right, arm);
    shares.add(sided(jSternoclavicular, right), (1.0 - arm) * collar * (1.0 - blade));
    shares.add(sided(jAcromioclavicular, right), (1.0 - arm) * collar * blade);
    addSpine(shares, height + chin(mirrored), (1.0 - arm) * (1.0 - collar));
    return shares;
  }

 private:
  static std::uint32_t sided(std::uint32_t left, bool right) { return right ? rightOf(left) : left; }

  /// The chin hangs before the neck but belongs to the head: it counts as higher the further in front it is.
  double chin(const Vec3d& mirrored) const {
    const double low = joints_.at[jC7T1].y();
    return 0.9 * std::max(mirrored.z() - 0.015 * size_, 0.0) *
           smoothStep(low - 0.01 * size_, low + 0.04 * size_, mirrored.y());
  }

  /// Shares of the spine at a height: each bone rules the middle of its length and shares the rest with its neighbour.
  void addSpine(Shares& shares, double height, double whole) const {
    const auto middle = [&](std::size_t bone) {
      const double here = joints_.at[bone].y();
      return bone == jHead ? here + 0.035 * size_ : 0.5 * (here + joints_.at[bone + 1].y());
    };
    if (height <= middle(jPelvis)) {
      shares.add(jPelvis, whole);
      return;
    }
    for (std::uint32_t bone = jPelvis; bone < jHead; ++bone) {
      if (height <= middle(bone + 1)) {
        const double upper = (height - middle(bone)) / (middle(bone + 1) - middle(bone));
        shares.add(bone, whole * (1.0 - upper));
        shares.add(bone + 1, whole * upper);
        return;
      }
    }
    shares.add(jHead, whole);
  }

  /// Signed distance past a joint along its limb.
  double past(const Vec3d& p, BodyJoint before, BodyJoint joint, BodyJoint after) const {
    const auto& at = joints_.at;
    const Vec3d direction = (at[joint] - at[before]).normalized() + (at[after] - at[joint]).normalized();
    return (p - at[joint]).dot(direction.normalized());
  }

  void addArm(Shares& shares, const Vec3d& mirrored, bool right, double whole) const {
    const auto& at = joints_.at;
    const double forearm = ramp(-0.07 * size_, 0.07 * size_, past(mirrored, jGlenohumeral, jElbow, jWrist));
    // The skin of the forearm turns with the hand the more the nearer it is.
    const Vec3d lower = at[jWrist] - at[jElbow];
    const double along = (mirrored - at[jElbow]).dot(lower) / lower.squaredNorm();
    const double turned = smoothStep(0.12, 0.88, along) * forearm;
    const double hand =
        smoothStep(-0.022 * size_, 0.022 * size_, (mirrored - at[jWrist]).dot(lower.normalized())) * turned;
    shares.add(sided(jGlenohumeral, right), whole * (1.0 - forearm));
    shares.add(sided(jElbow, right), whole * (forearm - turned));
    shares.add(sided(jRadioulnar, right), whole * (turned - hand));
    addHand(shares, mirrored, right, whole * hand);
  }

  void addHand(Shares& shares, const Vec3d& mirrored, bool right, double whole) const {
    if (whole <= 0.0) {
      return;
    }
    constexpr std::array<std::uint32_t, 5> first{jThumb1, jIndex1, jMiddle1, jRing1, jLittle1};
    std::size_t nearest = 0;
    double distance = 1e9;
    for (std::size_t f = 0; f < first.size(); ++f) {
      const Finger& finger = joints_.fingers[f];
      const double away =
          std::min({taperedCapsule(mirrored, finger.knuckle, finger.second, 1.1 * finger.radius, finger.radius),
                    taperedCapsule(mirrored, finger.second, finger.third, finger.radius, finger.radius),
                    taperedCapsule(mirrored, finger.third, finger.tip, finger.radius, finger.radius)});
      if (away < distance) {
        distance = away;
        nearest = f;
      }
    }
    const Finger& finger = joints_.fingers[nearest];
    const bool thumb = nearest == 0;
    const Vec3d proximal = finger.second - finger.knuckle;
    const double overKnuckle = (mirrored - finger.knuckle).dot(proximal.normalized());
    const Vec3d distal = (finger.third - finger.second).normalized() + proximal.normalized();
    const double overSecond = (mirrored - finger.second).dot(distal.normalized());
    // The web between the fingers stays with the palm; so does what is not over a finger.
    const double reach = thumb ? 0.030 * size_ : 0.012 * size_;
    const double on = smoothStep(thumb ? -0.010 * size_ : 0.0, reach, overKnuckle) *
                      (1.0 - smoothStep(0.4 * finger.radius, 1.4 * finger.radius, distance));
    const double second = on * smoothStep(-0.9 * finger.radius, 0.9 * finger.radius, overSecond);
    shares.add(sided(jWrist, right), whole * (1.0 - on));
    shares.add(sided(first[nearest], right), whole * (on - second));
    shares.add(sided(first[nearest] + 1, right), whole * second);
  }

  void addLeg(Shares& shares, const Vec3d& mirrored, bool right, double whole) const {
    const auto& at = joints_.at;
    const double shank = ramp(-0.10 * size_, 0.10 * size_, past(mirrored, jHip, jKnee, jAnkle));
    const double foot = smoothStep(-0.035 * size_, 0.025 * size_, at[jAnkle].y() - mirrored.y()) * shank;
    // Below the ankle bone the heel takes over from the talus.
    const double sole = smoothStep(0.0, 0.04 * size_, at[jAnkle].y() - mirrored.y()) * foot;
    const double toes =
        smoothStep(-0.03 * size_, 0.03 * size_, (mirrored - at[jToe]).dot(joints_.footDirection)) * sole;
    shares.add(sided(jHip, right), whole * (1.0 - shank));
    shares.add(sided(jKnee, right), whole * (shank - foot));
    shares.add(sided(jAnkle, right), whole * (foot - sole));
    shares.add(sided(jSubtalar, right), whole * (sole - toes));
    shares.add(sided(jToe, right), whole * toes);
  }

  /// Share of the arm: from the top of the shoulder to where the deltoid ends, beyond the shoulder joint, and nearer to
  /// the arm than to the flank.
  double armShare(const Vec3d& mirrored, double nearerToArm) const {
    const auto& at = joints_.at;
    const Vec3d direction = (at[jElbow] - at[jGlenohumeral]).normalized();
    const double along = (mirrored - at[jGlenohumeral]).dot(direction);
    return ramp(-0.16 * size_, 0.18 * size_, along) * ramp(-0.10 * size_, 0.10 * size_, nearerToArm);
  }

  /// Share of the leg: below the fold that rises from the crotch to the iliac crest. The skin between the legs belongs
  /// to the pelvis, lest it follow both.
  double legShare(const Vec3d& mirrored) const {
    const Vec3d& joint = joints_.at[jHip];
    const double fold = joint.y() - 0.025 * size_ + 0.5 * (mirrored.x() - joint.x());
    const double between = std::max(smoothStep(0.0, 0.06 * size_, mirrored.x()),
                                    smoothStep(0.0, 0.05 * size_, crotch_ - 0.04 * size_ - mirrored.y()));
    // Wider in front, where the skin is further from the joint that folds it.
    const double width = 0.15 * size_ + 0.6 * std::max(mirrored.z() - joint.z(), 0.0);
    return ramp(-width, width, fold - mirrored.y()) * between;
  }

  const BodyJoints& joints_;
  const BodyField& field_;
  double size_;
  double crotch_;
  double axilla_;
};

}  // namespace

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Weights spread over this length of skin, metres for a stature of 1.755.
constexpr double spread = 0.10;

/// Weights as rows of all joints, each summing to 1.
Rows rowsOf(std::span<const human::Influence> influences, std::size_t stride) {
  Rows rows = Rows::Zero(static_cast<Eigen::Index>(influences.size() / stride), kAllJoints);
  for (std::size_t i = 0; i < influences.size(); ++i) {
    rows(static_cast<Eigen::Index>(i / stride), influences[i].joint) += influences[i].weight;
  }
  for (Eigen::Index v = 0; v < rows.rows(); ++v) {
    rows.row(v) /= rows.row(v).sum();
  }
  return rows;
}

/// How far a vertex takes part in spreading: hands, feet, head and upper neck keep their own narrow folds.
double partInSpreading(const Rows& rows, Eigen::Index v) {
  constexpr std::uint32_t handEnd = jLittle2 + 1;
  constexpr std::uint32_t footEnd = jToe + 1;
  double apart = 0.0;
  for (std::uint32_t j = jC3C4; j <= jJaw; ++j) {
    apart += rows(v, j);
  }
  for (const std::uint32_t side : {0U, kSided}) {
    apart += rows(v, jEye + side) + rows.row(v).segment(jWrist + side, handEnd - jWrist).sum() +
             rows.row(v).segment(jAnkle + side, footEnd - jAnkle).sum();
  }
  return std::clamp(1.0 - 4.0 * apart, 0.0, 1.0);
}

/// Gives the shares of a leg that have crossed the middle back to the pelvis.
void keepLegsApart(Rows& rows, Eigen::Index v, double x) {
  const auto give = [&](std::uint32_t joint) {
    rows(v, jPelvis) += rows(v, joint);
    rows(v, joint) = 0.0;
  };
  for (const std::uint32_t joint : {jHip, jKnee}) {
    if (x <= 0.0) {
      give(joint);
    }
    if (x >= 0.0) {
      give(rightOf(joint));
    }
  }
}

/// Evens out how fast weights change along the skin: where several rules meet, their product is steeper than each.
void spreadAlongSkin(Rows& rows, const geometry::TriangleMesh& skin, double length, base::Threads threads) {
  const geometry::SurfaceNeighbours neighbours = geometry::surfaceNeighbours(skin);
  Eigen::VectorXd part(rows.rows());
  for (Eigen::Index v = 0; v < rows.rows(); ++v) {
    part[v] = 0.5 * partInSpreading(rows, v);
  }
  Rows next = rows;
  for (std::size_t step = 0; step < neighbours.stepsFor(length); ++step) {
    base::parallelFor(skin.positions.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto row = static_cast<Eigen::Index>(v);
        if (part[row] == 0.0) {
          continue;
        }
        next.row(row) = (1.0 - part[row]) * rows.row(row);
        for (std::size_t e = neighbours.first[v]; e < neighbours.first[v + 1]; ++e) {
          next.row(row) += part[row] * neighbours.share[e] * rows.row(neighbours.vertex[e]);
        }
        keepLegsApart(next, row, static_cast<double>(skin.positions[v].x()));
      }
    });
    rows.swap(next);
  }
}

/// The strongest four of a vertex less the fifth, so that a joint's weight is nought where it comes to be the fifth.
std::array<human::Influence, 4> strongestOf(const Rows& rows, Eigen::Index v) {
  std::array<human::Influence, kAllJoints> all;
  for (std::uint32_t j = 0; j < kAllJoints; ++j) {
    all[j] = {j, rows(v, j)};
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  std::array<human::Influence, 4> strongest;
  for (std::size_t k = 0; k < 4; ++k) {
    strongest[k] = {all[k].joint, all[k].weight - all[4].weight};
  }
  return strongest;
}

}  // namespace

human::SkinWeights bodyWeights(const geometry::TriangleMesh& skin, const Anthropometry& sizes, const BodyJoints& joints,
                               const BodyField& field, base::Threads threads) {
  const Weigher weigher(sizes, joints, field);
  std::vector<human::Influence> influences(skin.positions.size() * kInfluences);
  base::parallelFor(skin.positions.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Shares shares = weigher.sharesOf(skin.positions[v].cast<double>());
      std::copy(shares.influences().begin(), shares.influences().end(),
                influences.begin() + static_cast<std::ptrdiff_t>(v * kInfluences));
    }
  });
  Rows rows = rowsOf(influences, kInfluences);
  spreadAlongSkin(rows, skin, spread * sizes.person().stature / 1.755, threads);
  std::vector<human::Influence> strongest;
  for (Eigen::Index v = 0; v < rows.rows(); ++v) {
    const auto four = strongestOf(rows, v);
    strongest.insert(strongest.end(), four.begin(), four.end());
  }
  return human::normaliseWeights(strongest, 4, 4).weights;
}

}  // namespace lorica::manikin
