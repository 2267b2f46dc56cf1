#include "body_shape.h"

#include "lorica/geometry/isosurface.h"

namespace lorica::manikin {

namespace {

/// A horizontal section of the trunk.
struct Section {
  double height;
  double halfWidth;
  double back;   ///< z of the hindmost point
  double front;  ///< z of the foremost point
};

// Breadths and depths after the ANSUR II male medians at crotch, buttock, waist, tenth rib, nipple and axilla height;
// z follows the discs of the joint table, which lie 70 to 90 mm before the skin of the back.
constexpr std::array<Section, 10> kTrunk{{{0.860, 0.130, -0.112, 0.080},
                                          {0.910, 0.166, -0.118, 0.094},
                                          {0.970, 0.165, -0.116, 0.104},
                                          {1.055, 0.156, -0.108, 0.108},
                                          {1.130, 0.152, -0.114, 0.105},
                                          {1.210, 0.160, -0.132, 0.106},
                                          {1.300, 0.170, -0.148, 0.106},
                                          {1.370, 0.162, -0.143, 0.086},
                                          {1.430, 0.130, -0.120, 0.054},
                                          {1.480, 0.080, -0.098, 0.026}}};

/// Section at a height, by cubic Hermite interpolation with the slopes of the neighbours.
Section sectionAt(double height) {
  const double h = std::clamp(height, kTrunk.front().height, kTrunk.back().height);
  std::size_t i = 0;
  while (i + 2 < kTrunk.size() && h > kTrunk[i + 1].height) {
    ++i;
  }
  const Section& s0 = kTrunk[i == 0 ? 0 : i - 1];
  const Section& s1 = kTrunk[i];
  const Section& s2 = kTrunk[i + 1];
  const Section& s3 = kTrunk[std::min(i + 2, kTrunk.size() - 1)];
  const double span = s2.height - s1.height;
  const double t = (h - s1.height) / span;
  const auto blend = [&](double Section::*value) {
    const double slope1 = span * (s2.*value - s0.*value) / (s2.height - s0.height);
    const double slope2 = span * (s3.*value - s1.*value) / (s3.height - s1.height);
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * s1.*value + (t3 - 2.0 * t2 + t) * slope1 + (3.0 * t2 - 2.0 * t3) * s2.*value +
           (t3 - t2) * slope2;
  };
  return {h, blend(&Section::halfWidth), blend(&Section::back), blend(&Section::front)};
}

double torsoField(const Vec3d& p) {
  constexpr double squareness = 2.4;  // 2 is an ellipse
  const Section section = sectionAt(p.y());
  const double middle = 0.5 * (section.front + section.back);
  const double halfDepth = 0.5 * (section.front - section.back);
  const Eigen::Vector2d q(p.x(), p.z() - middle);
  const double u = std::abs(q.x()) / section.halfWidth;
  const double v = std::abs(q.y()) / halfDepth;
  const double radius = std::pow(std::pow(u, squareness) + std::pow(v, squareness), 1.0 / squareness);
  const double side = radius < 1e-6 ? -std::min(section.halfWidth, halfDepth) : q.norm() * (1.0 - 1.0 / radius);
  const double ends = std::max(kTrunk.front().height - 0.03 - p.y(), p.y() - kTrunk.back().height);
  return smoothIntersection(side, ends, 0.06);
}

double headField(const Vec3d& p) {
  double field = ellipsoidField(p, {0.0, 1.655, -0.006}, {0.077, 0.1, 0.099});
  field = smoothUnion(field, ellipsoidField(p, {0.0, 1.592, 0.030}, {0.056, 0.072, 0.056}), 0.05);
  field = smoothUnion(field, taperedCapsule(p, {0.0, 1.610, 0.088}, {0.0, 1.634, 0.084}, 0.011, 0.006), 0.025);
  const double neck = taperedCapsule(p, {0.0, 1.435, -0.050}, {0.0, 1.580, -0.016}, 0.066, 0.057);
  return smoothUnion(field, neck, 0.03);
}

const Vec3d kArmDirection(0.5, -0.8660254037844386, 0.0);  // 30 degrees from the trunk

double handField(const Vec3d& p) {
  const Vec3d& wristPlace = restPositions()[wrist];
  const Vec3d across(kArmDirection.y(), -kArmDirection.x(), 0.0);
  const Vec3d local(kArmDirection.dot(p - wristPlace), across.dot(p - wristPlace), p.z() - wristPlace.z());
  double field = ellipsoidField(local, {0.055, 0.0, -0.002}, {0.064, 0.017, 0.043});
  field = smoothUnion(field, ellipsoidField(local, {0.125, 0.004, -0.002}, {0.066, 0.013, 0.036}), 0.02);
  return smoothUnion(field, taperedCapsule(local, {0.03, 0.003, 0.022}, {0.1, 0.008, 0.054}, 0.016, 0.012), 0.015);
}

double footField(const Vec3d& p) {
  const Vec3d& ball = restPositions()[toe];
  const Vec3d& joint = restPositions()[ankle];
  double field = ellipsoidField(p, joint + Vec3d(0.0, -0.038, -0.022), {0.036, 0.046, 0.048});
  field = smoothUnion(
      field, taperedCapsule(p, joint + Vec3d(0.0, -0.022, 0.014), ball + Vec3d(-0.004, 0.006, 0.0), 0.036, 0.032),
      0.03);
  field = smoothUnion(field, ellipsoidField(p, ball + Vec3d(0.0, -0.008, 0.0), {0.050, 0.030, 0.070}), 0.03);
  field = smoothUnion(field, ellipsoidField(p, ball + Vec3d(0.0, -0.012, 0.038), {0.043, 0.022, 0.048}), 0.02);
  return smoothIntersection(field, -p.y(), 0.012);
}

}  // namespace

const std::array<Vec3d, toe + 1>& restPositions() {
  static const std::array<Vec3d, toe + 1> positions = [] {
    std::array<Vec3d, toe + 1> p;
    // Fractions of stature: ANSUR II landmarks and the curve of the spine.
    p[pelvisRoot] = kStature * Vec3d(0.0, 0.5130, 0.0);
    p[spineL5S1] = kStature * Vec3d(0.0, 0.5801, -0.0261);
    p[spineL3L4] = kStature * Vec3d(0.0, 0.6189, -0.0176);
    p[spineL1L2] = kStature * Vec3d(0.0, 0.6553, -0.0256);
    p[spineT10T11] = kStature * Vec3d(0.0, 0.7079, -0.0441);
    p[spineT6T7] = kStature * Vec3d(0.0, 0.7687, -0.0486);
    p[spineT2T3] = kStature * Vec3d(0.0, 0.8211, -0.0314);
    p[spineC7T1] = kStature * Vec3d(0.0, 0.8429, -0.0235);
    p[headC0C1] = kStature * Vec3d(0.0, 0.9092, -0.0113);
    p[sternoclavicular] = kStature * Vec3d(0.0175, 0.8162, 0.0075);
    p[glenohumeral] = kStature * Vec3d(0.1000, 0.8005, -0.0240);
    // Lengths of upper arm and forearm of the same table, laid along the arm of the A-pose.
    p[elbow] = p[glenohumeral] + 0.2874 * kArmDirection + Vec3d(0.0, 0.0, 0.007);
    p[wrist] = p[elbow] + 0.2743 * kArmDirection + Vec3d(0.0, 0.0, 0.017);
    // Legs a little apart, so that the thighs stay two limbs.
    p[hip] = kStature * Vec3d(0.0454, 0.5130, 0.0);
    p[knee] = kStature * Vec3d(0.0665, 0.2800, -0.0048);
    p[ankle] = kStature * Vec3d(0.0840, 0.0415, -0.0106);
    p[toe] = kStature * Vec3d(0.0915, 0.0156, 0.0659);
    return p;
  }();
  return positions;
}

double trunkField(const Vec3d& mirrored) {
  double field = torsoField(mirrored);
  const double shoulder = taperedCapsule(mirrored, {0.030, 1.462, -0.052}, {0.165, 1.413, -0.045}, 0.046, 0.046);
  field = smoothUnion(field, shoulder, 0.06);
  field = smoothUnion(field, ellipsoidField(mirrored, {0.078, 0.905, -0.062}, {0.082, 0.085, 0.068}), 0.04);
  return smoothUnion(field, headField(mirrored), 0.05);
}

double armField(const Vec3d& mirrored) {
  static const std::array<Station, 7> arm = [] {
    const Vec3d& shoulder = restPositions()[glenohumeral];
    const Vec3d upper = restPositions()[elbow] - shoulder;
    const Vec3d lower = restPositions()[wrist] - restPositions()[elbow];
    return std::array<Station, 7>{{{shoulder, 0.057},
                                   {shoulder + 0.25 * upper, 0.055},
                                   {shoulder + 0.55 * upper, 0.051},
                                   {shoulder + upper, 0.042},
                                   {shoulder + upper + 0.25 * lower, 0.045},
                                   {shoulder + upper + 0.60 * lower, 0.037},
                                   {shoulder + upper + lower, 0.028}}};
  }();
  return smoothUnion(limbField(mirrored, arm), handField(mirrored), 0.02);
}

double legField(const Vec3d& mirrored) {
  static const std::array<Station, 8> leg = [] {
    const Vec3d& top = restPositions()[hip];
    const Vec3d& middle = restPositions()[knee];
    const Vec3d shank = restPositions()[ankle] - middle;
    return std::array<Station, 8>{{{top + Vec3d(0.014, 0.0, -0.004), 0.082},
                                   {top + Vec3d(0.021, -0.120, 0.002), 0.087},
                                   {top + Vec3d(0.027, -0.250, 0.006), 0.074},
                                   {middle + Vec3d(0.0, 0.040, 0.002), 0.060},
                                   {middle + Vec3d(0.0, -0.040, -0.002), 0.056},
                                   {middle + 0.30 * shank + Vec3d(0.0, 0.0, -0.012), 0.058},
                                   {middle + 0.65 * shank + Vec3d(0.0, 0.0, -0.006), 0.044},
                                   {middle + shank, 0.035}}};
  }();
  return smoothUnion(limbField(mirrored, leg), footField(mirrored), 0.025);
}

geometry::TriangleMesh skinSurface() {
  constexpr double cell = 0.012;
  // Soles and the plane of symmetry lie in the middle of grid cells.
  const geometry::Box3d box(Vec3d(-0.606, -0.018, -0.204), Vec3d(0.606, 1.782, 0.264));
  const auto field = [](const Vec3d& point) {
    const Vec3d p = mirroredToLeft(point);
    return smoothUnion(smoothUnion(trunkField(p), legField(p), 0.05), armField(p), 0.04);
  };
  return geometry::isosurface(field, box, cell);
}

}  // namespace lorica::manikin
