#include "body_fit.h"

#include <cmath>

#include "lorica/manikin/body.h"
#include "tape.h"

namespace lorica::manikin {

namespace {

using With = GrowsWith;

/// The girths of a percentile do not belong to one person, so all of them leave the survey's a little the way the mass
/// asks for: 2 % at the median, 5 % at the 5th and 95th percentile.
class Fitter {
 public:
  Fitter(const Anthropometry& sizes, const BodyJoints& joints)
      : sizes_(sizes),
        joints_(joints),
        leeway_(kLeast +
                0.030 * std::min(1.0, std::max(std::abs(sizes.statureScore()), std::abs(sizes.buildScore())))) {}

  /// One round: reads everything, then corrects everything by what was read.
  void tape(BodyFit& fit) const {
    const BodyField body(sizes_, joints_, fit);
    const auto trunk = [&](const Vec3d& p) { return body.withoutArms(p); };
    const auto leg = [&](const Vec3d& p) { return p.x() > 0.0 ? body.withoutArms(p) : 1.0; };
    const auto arm = [&](const Vec3d& p) { return body.arm(p); };
    const double lean = std::clamp((fit.flesh - 1.0) / kFullLeeway, -1.0, 1.0);
    const double more = 1.0 + lean * leeway_;
    const double chest = 1.0 + lean * std::max(leeway_ - kLeast, 0.0);
    // The survey's chest is so narrow for its girth that only a box would have both; the tolerance is shared out.
    belt(fit.chest, tapeAround(trunk, level("chestheight")), "chest", 1.026 * chest, 0.978 * chest);
    belt(fit.waist, tapeAround(trunk, level("waistheightomphalion")), "waist", more, more);
    belt(fit.hip, tapeAround(trunk, level("buttockheight")), "hip", more, more);

    const auto scale = [&](double& value, double read, const char* dimension, With with) {
      value *= std::clamp(more * sizes_.size(dimension, with) / read, 0.8, 1.25);
    };
    scale(fit.neck, more * neckGirth(body), "neckcircumference", With::build);
    fit.neck = std::clamp(fit.neck, kLeastShare, kGreatestShare);
    const Vec3d brow(0.0, joints_.at[jEye].y() + 0.27 * (sizes_.person().stature - joints_.at[jEye].y()), -0.02);
    // A squarer section is longer around.
    fit.head *= std::pow(0.985 * sizes_.size("headcircumference", With::head) / tapeAround(trunk, brow).girth, 4.0);
    const Vec3d upper = joints_.at[jElbow] - joints_.at[jGlenohumeral];
    const Vec3d lower = joints_.at[jWrist] - joints_.at[jElbow];
    scale(fit.upperArm, across(arm, joints_.at[jGlenohumeral] + 0.54 * upper, upper), "bicepscircumferenceflexed",
          With::build);
    scale(fit.forearm, across(arm, joints_.at[jElbow] + 0.22 * lower, lower), "forearmcircumferenceflexed",
          With::build);
    scale(fit.wrist, across(arm, joints_.at[jElbow] + 0.985 * lower, lower), "wristcircumference", With::build);
    scale(fit.thigh, legGirth(leg, sizes_.size("crotchheight", With::stature) - 0.0256 * sizes_.person().stature),
          "thighcircumference", With::build);
    const double knee = joints_.at[jKnee].y();
    const double shank = knee - joints_.at[jAnkle].y();
    const double thigh = sizes_.size("crotchheight", With::stature) - knee;
    scale(fit.knee, legGirth(leg, knee + 0.30 * thigh), "lowerthighcircumference", With::build);
    scale(fit.calf, legGirth(leg, knee - 0.30 * shank), "calfcircumference", With::build);
    scale(fit.ankle, legGirth(leg, knee - 0.88 * shank), "anklecircumference", With::build);
  }

 private:
  Vec3d level(const char* height) const { return {0.0, sizes_.size(height, With::stature), -0.02}; }

  void belt(BodyFit::Belt& belt, const TapeReading& read, const std::string& name, double more, double girth) const {
    const bool hip = name == "hip";
    belt.girth = girth;
    const auto correct = [&](double& value, const std::string& dimension, double reading) {
      value = std::clamp(value * more * sizes_.size(dimension, With::build) / reading, kLeastShare, kGreatestShare);
    };
    correct(belt.breadth, name + "breadth", read.breadth);
    correct(belt.depth, hip ? "buttockdepth" : name + "depth", read.depth);
    const double wanted = girth * sizes_.size(hip ? "buttockcircumference" : name + "circumference", With::build);
    // The girth for the new breadth and depth, then the exponent that makes up for the rest.
    const double scaled = read.girth * 0.5 *
                          (more * sizes_.size(name + "breadth", With::build) / read.breadth +
                           more * sizes_.size(hip ? "buttockdepth" : name + "depth", With::build) / read.depth);
    belt.squareness = std::clamp(belt.squareness * std::pow(wanted / scaled, 5.0), 1.9, 11.0);
  }

  /// Girth at a right angle to a limb.
  static double across(const std::function<double(const Vec3d&)>& field, const Vec3d& place, const Vec3d& limb) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitY(), limb);
    return tapeAround([&](const Vec3d& p) { return field(place + turn * p); }, Vec3d::Zero()).girth;
  }

  double legGirth(const std::function<double(const Vec3d&)>& leg, double height) const {
    const Vec3d& hip = joints_.at[jHip];
    const Vec3d& ankle = joints_.at[jAnkle];
    const double t = (hip.y() - height) / (hip.y() - ankle.y());
    Vec3d inside = hip + t * (ankle - hip);
    inside.x() = std::max(inside.x(), 0.05 * sizes_.person().stature);
    return tapeAround(leg, inside).girth;
  }

