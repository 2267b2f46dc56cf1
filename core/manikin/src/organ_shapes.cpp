#include "organ_shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace lorica::manikin {

namespace {

using std::numbers::pi;

Vec3d mirrored(const Vec3d& p) {
  return {-p.x(), p.y(), p.z()};
}

/// 1 on the sheet where `distance` is zero, falling to nothing within about twice `width`.
double sheet(double distance, double width) {
  return std::exp(-(distance / width) * (distance / width));
}

/// Height of the diaphragm: two domes, and the tendon between them that carries the heart.
double diaphragm(double x, double z) {
  const double back = std::max(-0.005 - z, 0.0);
  const auto dome = [&](double top, double cx, double halfWidth, double drop) {
    const double u = (x - cx) / halfWidth;
    const double v = (z - 0.005) / 0.085;
    return top - drop * (u * u + v * v) - 2.2 * back * back;
  };
  const double right = dome(1.302, -0.068, 0.064, 0.055);
  const double left = dome(1.268, 0.074, 0.060, 0.050);
  const double tendon = 1.250 - 0.055 * (x - 0.005) * (x - 0.005) / (0.06 * 0.06) - 0.02 * (z / 0.085) * (z / 0.085);
  return smoothIntersection(smoothIntersection(right, left, 0.03), tendon, 0.03);
}

/// The lungs end before the diaphragm does.
double lungBase(const Vec3d& p) {
  return smoothIntersection(diaphragm(p.x(), p.z()) + 0.003, 1.218, 0.010);
}

/// A lung without its neighbours; `q` is mirrored so that the lung lies at positive x.
double lungBody(const Vec3d& q, double inner) {
  // A half ellipsoid on a cylinder, leaning to the midline on its way up; the apex stands above the clavicle.
  const double up = std::max(q.y() - 1.300, 0.0);
  const double lean = std::clamp(up / 0.165, 0.0, 1.2);
  const double centre = 0.068 - 0.024 * lean;
  const Vec3d semi(0.064, 0.168, 0.092);
  const double squareness = 2.5;
  const double dz = q.z() + 0.022 + 0.024 * lean;
  const double u = std::abs(q.x() - centre) / semi.x();
  const double w = std::abs(dz) / semi.z();
  const double round = std::pow(std::pow(u, squareness) + std::pow(w, squareness), 1.0 / squareness);
  const double v = up / semi.y();
  const double radius = std::sqrt(round * round + v * v);
  const double scale = radius > 1e-9 ? Vec3d(q.x() - centre, up, dz).norm() / radius : semi.x();
  const double body = radius > 1e-9 ? scale * (radius - 1.0) : -semi.x();
  // Hollowed where bronchus and vessels come in.
  const double hilum = ellipsoidField(q, {0.022, 1.372, -0.034}, {0.026, 0.040, 0.026});
  return smoothIntersection(smoothIntersection(body, inner - q.x(), 0.02), -hilum, 0.012);
}

/// Furrow on a lung along the plane through `at` with the normal `normal`.
double fissure(const Vec3d& p, const Vec3d& at, const Vec3d& normal) {
  return 0.009 * sheet((p - at).dot(normal.normalized()), 0.0042);
}

double kidneyShape(const Vec3d& q) {
  // A bean bent around its hilum, which faces the spine and a little forward; the upper pole leans to the spine.
  static const std::array<Station, 5> bean{{{{0.0485, 1.181, -0.071}, 0.0250},
                                            {{0.0590, 1.165, -0.068}, 0.0280},
                                            {{0.0630, 1.148, -0.066}, 0.0285},
                                            {{0.0605, 1.131, -0.064}, 0.0280},
                                            {{0.0520, 1.115, -0.062}, 0.0250}}};
  // Flatter from front to back than from side to side.
  const Vec3d centre(0.058, 1.148, -0.065);
  const Vec3d p(q.x(), q.y(), centre.z() + 1.18 * (q.z() - centre.z()));
  const double body = limbField(p, bean);
  const double hilum = ellipsoidField(p, {0.0280, 1.148, -0.0600}, {0.0210, 0.0165, 0.0200});
  return smoothIntersection(body, -hilum, 0.010);
}

}  // namespace

