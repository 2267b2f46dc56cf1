#include "body_field.h"

#include <cmath>

namespace lorica::manikin {

namespace {

using Build = GrowsWith;

/// The sizes a part is drawn from, gathered once.
struct Drawn {
  const Anthropometry& sizes;
  const BodyJoints& joints;
  const BodyFit& fit;

  double stature() const { return sizes.person().stature; }
  bool female() const { return sizes.person().sex == human::Sex::female; }
  /// A length drawn for the median man, on this person.
  double tall(double metres) const { return metres * stature() / 1.755; }
  double height(const char* landmark) const { return sizes.size(landmark, Build::stature); }
  double girth(const char* dimension) const { return sizes.size(dimension, Build::build); }
  double length(const char* dimension) const { return sizes.size(dimension, Build::stature); }
  double headSize(const char* dimension) const { return sizes.size(dimension, Build::head); }
};

/// The hindmost and foremost point of a belt, whose depth is the survey's.
struct Reach {
  double back;
  double front;
};

struct Belts {
  Reach chest;
  Reach waist;
  Reach hip;
  double chestHalf;
  double waistHalf;
  double hipHalf;
};

Belts beltsOf(const Drawn& d) {
  // How much of a depth lies behind the hip axis, after the curve of the spine and the tissue behind it: the back
  // stays, what a person puts on goes mostly to the front.
  const auto reach = [&](double depth, double median, double behind) {
    const double more = depth - median;
    return Reach{-(behind + 0.30 * more), depth - behind - 0.30 * more};
  };
  const bool f = d.female();
  Belts b;
  const double chestDepth = d.girth("chestdepth") * d.fit.chest.depth;
  const double waistDepth = d.girth("waistdepth") * d.fit.waist.depth;
  const double hipDepth = d.girth("buttockdepth") * d.fit.hip.depth;
  b.chest = reach(chestDepth, f ? 0.245 : 0.253, d.tall(f ? 0.139 : 0.150));
  b.waist = reach(waistDepth, f ? 0.209 : 0.234, d.tall(f ? 0.101 : 0.106));
  b.hip = reach(hipDepth, f ? 0.231 : 0.246, d.tall(f ? 0.135 : 0.138));
  b.chestHalf = 0.5 * d.girth("chestbreadth") * d.fit.chest.breadth;
  b.waistHalf = 0.5 * d.girth("waistbreadth") * d.fit.waist.breadth;
  b.hipHalf = 0.5 * d.girth("hipbreadth") * d.fit.hip.breadth;
  return b;
}

Loft drawTrunk(const Drawn& d) {
  const Belts b = beltsOf(d);
  const double crotch = d.height("crotchheight");
  const double hipY = d.height("buttockheight");
  const double waistY = d.height("waistheightomphalion");
  const double ribY = d.height("tenthribheight");
  const double chestY = d.height("chestheight");
  const double axillaY = d.height("axillaheight");
  const double notchY = d.height("suprasternaleheight");
  const double flesh = d.fit.flesh;
  const bool f = d.female();
  const double shoulderHalf = 0.5 * d.length("biacromialbreadth");
  const auto between = [](double a, double c, double t) { return a + t * (c - a); };
  const auto section = [](double at, double half, Reach z, double widest, double squareness) {
    return Section{at, half, z.front, z.back, widest, squareness, 0.0};
  };
  const auto mixed = [&](const Reach& a, const Reach& c, double t) {
    return Reach{between(a.back, c.back, t), between(a.front, c.front, t)};
  };
  // Thickens a section nobody measures about its own middle.
  const auto fleshed = [&](Reach z, double share) {
    const double more = 0.5 * share * (flesh - 1.0) * (z.front - z.back);
    return Reach{z.back - more, z.front + more};
  };
  // A woman's ribs under the bust are less deep than the tape over it.
  const Reach ribs{b.chest.back, f ? b.chest.front - d.tall(0.042) : b.chest.front};
  const double iliacY = between(hipY, waistY, 0.55);
  const std::array sections{
      section(crotch + d.tall(0.012), 0.80 * b.hipHalf, {0.66 * b.hip.back, 0.60 * b.hip.front}, 0.52, 2.4),
      section(between(crotch, hipY, 0.85), 0.985 * b.hipHalf, {0.90 * b.hip.back, 0.88 * b.hip.front}, 0.50,
              d.fit.hip.squareness),
      section(hipY, b.hipHalf, {0.985 * b.hip.back, b.hip.front}, 0.50, d.fit.hip.squareness),
      section(iliacY, between(b.hipHalf, b.waistHalf, 0.55) * (f ? 0.985 : 1.0) * (0.8 + 0.2 * flesh),
              fleshed(mixed(b.hip, b.waist, 0.62), 0.3), 0.48,
              between(d.fit.hip.squareness, d.fit.waist.squareness, 0.5)),
      section(waistY, b.waistHalf, b.waist, 0.46, d.fit.waist.squareness),
      section(ribY, between(b.waistHalf, b.chestHalf, 0.45) * (f ? 0.965 : 1.0) * (0.5 + 0.5 * flesh),
              fleshed(mixed(b.waist, ribs, 0.45), 0.7), 0.47,
              between(d.fit.waist.squareness, d.fit.chest.squareness, 0.25)),
      section(between(ribY, chestY, 0.55), between(b.waistHalf, b.chestHalf, 0.85) * (0.5 + 0.5 * flesh),
              fleshed(mixed(b.waist, ribs, 0.86), 0.8), 0.48,
              between(d.fit.waist.squareness, d.fit.chest.squareness, 0.7)),
      section(chestY, b.chestHalf, ribs, 0.48, d.fit.chest.squareness),
      section(axillaY, 1.03 * b.chestHalf * (0.5 + 0.5 * flesh),
              fleshed({0.995 * b.chest.back, 0.90 * ribs.front}, 0.5), 0.45, between(d.fit.chest.squareness, 2.6, 0.5)),
      section(between(axillaY, notchY, 0.60), 0.72 * shoulderHalf,
              fleshed({0.94 * b.chest.back, 0.58 * ribs.front}, 0.5), 0.42, 2.5),
      section(notchY + d.tall(0.004), 0.52 * shoulderHalf, {0.85 * b.chest.back, d.tall(0.036)}, 0.42, 2.2),
      section(notchY + d.tall(0.036), 0.33 * shoulderHalf, {0.72 * b.chest.back, d.tall(0.014)}, 0.42, 2.0),
  };
  return {LoftFrame{}, sections, d.tall(0.035), d.tall(0.03), d.tall(0.022)};
}

Loft drawNeck(const Drawn& d) {
  const double half = d.girth("neckcircumference") / 6.2832 * d.fit.neck;
  const double base = 0.5 * (d.girth("neckcircumferencebase") / d.girth("neckcircumference") - 1.0);
  LoftFrame frame;
  frame.origin = Vec3d(0.0, d.height("cervicaleheight") - d.tall(0.10), -d.tall(0.056));
  const Vec3d top(0.0, d.height("cervicaleheight") + d.tall(0.09), -d.tall(0.014));
  frame.axis = (top - frame.origin).normalized();
  frame.front = frame.side.cross(frame.axis);
  const double length = (top - frame.origin).norm();
  const std::array sections{
      Section{0.0, 1.12 * half * (1.0 + base), 0.98 * half * (1.0 + base), -1.02 * half * (1.0 + base), 0.5, 2.0, 0.0},
      Section{0.38 * length, 1.00 * half, 1.02 * half, -1.05 * half, 0.5, 2.05, 0.0},
      Section{0.60 * length, 0.97 * half, 1.04 * half, -1.02 * half, 0.5, 2.05, 0.0},
      Section{length, 0.98 * half, 0.96 * half, -1.00 * half, 0.5, 2.0, 0.0}};
  return {frame, sections, d.tall(0.03), d.tall(0.03)};
}

/// Where the parts of the face are.
struct Face {
  double top;
  double eyeY;
  double chinY;
  double glabella;  ///< z
  double occiput;
  double half;  ///< breadth of the skull

