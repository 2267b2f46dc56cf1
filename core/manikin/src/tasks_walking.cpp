#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/units.h"
#include "motion_table.h"
#include "tasks.h"

namespace lorica::manikin {

namespace {

using base::radians;

constexpr int kKeys = 44;           ///< per cycle; even, so that half a cycle is a key
constexpr double kToeOff = 0.62;    ///< share of the cycle a foot is on the ground
constexpr double kFlatFrom = 0.12;  ///< the sole lies flat
constexpr double kFlatUntil = 0.34;
constexpr double kClearance = 0.018;  ///< by which the swinging foot is lifted further, fraction of stature
constexpr double kPi = std::numbers::pi;

/// One side's angles over the cycle that begins with its heel's contact, and the trunk's.
struct Gait {
  Curve hipFlexion = tableCycle("walking_gait", "hip_R", "flexion");
  Curve hipAdduction = tableCycle("walking_gait", "hip_R", "adduction");
  Curve hipRotation = tableCycle("walking_gait", "hip_R", "internal rotation");
  Curve knee = tableCycle("walking_gait", "knee_R", "flexion");
  Curve ankle = tableCycle("walking_gait", "ankle_R", "dorsiflexion");
  Curve obliquity = tableCycle("walking_gait", "pelvis", "obliquity");
  Curve turn = tableCycle("walking_gait", "pelvis", "axial");
  Curve tilt = tableCycle("walking_gait", "pelvis", "tilt (file sign)");
  Curve lumbarBend = tableCycle("walking_gait", "lumbar_total", "lateral bend");
  Curve lumbarTurn = tableCycle("walking_gait", "lumbar_total", "axial");
  Curve lumbarExtension = tableCycle("walking_gait", "lumbar_total", "extension(+)");
  double armBack = tableValue("walk", "shoulder, right", "flexion");
  double armFore = tableCurve("walk", "shoulder, right", "flexion").at(0.5);
  double armsOut = tableValue("walk", "shoulder, both", "abduction");
  double elbow = tableValue("walk", "elbow, both", "flexion");
  double elbowSwing = tableValue("walk", "elbow, both", "flexion swing");
  double fingers = tableValue("walk", "fingers, both", "flexion");

  /// What changes its sign from one step to the next, and what does not, freed of the measured person's asymmetry.
  static double odd(const Curve& curve, double phase) { return 0.5 * (curve.at(phase) - curve.at(phase + 0.5)); }
  static double even(const Curve& curve, double phase) { return 0.5 * (curve.at(phase) + curve.at(phase + 0.5)); }

  /// \param phase of the right leg; the file counts lean to the right and turn to the left as positive
  Attitude attitude(double phase) const {
    Attitude a;
    a.pelvis = {-even(tilt, phase), -odd(obliquity, phase), odd(turn, phase)};
    a.lumbar = {-even(lumbarExtension, phase), -odd(lumbarBend, phase), odd(lumbarTurn, phase)};
    for (const Side side : kSides) {
      const double own = side == Side::right ? phase : phase + 0.5;
      const double swing = std::cos(2.0 * kPi * own);
      Arm& arm = a.arms[placeOf(side)];
      arm.shoulder = {0.5 * (armBack + armFore) + 0.5 * (armBack - armFore) * swing, armsOut, 0.0};
      arm.elbow.flexion = elbow - elbowSwing * swing;
      arm.fingers = fingers;
      Leg& leg = a.legs[placeOf(side)];
      leg.hip = {hipFlexion.at(own), -hipAdduction.at(own), hipRotation.at(own)};
      leg.knee.flexion = knee.at(own);
      leg.ankle.flexion = ankle.at(own);
    }
    return a;
  }
};

/// Pitch of a foot, degrees, toes down positive.
double pitchOf(const Figure& figure, const Stance& stance, Side side) {
  const Vec3d forward = stance.carry[figure.joint(Role::ankle, side).value] * Vec3d::UnitZ();
  return -base::degrees(std::asin(std::clamp(forward.y(), -1.0, 1.0)));
}

Quatd pitched(double degrees) {
  return Quatd(Eigen::AngleAxisd(radians(degrees), Vec3d::UnitX()));
}

/// What a foot rolls over, from the ankle of a foot at rest: the heel on the sole, the ball's joint over toes that
/// stay.
Vec3d heelOf(const Figure& figure, Side side) {
  return {0.0, -figure.soleHeight(side), -0.030 * figure.stature()};
}
Vec3d ballOf(const Figure& figure, Side side) {
  return figure.ball(side);
}

/// Where the ankle goes: what table and skeleton give for one side, seen from the middle of the hips.
struct FootPath {
  std::array<Vec3d, kKeys> ankle;  ///< as the table's angles lead it
  std::array<double, kKeys> pitch{};
};

class Walk {
 public:
  explicit Walk(const Figure& figure) : figure_(figure) {
    for (int key = 0; key < kKeys; ++key) {
      const Stance stance = figure.take(gait_.attitude(phaseOf(key)));
      for (const Side side : kSides) {
        FootPath& path = paths_[placeOf(side)];
        const auto own = static_cast<std::size_t>(ownKey(key, side));
        path.ankle[own] = figure.position(stance, Role::ankle, side);
        path.pitch[own] = flattened(phaseOf(static_cast<int>(own)), pitchOf(figure, stance, side));
      }
    }
    findHeight();
    findSpeed();
    findCorrections();
  }