double heartShape(const Vec3d& p) {
  const double leftVentricle = taperedCapsule(p, {0.010, 1.312, -0.002}, {0.060, 1.266, 0.040}, 0.0400, 0.0215);
  const double rightVentricle = taperedCapsule(p, {-0.014, 1.304, 0.034}, {0.048, 1.258, 0.044}, 0.0335, 0.0190);
  const double rightAtrium = ellipsoidField(p, {-0.029, 1.312, 0.006}, {0.0290, 0.0430, 0.0310});
  const double leftAtrium = ellipsoidField(p, {0.004, 1.338, -0.026}, {0.0370, 0.0270, 0.0230});
  const double auricle = taperedCapsule(p, {0.030, 1.345, -0.008}, {0.040, 1.337, 0.014}, 0.012, 0.008);
  const double aorticRoot = taperedCapsule(p, {-0.002, 1.325, 0.010}, {-0.008, 1.346, 0.014}, 0.0165, 0.0150);
  const double trunk = taperedCapsule(p, {0.008, 1.325, 0.036}, {0.016, 1.372, 0.016}, 0.0150, 0.0140);
  // The furrow between the ventricles runs down to the left of the front.
  const double ventricles = smoothUnion(leftVentricle, rightVentricle, 0.006);
  double field = smoothUnion(ventricles, smoothUnion(rightAtrium, leftAtrium, 0.010), 0.007);
  field = smoothUnion(field, auricle, 0.005);
  field = smoothUnion(smoothUnion(field, aorticRoot, 0.006), trunk, 0.006);
  // Behind it the aorta runs down.
  const double aorta = taperedCapsule(p, {0.024, 1.390, -0.048}, {0.010, 1.200, -0.044}, 0.0165, 0.0145);
  return smoothIntersection(field, -aorta, 0.006);
}

double lungLeftShape(const Vec3d& p) {
  double field = lungBody(p, 0.009);
  // The heart's notch in the front edge; the lingula comes back below it.
  const double notch = ellipsoidField(p, {0.026, 1.272, 0.072}, {0.038, 0.036, 0.036});
  field = smoothIntersection(field, -notch, 0.010);
  field = smoothIntersection(field, lungBase(p) - p.y(), 0.010);
  return field;
}

double lungRightShape(const Vec3d& p) {
  const Vec3d q = mirrored(p);
  double field = lungBody(q, 0.009);
  field = smoothIntersection(field, lungBase(p) - p.y(), 0.010);
  return field;
}

double lungLeftFurrows(const Vec3d& p) {
  return fissure(p, {0.07, 1.325, -0.030}, {0.0, 0.80, 0.62});
}

double lungRightFurrows(const Vec3d& p) {
  const Vec3d oblique(0.0, 0.80, 0.62);
  const Vec3d at(-0.07, 1.325, -0.030);
  // The horizontal fissure leaves the oblique one forward at the height of the fourth rib.
  const double beforeOblique = smoothStep(-0.006, 0.002, (p - at).dot(oblique.normalized()));
  return fissure(p, at, oblique) + beforeOblique * fissure(p, {-0.07, 1.338, 0.0}, {0.0, 1.0, 0.12});
}