  double deep(double metres) const { return metres * (glabella - occiput) / 0.200; }
};

/// The survey's girth of the head belongs to a tilted tape; a level one over its breadth and length needs a little
/// more of both, else the skull would be square.
constexpr double kRoundHead = 1.015;

Face faceOf(const Drawn& d) {
  Face face;
  face.top = d.stature();
  face.eyeY = d.joints.at[jEye].y();
  face.chinY = face.eyeY + d.tall(0.004) - d.length("mentonsellionlength");
  const double length = kRoundHead * d.headSize("headlength");
  const double middle = d.joints.at[jHead].z() + d.tall(0.002);
  face.glabella = middle + 0.5 * length;
  face.occiput = middle - 0.5 * length;
  face.half = 0.5 * kRoundHead * d.headSize("headbreadth");
  return face;
}

Loft drawHead(const Drawn& d) {
  const Face c = faceOf(d);
  const double cheek = 0.5 * d.headSize("bizygomaticbreadth");
  const double lower = c.eyeY - c.chinY;  // eye to chin
  const double upper = c.top - c.eyeY;
  const double jaw = d.female() ? 0.90 : 1.0;
  const double g = c.glabella;
  const double o = c.occiput;
  const double n = 2.18 * d.fit.head;
  const auto y = [&](double t) { return c.chinY + t * lower; };
  const std::array sections{
      Section{y(0.05), 0.36 * cheek * jaw, g - c.deep(0.012), g - c.deep(0.075), 0.45, 2.3, 0.0},
      Section{y(0.18), 0.61 * cheek * jaw, g - c.deep(0.005), g - c.deep(0.115), 0.40, 2.35, 0.0},
      Section{y(0.36), 0.79 * cheek * jaw, g - c.deep(0.001), g - c.deep(0.150), 0.38, 2.35, 0.0},
      Section{y(0.58), 0.885 * cheek, g - c.deep(0.004), g - c.deep(0.176), 0.42, 2.3, 0.0},
      Section{y(0.80), 0.965 * cheek, g - c.deep(0.008), o + c.deep(0.010), 0.46, 2.3, 0.0},
      Section{y(1.00), 0.955 * c.half, g - c.deep(0.010), o + c.deep(0.002), 0.46, 2.25, 0.0},
      Section{c.eyeY + 0.16 * upper, 0.985 * c.half, g, o, 0.45, n, 0.0},
      Section{c.eyeY + 0.30 * upper, c.half, g, o + c.deep(0.001), 0.44, n, 0.0},
      Section{c.eyeY + 0.42 * upper, 0.985 * c.half, g - c.deep(0.005), o + c.deep(0.004), 0.44, n, 0.0}};
  return {LoftFrame{}, sections, d.tall(0.012), c.top - sections.back().at, d.tall(0.006)};
}

Loft drawArm(const Drawn& d) {
  const BodyJoints& j = d.joints;
  LoftFrame frame;
  frame.origin = j.at[jGlenohumeral];
  frame.axis = (j.at[jWrist] - j.at[jGlenohumeral]).normalized();
  frame.front = (Vec3d::UnitZ() - frame.axis.z() * frame.axis).normalized();
  frame.side = frame.front.cross(frame.axis);  // up and out
  const double length = (j.at[jWrist] - j.at[jGlenohumeral]).norm();
  const double elbow = (j.at[jElbow] - j.at[jGlenohumeral]).norm();
  const double rU = d.girth("bicepscircumferenceflexed") / 6.2832 * d.fit.upperArm;
  const double rF = d.girth("forearmcircumferenceflexed") / 6.2832 * d.fit.forearm;
  const double rW = d.girth("wristcircumference") / 6.2832 * d.fit.wrist;
  const double flesh = 0.5 + 0.5 * d.fit.flesh;
  const double lower = length - elbow;
  const std::array sections{
      Section{-0.01 * length, 1.00 * rU * flesh, 0.96 * rU, -1.00 * rU, 0.5, 2.1, 0.0},
      Section{0.18 * elbow, 1.06 * rU * flesh, 1.00 * rU, -1.05 * rU, 0.5, 2.1, 0.004},
      Section{0.42 * elbow, 0.97 * rU, 1.00 * rU, -1.03 * rU, 0.5, 2.1, 0.002},
      Section{0.56 * elbow, 0.96 * rU, 1.06 * rU, -1.00 * rU, 0.5, 2.1, 0.0},
      Section{0.78 * elbow, 0.84 * rU * flesh, 0.86 * rU * flesh, -0.88 * rU * flesh, 0.5, 2.1, 0.0},
      Section{elbow, 0.92 * rF * flesh, 0.84 * rF * flesh, -0.92 * rF * flesh, 0.5, 2.2, 0.0},
      Section{elbow + 0.22 * lower, 1.00 * rF, 1.02 * rF, -0.98 * rF, 0.5, 2.1, 0.003},
      Section{elbow + 0.50 * lower, 0.84 * rF * flesh, 0.90 * rF * flesh, -0.88 * rF * flesh, 0.5, 2.1, 0.001},
      Section{elbow + 0.80 * lower, 0.93 * rW * flesh, 1.16 * rW * flesh, -1.16 * rW * flesh, 0.5, 2.2, 0.0},
      Section{length, 0.80 * rW, 1.18 * rW, -1.18 * rW, 0.5, 2.3, 0.0}};
  return {frame, sections, 1.05 * rU, 0.5 * rW, d.tall(0.014)};
}

Loft drawPalm(const Drawn& d) {
  const BodyJoints& j = d.joints;
  LoftFrame frame;
  frame.origin = j.at[jWrist];
  frame.axis = j.armDirection;
  frame.front = Vec3d::UnitZ();
  frame.side = frame.front.cross(frame.axis);
  const double hand = d.length("handlength");
  const double half = 0.5 * d.length("handbreadth");
  const double rW = d.girth("wristcircumference") / 6.2832 * d.fit.wrist;
  const std::array sections{Section{-0.05 * hand, 0.78 * rW, 1.16 * rW, -1.16 * rW, 0.5, 2.3, 0.0},
                            Section{0.10 * hand, 0.42 * half, 0.80 * half, -0.84 * half, 0.5, 2.5, -0.003},
                            Section{0.27 * hand, 0.37 * half, 0.90 * half, -0.98 * half, 0.5, 2.6, -0.003},
                            Section{0.42 * hand, 0.30 * half, 0.94 * half, -1.02 * half, 0.5, 2.8, -0.001},
                            Section{0.50 * hand, 0.25 * half, 0.88 * half, -0.95 * half, 0.5, 2.8, 0.0}};
  return {frame, sections, 0.02, 0.03 * hand};
}

Loft drawLeg(const Drawn& d) {
  const BodyJoints& j = d.joints;
  LoftFrame frame;
  // From the groin down; the axis runs from the hip joint to the ankle.
  frame.origin = j.at[jHip];
  frame.axis = (j.at[jAnkle] - j.at[jHip]).normalized();
  frame.side = (Vec3d::UnitX() - frame.axis.x() * frame.axis).normalized();
  frame.front = frame.side.cross(frame.axis);
  frame.front = frame.front.z() < 0.0 ? Vec3d(-frame.front) : frame.front;
  const auto down = [&](double height) { return (j.at[jHip].y() - height) / -frame.axis.y(); };
  const double crotch = d.height("crotchheight");
  const double knee = d.height("lateralfemoralepicondyleheight");
  const double ankle = d.height("lateralmalleolusheight");
  const double shank = knee - ankle;
  const double thigh = crotch - knee;
  const double rT = d.girth("thighcircumference") / 6.2832 * d.fit.thigh;
  const double rK = d.girth("lowerthighcircumference") / 6.2832 * d.fit.knee;
  const double rC = d.girth("calfcircumference") / 6.2832 * d.fit.calf;
  const double rA = d.girth("anklecircumference") / 6.2832 * d.fit.ankle;
  const double flesh = d.fit.flesh;
  const double soft = 0.3 + 0.7 * flesh;
  // The thighs' inner sides keep a hand's breadth less than nothing between them: 9 mm either side of the middle.
  const double groinAxis = j.at[jHip].x() + down(crotch - 0.03 * thigh) * frame.axis.x();
  // Its outer side carries on the hip's.
  const double outer = 0.537 * d.girth("hipbreadth") * d.fit.hip.girth;
  const double halfThigh = std::clamp(0.5 * (outer - d.tall(0.0095)), 0.76 * rT, 0.95 * rT);
  const double thighDepth = std::max(rT * 1.13, std::sqrt(std::max(0.0, 2.0 * rT * rT - halfThigh * halfThigh)));
  const double aside = d.tall(0.0095) + halfThigh - groinAxis;
  const std::array sections{
      Section{down(crotch + 0.22 * thigh), 0.62 * halfThigh, 0.74 * thighDepth, -0.80 * thighDepth, 0.5, 2.2,
              aside - 0.12 * halfThigh},
      Section{down(crotch + 0.08 * thigh), 0.93 * halfThigh, 0.88 * thighDepth, -1.02 * thighDepth, 0.5, 2.2,
              aside - 0.02 * halfThigh},
      Section{down(crotch - 0.03 * thigh), halfThigh, 0.90 * thighDepth, -1.08 * thighDepth, 0.5, 2.15, aside},
      Section{down(crotch - 0.14 * thigh), 0.985 * halfThigh, 0.89 * thighDepth, -1.02 * thighDepth, 0.5, 2.15, aside},
      Section{down(crotch - 0.42 * thigh), 0.76 * rT * soft, 0.90 * rT * soft, -0.86 * rT * soft, 0.5, 2.1,
              0.55 * aside},
      Section{down(crotch - 0.57 * thigh), 0.50 * rT * soft + 0.40 * rK, 0.52 * rT * soft + 0.42 * rK,
              -0.50 * rT * soft - 0.41 * rK, 0.5, 2.1, 0.2 * aside},
      Section{down(crotch - 0.70 * thigh), 1.04 * rK, 1.04 * rK, -1.02 * rK, 0.5, 2.1, 0.0},
      Section{down(knee + 0.07 * shank), 0.90 * rK, 0.98 * rK, -0.90 * rK, 0.5, 2.25, -0.002},
      Section{down(knee - 0.05 * shank), 0.875 * rC, 0.86 * rC, -0.93 * rC, 0.5, 2.25, -0.001},
      Section{down(knee - 0.30 * shank), 0.97 * rC, 0.74 * rC, -1.27 * rC, 0.5, 2.1, 0.0},
      Section{down(knee - 0.52 * shank), 0.80 * rC * flesh, 0.70 * rC, -0.98 * rC * flesh, 0.5, 2.1, 0.0},
      Section{down(knee - 0.74 * shank), 1.06 * rA * flesh, 1.05 * rA, -1.18 * rA * flesh, 0.5, 2.1, 0.0},
      Section{down(knee - 0.90 * shank), 0.92 * rA, 1.00 * rA, -1.06 * rA, 0.5, 2.1, 0.0},
      Section{down(ankle - 0.02 * shank), 1.02 * rA, 1.10 * rA, -1.12 * rA, 0.5, 2.1, 0.0}};
  return {frame, sections, 0.4 * thighDepth, 0.02, d.tall(0.026)};
}

LoftFrame footFrame(const Drawn& d) {
  LoftFrame frame;
  const double length = d.length("footlength");
  frame.axis = d.joints.footDirection;
  frame.side = Vec3d(frame.axis.z(), 0.0, -frame.axis.x());  // outwards
  frame.front = Vec3d::UnitY();
  // The heel lies behind the ankle by the joint table's share.
  const Vec3d& ankle = d.joints.at[jAnkle];
  frame.origin = Vec3d(ankle.x(), 0.0, ankle.z()) - 0.186 * length * frame.axis;
  return frame;
}

Loft drawFoot(const Drawn& d) {
  const double length = d.length("footlength");
  const double half = 0.5 * d.length("footbreadthhorizontal");
  const double heel = 0.5 * d.length("heelbreadth");
  const double ankle = d.height("lateralmalleolusheight");
  const std::array sections{Section{0.055 * length, 0.74 * heel, 0.75 * ankle, 0.0, 0.30, 2.3, 0.0},
                            Section{0.13 * length, 0.95 * heel, 1.05 * ankle, 0.0, 0.28, 2.3, 0.0},
                            Section{0.26 * length, 0.97 * heel, 1.12 * ankle, 0.0, 0.30, 2.3, 0.0},
                            Section{0.42 * length, 0.80 * half, 0.93 * ankle, 0.0, 0.30, 2.3, 0.001},
                            Section{0.58 * length, 0.90 * half, 0.68 * ankle, 0.0, 0.32, 2.4, 0.0},
                            Section{0.72 * length, 0.985 * half, 0.46 * ankle, 0.0, 0.40, 2.5, 0.0},
                            Section{0.80 * length, 0.93 * half, 0.34 * ankle, 0.0, 0.45, 2.5, 0.0}};
  return {footFrame(d), sections, 0.052 * length, 0.03 * length};
}

double capsules(const Vec3d& p, const std::vector<std::pair<Station, Station>>& all, double fillet) {
  double field = 1.0;
  for (const auto& [from, to] : all) {
    field = smoothUnion(field, taperedCapsule(p, from.place, to.place, from.radius, to.radius), fillet);
  }
  return field;
}

}  // namespace

BodyField::BodyField(const Anthropometry& sizes, const BodyJoints& joints, const BodyFit& fit)
    : joints_(joints),
      female_(sizes.person().sex == human::Sex::female),
      size_(sizes.person().stature / 1.755),
      trunk_(drawTrunk({sizes, joints, fit})),
      neck_(drawNeck({sizes, joints, fit})),
      head_(drawHead({sizes, joints, fit})),
      arm_(drawArm({sizes, joints, fit})),
      palm_(drawPalm({sizes, joints, fit})),
      leg_(drawLeg({sizes, joints, fit})),
      foot_(drawFoot({sizes, joints, fit})) {
  const Drawn d{sizes, joints, fit};
  const auto tall = [&](double metres) { return d.tall(metres); };
  const Belts belts = beltsOf(d);

  // The slope from the neck to the shoulder, and the shoulder's roof over the joint.
  const Vec3d& acromion = joints.at[jAcromioclavicular];
  const Vec3d& shoulder = joints.at[jGlenohumeral];
  const double neckHalf = d.girth("neckcircumference") / 6.2832;
  const Vec3d neckSide(0.50 * neckHalf, d.height("cervicaleheight") - tall(0.036), -tall(0.066));
  const double roof = d.girth("bicepscircumferenceflexed") / 6.2832;
  shoulder_ = {
      {{neckSide, tall(0.034)}, {Vec3d(0.96 * acromion.x(), acromion.y() - tall(0.026), shoulder.z()), tall(0.032)}},
      {{Vec3d(0.25 * shoulder.x(), shoulder.y() + tall(0.012), -tall(0.048)), tall(0.062)},
       {Vec3d(0.93 * shoulder.x(), shoulder.y() + tall(0.002), shoulder.z() - tall(0.006)), 0.95 * roof}}};

  buttock_ = Vec3d(0.46 * belts.hipHalf, d.height("buttockheight") + tall(0.012), 0.50 * belts.hip.back);
  buttockAxes_ = Vec3d(0.47 * belts.hipHalf, tall(0.088), -0.50 * belts.hip.back);
  const double chestY = d.height("chestheight");
  // No flatter than it is broad on a broad chest.
  const double bust = std::max(tall(0.062), 0.37 * belts.chestHalf);
  breast_ = Vec3d(0.50 * belts.chestHalf, chestY + tall(0.004), belts.chest.front - bust);
  breastAxes_ = Vec3d(0.47 * belts.chestHalf, 1.03 * bust, bust);

  if (!female_) {
    trunkHeaps_.push_back({{0.50 * belts.chestHalf, chestY + tall(0.018), belts.chest.front},
                           {tall(0.060), tall(0.045), tall(0.05)},
                           tall(0.007)});
  }
  // The furrow of the spine, the breastbone's hollow, the navel, the shoulder blades.
  trunkHeaps_.push_back(
      {{0.0, d.height("tenthribheight"), belts.waist.back}, {tall(0.020), tall(0.14), tall(0.05)}, -tall(0.008)});
  trunkHeaps_.push_back(
      {{0.0, chestY + tall(0.03), belts.chest.front}, {tall(0.018), tall(0.06), tall(0.04)}, -tall(0.006)});
  trunkHeaps_.push_back({{0.0, d.height("waistheightomphalion"), belts.waist.front},
                         {tall(0.010), tall(0.012), tall(0.02)},
                         -tall(0.006)});
  trunkHeaps_.push_back({{0.55 * belts.chestHalf, d.height("axillaheight") + tall(0.02), belts.chest.back},
                         {tall(0.050), tall(0.070), tall(0.05)},
                         tall(0.006)});

  const Face face = faceOf(d);
  const double g = face.glabella;
  const double eyeX = joints.at[jEye].x();
  const double soft = female_ ? 0.6 : 1.0;  // how marked brow and chin are
  const double lower = face.eyeY - face.chinY;
  noseTop_ = Vec3d(0.0, face.eyeY + tall(0.002), g - tall(0.011));
  noseTip_ = Vec3d(0.0, face.chinY + 0.565 * lower, g + tall(female_ ? 0.009 : 0.012));
  ear_ = Vec3d(face.half - tall(0.003), face.chinY + 0.80 * lower, 0.5 * (g + face.occiput) + tall(0.004));
  headHeaps_ = {
      // eye sockets, lids, brow
      {{eyeX, face.eyeY, g - tall(0.014)}, {tall(0.018), tall(0.012), tall(0.020)}, -tall(0.011)},
      {{eyeX, face.eyeY - tall(0.001), g - tall(0.020)}, {tall(0.011), tall(0.0065), tall(0.012)}, tall(0.007)},
      {{0.85 * eyeX, face.eyeY + tall(0.019), g - tall(0.004)},
       {tall(0.020), tall(0.007), tall(0.016)},
       soft * tall(0.004)},
      // cheekbone, the hollow below it
      {{1.45 * eyeX, face.chinY + 0.74 * lower, g - tall(0.028)}, {tall(0.018), tall(0.014), tall(0.022)}, tall(0.003)},
      {{1.45 * eyeX, face.chinY + 0.42 * lower, g - tall(0.035)},
       {tall(0.020), tall(0.020), tall(0.026)},
       -tall(0.003)},
      // lips and the line between them, the dent over the chin, the chin
      {{0.0, face.chinY + 0.395 * lower, g}, {tall(0.020), tall(0.0055), tall(0.012)}, tall(0.0045)},
      {{0.0, face.chinY + 0.320 * lower, g}, {tall(0.017), tall(0.0060), tall(0.012)}, tall(0.0050)},
      {{0.0, face.chinY + 0.360 * lower, g + tall(0.002)}, {tall(0.024), tall(0.0026), tall(0.012)}, -tall(0.0040)},
      {{0.0, face.chinY + 0.235 * lower, g - tall(0.002)}, {tall(0.020), tall(0.0070), tall(0.012)}, -tall(0.0040)},
      {{0.0, face.chinY + 0.130 * lower, g - tall(0.004)},
       {tall(0.018), tall(0.0120), tall(0.014)},
       soft * tall(0.0055)},
  };

  // Kneecap, the hollow behind the knee, ankle bones, heel cord.
  const Vec3d& knee = joints.at[jKnee];
  const Vec3d& ankle = joints.at[jAnkle];
  limbHeaps_ = {
      {knee + Vec3d(0.0, tall(0.004), tall(0.056)), {tall(0.026), tall(0.030), tall(0.02)}, tall(0.007)},
      {knee + Vec3d(0.0, tall(0.0), -tall(0.055)), {tall(0.026), tall(0.040), tall(0.03)}, -tall(0.005)},
      {ankle + Vec3d(tall(0.036), 0.0, -tall(0.004)), {tall(0.013), tall(0.016), tall(0.014)}, tall(0.005)},
      {ankle + Vec3d(-tall(0.036), tall(0.012), tall(0.004)), {tall(0.013), tall(0.016), tall(0.014)}, tall(0.005)},
      {ankle + Vec3d(tall(0.022), tall(0.03), -tall(0.036)), {tall(0.012), tall(0.05), tall(0.02)}, -tall(0.004)},
      {ankle + Vec3d(-tall(0.022), tall(0.03), -tall(0.036)), {tall(0.012), tall(0.05), tall(0.02)}, -tall(0.004)}};

  for (std::size_t f = 0; f < joints.fingers.size(); ++f) {
    const Finger& finger = joints.fingers[f];
    const double r = finger.radius;
    digits_.push_back({{finger.knuckle, (f == 0 ? 1.35 : 1.08) * r}, {finger.second, r}});
    digits_.push_back({{finger.second, r}, {finger.third, 0.90 * r}});
    digits_.push_back({{finger.third, 0.90 * r}, {finger.tip, 0.74 * r}});
  }
  const LoftFrame frame = footFrame(d);
  const double length = d.length("footlength");
  const double half = 0.5 * d.length("footbreadthhorizontal");
  struct Toe {
    double side;    ///< share of half the foot's breadth, inwards negative
    double end;     ///< share of the foot's length
    double radius;  ///< share of half the foot's breadth
  };
  constexpr std::array<Toe, 5> toes{
      {{-0.60, 1.000, 0.270}, {-0.13, 0.990, 0.180}, {0.19, 0.965, 0.170}, {0.47, 0.930, 0.162}, {0.73, 0.885, 0.160}}};
  for (const Toe& toe : toes) {
    const double r = toe.radius * half;
    const auto place = [&](double along, double height) -> Vec3d {
      return frame.origin + along * frame.axis + toe.side * half * frame.side + Vec3d(0.0, height, 0.0);
    };
    toes_.push_back(
        {{place((toe.end - 0.22) * length, 1.15 * r), 1.12 * r}, {place(toe.end * length - r, 0.98 * r), r}});
  }
}

double BodyField::heaped(double field, const Vec3d& p, const std::vector<Heap>& heaps) {
  for (const Heap& heap : heaps) {
    const double away = (p - heap.middle).cwiseQuotient(heap.reach).squaredNorm();
    if (away < 9.0) {
      field -= heap.height * std::exp(-away);
    }
  }
  return field;
}

double BodyField::trunk(const Vec3d& mirrored) const {
  double field = trunk_.field(mirrored);
  field = smoothUnion(field, ellipsoidField(mirrored, buttock_, buttockAxes_), 0.035 * size_);
  if (female_) {
    field = smoothUnion(field, ellipsoidField(mirrored, breast_, breastAxes_), 0.030 * size_);
  }
  field = smoothUnion(field, neck_.field(mirrored), 0.030 * size_);
  for (const auto& [from, to] : shoulder_) {
    field = smoothUnion(field, taperedCapsule(mirrored, from.place, to.place, from.radius, to.radius), 0.045 * size_);
  }
  return heaped(field, mirrored, trunkHeaps_);
}

double BodyField::head(const Vec3d& mirrored) const {
  double field = heaped(head_.field(mirrored), mirrored, headHeaps_);
  const double bridge = taperedCapsule(mirrored, noseTop_, noseTip_, 0.0055 * size_, 0.0100 * size_);
  const double wing =
      ellipsoidField(mirrored, noseTip_ + Vec3d(0.0105, -0.002, -0.009) * size_, Vec3d(0.0085, 0.0085, 0.0125) * size_);
  field = smoothUnion(field, smoothUnion(bridge, wing, 0.008 * size_), 0.014 * size_);
  // The ear's shell stands off a little behind.
  const Vec3d toEar = mirrored - ear_;
  const Vec3d turned(toEar.x() + 0.30 * toEar.z(), toEar.y() - 0.15 * toEar.z(), toEar.z() + 0.15 * toEar.y());
  const double ear = ellipsoidField(turned, Vec3d::Zero(), Vec3d(0.0075, 0.0285, 0.0160) * size_);
  return smoothUnion(field, ear, 0.008 * size_);
}

double BodyField::hand(const Vec3d& mirrored) const {
  double field = palm_.field(mirrored);
  for (std::size_t d = 0; d < digits_.size(); d += 3) {
    double digit = 1.0;
    for (std::size_t k = d; k < d + 3; ++k) {
      const auto& [from, to] = digits_[k];
      digit = std::min(digit, taperedCapsule(mirrored, from.place, to.place, from.radius, to.radius));
    }
    field = smoothUnion(field, digit, (d == 0 ? 0.018 : 0.009) * size_);
  }
  return field;
}

double BodyField::arm(const Vec3d& mirrored) const {
  const double field = arm_.field(mirrored);
  const Vec3d toWrist = mirrored - joints_.at[jWrist];
  if (toWrist.dot(joints_.armDirection) < -0.08) {
    return field;
  }
  return smoothUnion(field, hand(mirrored), 0.015 * size_);
}

double BodyField::foot(const Vec3d& mirrored) const {
  return smoothUnion(foot_.field(mirrored), capsules(mirrored, toes_, 0.004 * size_), 0.014 * size_);
}

double BodyField::leg(const Vec3d& mirrored) const {
  double field = leg_.field(mirrored);
  if (mirrored.y() < 0.16 * size_) {
    field = smoothUnion(field, foot(mirrored), 0.030 * size_);
  }
  field = heaped(field, mirrored, limbHeaps_);
  return smoothIntersection(field, -mirrored.y(), 0.008);
}

double BodyField::withoutArms(const Vec3d& p) const {
  const Vec3d mirrored = mirroredToLeft(p);
  double field = trunk(mirrored);
  if (mirrored.y() > joints_.at[jC7T1].y() - 0.10 * size_) {
    field = smoothUnion(field, head(mirrored), 0.022 * size_);
  }
  if (mirrored.y() < joints_.at[jL5S1].y() + 0.1 * size_) {
    // A wide fillet in the groin; at the outside, where hip and thigh lie on each other, it would only pad them.
    const double fillet = 0.032 + 0.013 * (1.0 - smoothStep(0.08, 0.15, mirrored.x() / size_));
    field = smoothUnion(field, leg(mirrored), fillet * size_);
  }
  return field;
}

double BodyField::whole(const Vec3d& p) const {
  return smoothUnion(withoutArms(p), arm(mirroredToLeft(p)), 0.018 * size_);
}

}  // namespace lorica::manikin