  double speed() const { return speed_; }

  Stance stance(double phase) const {
    const int key = static_cast<int>(std::lround(phase * kKeys)) % kKeys;
    Attitude attitude = gait_.attitude(phaseOf(key));
    attitude.place = place(key);
    for (const Side side : kSides) {
      const auto own = static_cast<std::size_t>(ownKey(key, side));
      // The toes stay on the ground while the heel is up, and come back with the foot.
      attitude.legs[placeOf(side)].toeExtension = toeExtension(phaseOf(static_cast<int>(own)), side);
    }
    Stance stance = figure_.take(attitude);
    for (const Side side : kSides) {
      const auto own = static_cast<std::size_t>(ownKey(key, side));
      const FootPath& path = paths_[placeOf(side)];
      figure_.reach(stance, Role::hip, Role::knee, Role::ankle, side,
                    attitude.place + path.ankle[own] + corrections_[placeOf(side)][own]);
      figure_.layFoot(stance, side, pitched(path.pitch[own]));
    }
    return stance;
  }

 private:
  static double phaseOf(int key) { return static_cast<double>(key) / kKeys; }
  /// Key of a side's own cycle.
  static int ownKey(int key, Side side) { return side == Side::right ? key % kKeys : (key + kKeys / 2) % kKeys; }
  static int stanceKeys() { return static_cast<int>(std::floor(kToeOff * kKeys)); }

  /// Measured feet are never quite level in mid-stance; a sole on the ground is.
  static double flattened(double phase, double pitch) {
    constexpr double edge = 0.11;
    const double flat =
        minimumJerk((phase - kFlatFrom + edge) / edge) * minimumJerk((kFlatUntil + edge - phase) / edge);
    return pitch * (1.0 - flat);
  }

  double toeExtension(double phase, Side side) const {
    const auto& pitch = paths_[placeOf(side)].pitch;
    const double heelUp = std::max(0.0, pitch[static_cast<std::size_t>(std::lround(phase * kKeys)) % kKeys]);
    const double share = minimumJerk((phase - kFlatUntil) / 0.1) * (1.0 - minimumJerk((phase - kToeOff) / 0.14));
    return std::min(heelUp, 55.0) * share;
  }

  /// How far the ankle of a foot on the ground is from where it is when the foot lies flat.
  Vec3d rolled(Side side, double pitch) const {
    const Vec3d pivot = pitch > 0.0 ? ballOf(figure_, side) : heelOf(figure_, side);
    return pivot - pitched(pitch) * pivot;
  }

  /// The hips rise and sink twice a cycle: mean and second harmonic of what the standing legs ask for.
  void findHeight() {
    for (int key = 0; key < kKeys; ++key) {
      double wanted = 0.0;
      double weights = 0.0;
      for (const Side side : kSides) {
        const int own = ownKey(key, side);
        // The leg that bears counts; loading and unloading legs count less and less.
        const double weight =
            std::pow(std::max(0.0, std::sin(kPi * phaseOf(own) / kToeOff)), 2.0) * (own <= stanceKeys() ? 1.0 : 0.0);
        const FootPath& path = paths_[placeOf(side)];
        const auto k = static_cast<std::size_t>(own);
        wanted +=
            weight * (figure_.floor() + figure_.soleHeight(side) + rolled(side, path.pitch[k]).y() - path.ankle[k].y());
        weights += weight;
      }
      const double height = wanted / weights;
      const double angle = 4.0 * kPi * phaseOf(key);
      mean_ += height / kKeys;
      cosine_ += 2.0 * height * std::cos(angle) / kKeys;
      sine_ += 2.0 * height * std::sin(angle) / kKeys;
    }
  }