double liverShape(const Vec3d& p) {
  // Under the right dome, along the wall of the trunk; the lower face rises to the left and to the back.
  const double wall = [&] {
    const double u = std::abs(p.x()) / 0.130;
    const double v = std::abs(p.z() + 0.004) / 0.090;
    const double radius = std::pow(std::pow(u, 2.4) + std::pow(v, 2.4), 1.0 / 2.4);
    return radius < 1e-6 ? -0.09 : std::hypot(p.x(), p.z() + 0.004) * (1.0 - 1.0 / radius);
  }();
  const double under = p.y() - (diaphragm(p.x(), p.z()) - 0.004);
  const double lower = 1.184 + 0.60 * p.x() - 0.10 * std::max(p.x(), 0.0) - 0.40 * p.z();
  const double below = 0.77 * (lower - p.y());
  const double leftEnd = 0.9 * (p.x() - 0.080);
  // The left lobe lies before the stomach, the right one reaches back to the ribs.
  const double behind = smoothStep(-0.035, 0.045, p.x());
  const double back = (-0.085 + 0.105 * behind) - p.z();
  double field = smoothIntersection(smoothIntersection(wall, under, 0.030), below, 0.020);
  field = smoothIntersection(smoothIntersection(field, leftEnd, 0.025), back, 0.025);
  // The caval vein lies in an open furrow of the back.
  const double furrow = taperedCapsule(p, {-0.026, 1.10, -0.062}, {-0.026, 1.33, -0.072}, 0.026, 0.026);
  field = smoothIntersection(field, -furrow, 0.012);
  // The fissure of the round ligament between the lobes, on the front and below.
  const double ligament = 0.007 * sheet(p.x() - 0.012, 0.0040) * smoothStep(-0.01, 0.03, p.z());
  const double gallbladder = 0.008 * sheet(p.x() + 0.050, 0.013) * smoothStep(0.0, 0.05, p.z()) * sheet(below, 0.02);
  return field + ligament + gallbladder;
}

double stomachShape(const Vec3d& p) {
  static const std::array<Station, 7> bag{{{{0.064, 1.236, -0.030}, 0.0420},
                                           {{0.073, 1.204, -0.008}, 0.0370},
                                           {{0.073, 1.170, 0.020}, 0.0310},
                                           {{0.060, 1.133, 0.042}, 0.0260},
                                           {{0.036, 1.112, 0.056}, 0.0225},
                                           {{0.010, 1.117, 0.062}, 0.0185},
                                           {{-0.018, 1.136, 0.056}, 0.0140}}};
  double field = taperedCapsule(p, bag[0].place, bag[1].place, bag[0].radius, bag[1].radius);
  for (std::size_t i = 1; i + 1 < bag.size(); ++i) {
    field =
        smoothUnion(field, taperedCapsule(p, bag[i].place, bag[i + 1].place, bag[i].radius, bag[i + 1].radius), 0.012);
  }
  const double cardia = taperedCapsule(p, {0.016, 1.250, -0.044}, {0.050, 1.226, -0.024}, 0.0080, 0.0120);
  return smoothUnion(field, cardia, 0.012);
}

double kidneyLeftShape(const Vec3d& p) {
  return kidneyShape(p);
}

double kidneyRightShape(const Vec3d& p) {
  return kidneyShape(mirrored(p) + Vec3d(0.0, 0.015, 0.0));
}

double spleenShape(const Vec3d& p) {
  // Along the tenth rib, its outer face against the diaphragm, hollowed where stomach and kidney touch it.
  static const Vec3d along = Vec3d(0.30, -0.50, 0.80).normalized();
  static const Vec3d outward = (Vec3d(0.86, 0.20, -0.48) - Vec3d(0.86, 0.20, -0.48).dot(along) * along).normalized();
  static const Vec3d across = along.cross(outward);
  const Vec3d d = p - Vec3d(0.1000, 1.205, -0.066);
  const Vec3d local(d.dot(along), d.dot(across), d.dot(outward));
  const double body = ellipsoidField(local, {0, 0, 0}, {0.059, 0.037, 0.024});
  const double hollow = (local - Vec3d(0.0, 0.0, -0.070)).norm() - 0.060;
  return smoothIntersection(body, -hollow, 0.012);
}