  /// At a right angle to the neck, under the larynx.
  double neckGirth(const BodyField& body) const {
    const Vec3d& low = joints_.at[jC7T1];
    const Vec3d& high = joints_.at[jHead];
    const Vec3d place = low + 0.45 * (high - low) + Vec3d(0.0, 0.0, 0.012);
    return across([&](const Vec3d& p) { return body.withoutArms(p); }, place, high - low);
  }

  // A tape that meets a neighbouring part reads too much whatever is done to its own.
  static constexpr double kLeastShare = 0.80;
  static constexpr double kGreatestShare = 1.25;
  static constexpr double kLeast = 0.020;
  static constexpr double kFullLeeway = 0.10;

  const Anthropometry& sizes_;
  const BodyJoints& joints_;
  double leeway_;  ///< how far girths may leave the survey's for the sake of the mass, as a share
};

}  // namespace

double meanDensity(human::Sex sex) {
  return sex == human::Sex::male ? 1051.0 : 1034.0;
}

double lungAir(const human::Person& person) {
  // ICRP 89: lungs of 3141 and 2468 cm3 that weigh 1.20 and 0.95 kg at a tissue density of 1.05, of a reference stature
  // of 1.76 and 1.63 m.
  const bool male = person.sex == human::Sex::male;
  const double air = male ? 3141.4e-6 - 1.2 / 1050.0 : 2467.5e-6 - 0.95 / 1050.0;
  return air * std::pow(person.stature / (male ? 1.76 : 1.63), 3.0);
}

double bodyVolume(const human::Person& person) {
  return person.mass / meanDensity(person.sex) + lungAir(person);
}

double volumeInside(const std::function<double(const Vec3d&)>& field, const geometry::Box3d& box, double cell,
                    base::Threads threads) {
  constexpr int block = 8;
  const Vec3d blocks = (box.sizes() / (cell * block)).array().ceil();
  const auto layers = static_cast<std::size_t>(blocks.y());
  std::vector<double> perLayer(layers, 0.0);
  base::parallelFor(layers, 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t layer = begin; layer < end; ++layer) {
      for (int bx = 0; bx < static_cast<int>(blocks.x()); ++bx) {
        for (int bz = 0; bz < static_cast<int>(blocks.z()); ++bz) {
          const Vec3d corner = box.min() + cell * block * Vec3d(bx, static_cast<double>(layer), bz);
          const double middle = field(corner + 0.5 * cell * block * Vec3d::Ones());
          if (std::abs(middle) > 1.8 * cell * block) {
            perLayer[layer] += middle < 0.0 ? static_cast<double>(block * block * block) : 0.0;
            continue;
          }
          for (int i = 0; i < block; ++i) {
            for (int j = 0; j < block; ++j) {
              for (int k = 0; k < block; ++k) {
                const double value = field(corner + cell * (Vec3d(i, j, k) + Vec3d::Constant(0.5)));
                // A cell that the surface cuts counts in part.
                perLayer[layer] += std::clamp(0.5 - value / cell, 0.0, 1.0);
              }
            }
          }
        }
      }
    }
  });
  double sum = 0.0;
  for (const double layer : perLayer) {
    sum += layer;
  }
  return sum * cell * cell * cell;
}

geometry::Box3d bodyBox(const Anthropometry& sizes, const BodyJoints& joints) {
  const double h = sizes.person().stature;
  const double hand = std::max(0.75, 1.1 * joints.armDirection.x());
  const double side = joints.at[jWrist].x() + hand * sizes.size("handlength", With::stature);
  const double depth = std::max({sizes.size("waistdepth", With::build), sizes.size("chestdepth", With::build),
                                 sizes.size("buttockdepth", With::build)});
  const double front = std::max(0.70 * depth + 0.03, 0.16 * h);
  const double back = std::max(0.55 * depth + 0.05, 0.10 * h);
  return {Vec3d(-side, -0.02, -back), Vec3d(side, h + 0.02, front)};
}

BodyFit fitBody(const Anthropometry& sizes, const BodyJoints& joints, base::Threads threads,
                const base::Progress& progress) {
  BodyFit fit;
  const Fitter fitter(sizes, joints);
  const double wanted = bodyVolume(sizes.person());
  const geometry::Box3d box = bodyBox(sizes, joints);
  double lastFlesh = 0.0;
  double lastVolume = 0.0;
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < (round == 0 ? 6 : 3); ++i) {
      progress.check();
      fitter.tape(fit);
    }
    const BodyField body(sizes, joints, fit);
    const auto whole = [&](const Vec3d& p) {
      progress.check();
      return body.whole(p);
    };
    const double volume = volumeInside(whole, box, 0.0125, threads);
    if (std::abs(volume / wanted - 1.0) < 0.001) {
      break;
    }
    // A secant step once there are two points; about half of the volume is flesh that nobody measures.
    const double slope = round == 0 ? 0.5 * wanted : (volume - lastVolume) / (fit.flesh - lastFlesh);
    lastFlesh = fit.flesh;
    lastVolume = volume;
    fit.flesh = std::clamp(fit.flesh + (wanted - volume) / std::max(slope, 0.1 * wanted), 0.7, 1.5);
    if (fit.flesh == lastFlesh) {
      break;
    }
  }
  for (int i = 0; i < 4; ++i) {
    progress.check();
    fitter.tape(fit);
  }
  return fit;
}

}  // namespace lorica::manikin