  Vec3d place(int key) const {
    const double angle = 4.0 * kPi * phaseOf(key);
    return {figure_.restHips().x(), mean_ + cosine_ * std::cos(angle) + sine_ * std::sin(angle),
            figure_.restHips().z()};
  }

  /// The ground runs as fast as the flat feet do, seen from the hips.
  void findSpeed() {
    double run = 0.0;
    const int from = static_cast<int>(std::ceil(kFlatFrom * kKeys));
    const int until = static_cast<int>(std::floor(kFlatUntil * kKeys));
    for (const FootPath& path : paths_) {
      run += 0.5 * (path.ankle[static_cast<std::size_t>(from)].z() - path.ankle[static_cast<std::size_t>(until)].z());
    }
    duration_ = tableValue("walk", "cycle", "duration");
    speed_ = run / (phaseOf(until - from) * duration_);
  }

  /// Moves the ankles onto a ground that runs evenly; between toe-off and contact the corrections blend.
  void findCorrections() {
    const int stance = stanceKeys();
    const double perKey = speed_ * duration_ / kKeys;
    for (const Side side : kSides) {
      const FootPath& path = paths_[placeOf(side)];
      auto& corrections = corrections_[placeOf(side)];
      // The foot stays on its track while it stands.
      double track = 0.0;
      for (int own = 0; own <= stance; ++own) {
        track += path.ankle[static_cast<std::size_t>(own)].x() / (stance + 1);
      }
      // Height of the hips is a function of the right leg's phase.
      const auto heightAt = [&](int own) { return place(ownKey(own, side)).y(); };
      const auto grounded = [&](int own) {
        const auto k = static_cast<std::size_t>(own);
        const Vec3d lift = rolled(side, path.pitch[k]);
        return Vec3d(track, figure_.floor() + figure_.soleHeight(side) + lift.y() - heightAt(own),
                     -perKey * own + lift.z());
      };
      double ahead = 0.0;
      for (int own = 0; own <= stance; ++own) {
        ahead += (path.ankle[static_cast<std::size_t>(own)].z() - grounded(own).z()) / (stance + 1);
      }
      for (int own = 0; own <= stance; ++own) {
        corrections[static_cast<std::size_t>(own)] =
            grounded(own) + Vec3d(0.0, 0.0, ahead) - path.ankle[static_cast<std::size_t>(own)];
      }
      const auto at = [&](int own) -> Vec3d& { return corrections[static_cast<std::size_t>(own)]; };
      // In the air the correction goes over from one end's to the other's; what speed it has at the ends fades within
      // a few keys.
      constexpr double fade = 5.0;
      const double span = kKeys - stance;
      const auto runOut = [&](double keys) { return keys < fade ? keys * std::pow(1.0 - keys / fade, 2.0) : 0.0; };
      const Vec3d leaving = at(stance) - at(stance - 1);
      const Vec3d coming = at(1) - at(0);
      for (int own = stance + 1; own < kKeys; ++own) {
        const double share = minimumJerk((own - stance) / span);
        // Measured toes clear the ground barely, and those of another skeleton may not.
        const double arc = std::pow(std::sin(kPi * (own - stance) / span), 2.0);
        const Vec3d clear(0.0, kClearance * figure_.stature() * arc, 0.0);
        at(own) = clear + (1.0 - share) * at(stance) + share * at(0) + runOut(own - stance) * leaving -
                  runOut(kKeys - own) * coming;
      }
    }
  }

  const Figure& figure_;
  Gait gait_;
  std::array<FootPath, 2> paths_;
  std::array<std::array<Vec3d, kKeys>, 2> corrections_;
  double mean_ = 0.0;
  double cosine_ = 0.0;
  double sine_ = 0.0;
  double duration_ = 1.0;
  double speed_ = 0.0;
};

}  // namespace

Task walk(const Figure& figure) {
  const double duration = tableValue("walk", "cycle", "duration");
  return {"walk", duration, kKeys / duration,
          [walk = Walk(figure)](const Figure& /*same*/, double u) { return walk.stance(u); }};
}

double walkSpeed(const Figure& figure) {
  return Walk(figure).speed();
}

}  // namespace lorica::manikin