double pancreasShape(const Vec3d& p) {
  static const std::array<Station, 6> gland{{{{-0.036, 1.116, 0.018}, 0.0180},
                                             {{-0.028, 1.135, 0.022}, 0.0190},
                                             {{0.000, 1.149, 0.035}, 0.0125},
                                             {{0.028, 1.160, 0.022}, 0.0140},
                                             {{0.056, 1.174, -0.012}, 0.0135},
                                             {{0.080, 1.190, -0.044}, 0.0100}}};
  // Lobules.
  const double lobes = 0.0011 * std::sin(p.x() * 420.0) * std::sin(p.y() * 400.0 + 1.0) * std::sin(p.z() * 430.0);
  return limbField(p, gland) + lobes;
}

double intestineCore(const Vec3d& p) {
  return smoothUnion(ellipsoidField(p, {0.0, 1.006, 0.048}, {0.060, 0.040, 0.012}),
                     ellipsoidField(p, {0.0, 0.980, 0.040}, {0.045, 0.024, 0.014}), 0.02);
}

double bladderShape(const Vec3d& p) {
  const double body = ellipsoidField(p, {0.0, 0.938, 0.028}, {0.043, 0.034, 0.037});
  const double apex = taperedCapsule(p, {0.0, 0.945, 0.040}, {0.0, 0.968, 0.056}, 0.022, 0.008);
  const double neck = taperedCapsule(p, {0.0, 0.920, 0.026}, {0.0, 0.898, 0.026}, 0.018, 0.008);
  return smoothUnion(smoothUnion(body, apex, 0.02), neck, 0.02);
}

namespace {

/// Furrows of the cortex: the sheets where a sum of waves of one length in many directions changes its sign.
double convolutions(const Vec3d& p) {
  constexpr int waves = 11;
  constexpr double length = 0.0265;
  constexpr double golden = 2.399963229728653;
  double sum = 0.0;
  for (int i = 0; i < waves; ++i) {
    const double height = 1.0 - 2.0 * (i + 0.5) / waves;
    const double ring = std::sqrt(1.0 - height * height);
    const Vec3d direction(ring * std::cos(golden * i), height, ring * std::sin(golden * i));
    sum += std::sin(2.0 * pi / length * direction.dot(p) + 1.7 * i * i);
  }
  return sheet(sum / std::sqrt(0.5 * waves), 0.30);
}

}  // namespace

double brainShape(const Vec3d& p) {
  const Vec3d q(std::abs(p.x()), p.y(), p.z());
  const double whole = ellipsoidField(q, {0.0, 1.682, -0.006}, {0.0655, 0.0600, 0.0830});
  // The base: over the orbits in front, higher behind, where the cerebellum lies below.
  const double base = 1.648 + 0.16 * std::max(q.z(), 0.0) - q.y();
  double cerebrum = smoothIntersection(whole, base, 0.020);
  const double temporal = taperedCapsule(q, {0.042, 1.643, 0.028}, {0.046, 1.655, -0.044}, 0.0165, 0.0200);
  cerebrum = smoothUnion(cerebrum, temporal, 0.010);
  const double cerebellum = ellipsoidField(q, {0.024, 1.628, -0.058}, {0.0330, 0.0215, 0.0270});
  double stem = taperedCapsule(q, {0.0, 1.655, -0.016}, {0.0, 1.627, -0.012}, 0.0160, 0.0165);
  stem = smoothUnion(stem, taperedCapsule(q, {0.0, 1.626, -0.014}, {0.0, 1.599, -0.030}, 0.0125, 0.0080), 0.006);
  return smoothUnion(smoothUnion(cerebrum, cerebellum, 0.008), stem, 0.008);
}

double brainFurrows(const Vec3d& p) {
  const Vec3d q(std::abs(p.x()), p.y(), p.z());
  // The longitudinal fissure, down to the corpus callosum.
  double furrows = 0.030 * sheet(q.x(), 0.0038) * smoothStep(1.655, 1.685, q.y());
  const double cerebellum = ellipsoidField(q, {0.024, 1.628, -0.058}, {0.0330, 0.0215, 0.0270});
  const double outer = smoothStep(0.0, 0.006, cerebellum) * smoothStep(1.626, 1.640, q.y() + 0.4 * q.x());
  // Upright to the surface: what a furrow does depends on its direction from the middle alone.
  const Vec3d middle(0.0, 1.675, -0.006);
  const Vec3d semi(0.0655, 0.0600, 0.0830);
  const Vec3d direction = (q - middle).cwiseQuotient(semi);
  const Vec3d onSurface = middle + direction.cwiseProduct(semi) / std::max(direction.norm(), 1e-6);
  const double level = direction.y() / std::max(direction.norm(), 1e-6);
  const double sides = smoothStep(0.35, 0.55, direction.norm()) * smoothStep(-0.66, -0.42, level);
  furrows += 0.0066 * convolutions(onSurface) * outer * sides;
  // The lateral fissure above the temporal lobe, and the central one across the top.
  const double side = smoothStep(0.030, 0.045, q.x());
  const double lateral = (q - Vec3d(0.05, 1.656, 0.040)).dot(Vec3d(0.0, 0.966, -0.259));
  furrows += 0.0085 * sheet(lateral, 0.0032) * side * smoothStep(-0.045, -0.025, q.z());
  const double central = (q - Vec3d(0.0, 1.74, -0.016)).dot(Vec3d(-0.12, 0.30, 0.94).normalized());
  furrows += 0.0060 * sheet(central, 0.0028) * smoothStep(1.675, 1.695, q.y());
  // Leaves of the cerebellum.
  const double leaves = 0.5 + 0.5 * std::cos(2.0 * pi * (q.y() + 0.3 * q.z()) / 0.0095);
  furrows += 0.0022 * leaves * leaves * (1.0 - smoothStep(-0.002, 0.004, cerebellum));
  return furrows;
}

double thyroidShape(const Vec3d& p) {
  const Vec3d q(std::abs(p.x()), p.y(), p.z());
  const double lobe =
      smoothUnion(taperedCapsule(q, {0.0170, 1.474, -0.012}, {0.0185, 1.490, -0.011}, 0.0085, 0.0092),
                  taperedCapsule(q, {0.0185, 1.490, -0.011}, {0.0215, 1.520, -0.012}, 0.0092, 0.0052), 0.012);
  const double isthmus = taperedCapsule(q, {0.0, 1.484, 0.0068}, {0.0150, 1.484, -0.0010}, 0.0052, 0.0066);
  return smoothUnion(lobe, isthmus, 0.005);
}

double boneShape(const Vec3d& p) {
  static const std::array<Station, 10> bodies{{{{0.0, 0.900, -0.098}, 0.0160},
                                               {{0.0, 0.960, -0.088}, 0.0240},
                                               {{0.0, 1.018, -0.046}, 0.0240},
                                               {{0.0, 1.086, -0.031}, 0.0230},
                                               {{0.0, 1.150, -0.045}, 0.0220},
                                               {{0.0, 1.242, -0.077}, 0.0200},
                                               {{0.0, 1.349, -0.085}, 0.0180},
                                               {{0.0, 1.441, -0.055}, 0.0150},
                                               {{0.0, 1.479, -0.041}, 0.0120},
                                               {{0.0, 1.590, -0.020}, 0.0090}}};
  double spine = limbField(p, bodies);
  const Vec3d behind(0.0, 0.0, -0.030);
  for (std::size_t i = 2; i + 3 < bodies.size(); ++i) {
    spine = smoothUnion(spine, taperedCapsule(p, bodies[i].place + behind, bodies[i + 1].place + behind, 0.017, 0.016),
                        0.01);
  }
  const double pubis = ellipsoidField(p, {0.0, 0.905, 0.066}, {0.034, 0.022, 0.014});
  return std::min(spine, pubis);
}

std::vector<Station> smoothTube(std::span<const Station> stations, double step) {
  std::vector<Station> tube;
  const std::size_t n = stations.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec3d p0 = i == 0 ? Vec3d(2.0 * stations[0].place - stations[1].place) : stations[i - 1].place;
    const Vec3d& p1 = stations[i].place;
    const Vec3d& p2 = stations[i + 1].place;
    const Vec3d p3 = i + 2 < n ? stations[i + 2].place : Vec3d(2.0 * p2 - p1);
    const double t1 = std::sqrt(std::max((p1 - p0).norm(), 1e-9));
    const double t2 = t1 + std::sqrt(std::max((p2 - p1).norm(), 1e-9));
    const double t3 = t2 + std::sqrt(std::max((p3 - p2).norm(), 1e-9));
    const int pieces = std::max(1, static_cast<int>(std::ceil((p2 - p1).norm() / step)));
    for (int k = 0; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      const double t = t1 + share * (t2 - t1);
      const auto blend = [&](const Vec3d& a, double ta, const Vec3d& b, double tb) -> Vec3d {
        return ((tb - t) * a + (t - ta) * b) / (tb - ta);
      };
      const Vec3d a1 = blend(p0, 0.0, p1, t1);
      const Vec3d a2 = blend(p1, t1, p2, t2);
      const Vec3d a3 = blend(p2, t2, p3, t3);
      const Vec3d place = blend(blend(a1, 0.0, a2, t2), t1, blend(a2, t1, a3, t3), t2);
      tube.push_back({place, stations[i].radius + share * (stations[i + 1].radius - stations[i].radius)});
    }
  }
  tube.push_back(stations.back());
  return tube;
}

std::vector<Station> largeIntestineTube() {
  static const std::array<Station, 25> course{
      {{{-0.078, 0.972, 0.034}, 0.0225},  // caecum
       {{-0.089, 0.998, 0.028}, 0.0240},  {{-0.098, 1.040, 0.010}, 0.0215}, {{-0.100, 1.080, -0.004}, 0.0205},
       {{-0.090, 1.100, 0.016}, 0.0190},  // right flexure
       {{-0.066, 1.090, 0.052}, 0.0180},  {{-0.034, 1.074, 0.070}, 0.0175}, {{0.000, 1.066, 0.074}, 0.0170},
       {{0.036, 1.074, 0.072}, 0.0165},   {{0.070, 1.098, 0.058}, 0.0155},  {{0.098, 1.136, 0.028}, 0.0150},
       {{0.112, 1.166, -0.010}, 0.0150},  {{0.114, 1.160, -0.040}, 0.0145},  // left flexure
       {{0.114, 1.120, -0.044}, 0.0140},  {{0.114, 1.070, -0.034}, 0.0135}, {{0.112, 1.020, -0.012}, 0.0135},
       {{0.102, 0.978, 0.018}, 0.0135},   {{0.078, 0.952, 0.032}, 0.0135},  // sigmoid
       {{0.048, 0.960, 0.012}, 0.0135},   {{0.030, 0.982, -0.006}, 0.0135}, {{0.006, 0.982, -0.024}, 0.0135},
       {{-0.002, 0.958, -0.042}, 0.0145}, {{0.000, 0.925, -0.056}, 0.0170},  // rectum
       {{0.000, 0.896, -0.056}, 0.0175},  {{0.000, 0.868, -0.042}, 0.0090}}};
  std::vector<Station> tube = smoothTube(course, 0.004);
  // Haustra: pinched every 27 mm as far as the sigmoid goes.
  constexpr double pitch = 0.027;
  constexpr double rectumTop = 0.950;
  double run = 0.0;
  for (std::size_t i = 1; i < tube.size(); ++i) {
    run += (tube[i].place - tube[i - 1].place).norm();
    const double phase = run / pitch - std::floor(run / pitch) - 0.5;
    const bool rectum = tube[i].place.y() < rectumTop && std::abs(tube[i].place.x()) < 0.01;
    if (!rectum && i + 4 < tube.size()) {
      tube[i].radius *= 1.08 - 0.38 * sheet(phase, 0.15);
    }
  }
  return tube;
}

std::vector<Station> smallIntestineTube() {
  // Rows from side to side, before and behind, each row waving; their ends turn into the next.
  constexpr double radius = 0.0118;
  constexpr int rows = 6;
  std::vector<Station> course;
  double side = 1.0;
  for (int layer = 0; layer < 2; ++layer) {
    for (int row = 0; row < rows; ++row) {
      const int at = layer == 0 ? row : rows - 1 - row;
      const double height = 1.056 - 0.0212 * at;
      const double half = 0.079 * std::sqrt(1.0 - std::pow((at - 2.0) / 4.8, 2.0)) - 0.012 * layer;
      const double depth = (layer == 0 ? 0.071 : 0.030) - 0.0015 * at;
      constexpr int points = 11;
      for (int k = 0; k < points; ++k) {
        const double s = -1.0 + 2.0 * k / (points - 1);
        const double wave = std::sin(7.0 * s + 1.9 * at + 2.3 * layer);
        const double other = std::cos(5.3 * s + 2.7 * at + 0.8 * layer);
        const double bow = (layer == 0 ? -0.016 : 0.004) * s * s;
        course.push_back({{side * s * half, height + 0.0075 * wave, depth + 0.0055 * other + bow}, radius});
      }
      side = -side;
    }
  }
  return smoothTube(course, 0.005);
}

std::vector<Station> spinalCordTube() {
  // In the canal behind the bodies, from the great foramen to the first lumbar disc.
  static const std::array<Station, 10> course{{{{0.0, 1.589, -0.0335}, 0.0055},
                                               {{0.0, 1.560, -0.0370}, 0.0055},
                                               {{0.0, 1.520, -0.0430}, 0.0060},
                                               {{0.0, 1.479, -0.0580}, 0.0056},
                                               {{0.0, 1.441, -0.0745}, 0.0046},
                                               {{0.0, 1.349, -0.1060}, 0.0042},
                                               {{0.0, 1.280, -0.1040}, 0.0044},
                                               {{0.0, 1.215, -0.0910}, 0.0050},
                                               {{0.0, 1.180, -0.0780}, 0.0044},
                                               {{0.0, 1.152, -0.0680}, 0.0018}}};
  return smoothTube(course, 0.004);
}

std::vector<std::vector<Station>> tracheaTubes() {
  static const std::array<Station, 5> windpipe{{{{0.0, 1.512, -0.0060}, 0.0100},
                                                {{0.0, 1.485, -0.0085}, 0.0088},
                                                {{0.0, 1.450, -0.0170}, 0.0086},
                                                {{0.001, 1.420, -0.0280}, 0.0086},
                                                {{0.002, 1.398, -0.0350}, 0.0090}}};
  static const std::array<Station, 3> right{
      {{{0.000, 1.399, -0.0350}, 0.0080}, {{-0.018, 1.380, -0.0370}, 0.0074}, {{-0.034, 1.361, -0.0370}, 0.0066}}};
  static const std::array<Station, 4> left{{{{0.002, 1.399, -0.0350}, 0.0076},
                                            {{0.018, 1.384, -0.0380}, 0.0066},
                                            {{0.033, 1.374, -0.0390}, 0.0064},
                                            {{0.046, 1.364, -0.0390}, 0.0058}}};
  std::vector<std::vector<Station>> tubes{smoothTube(windpipe, 0.001), smoothTube(right, 0.001),
                                          smoothTube(left, 0.001)};
  // Rings of cartilage.
  constexpr double pitch = 0.0062;
  for (std::vector<Station>& tube : tubes) {
    double run = 0.0;
    for (std::size_t i = 1; i < tube.size(); ++i) {
      run += (tube[i].place - tube[i - 1].place).norm();
      tube[i].radius += 0.0004 * std::cos(2.0 * pi * run / pitch);
    }
  }
  return tubes;
}

}  // namespace lorica::manikin
