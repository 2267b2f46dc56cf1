#include <array>

#include "fields.h"
#include "lorica/geometry/isosurface.h"
#include "plain_parts.h"

namespace lorica::manikin {

namespace {

using geometry::Box3d;
using Field = double (*)(const Vec3d&);

// Places: the stylised phantom's centres, mapped to this body (x narrowed to 0.8, heights so that crotch and C7/T1
// fall together), then moved apart where the rounded shapes met. Sizes: chosen for the volumes of ICRP 89.

/// Keeps a field 2 mm away from an organ that was there first.
double besides(double field, double first) {
  return smoothIntersection(field, 0.002 - first, 0.008);
}

double heart(const Vec3d& p) {
  const Vec3d axis = Vec3d(0.62, -0.60, 0.50).normalized();  // from base to apex: left, down, forward
  const Vec3d centre(0.012, 1.285, 0.022);
  return taperedCapsule(p, centre - 0.022 * axis, centre + 0.030 * axis, 0.052, 0.0415);
}

double liver(const Vec3d& p) {
  const double whole = ellipsoidField(p, {-0.052, 1.168, 0.004}, {0.095, 0.076, 0.079});
  // Its lower face slopes from the right flank up to the left and to the back.
  const Vec3d below = Vec3d(0.50, -0.80, -0.25).normalized();
  return smoothIntersection(whole, (p - Vec3d(-0.055, 1.128, 0.004)).dot(below), 0.03);
}

double lung(const Vec3d& p, double side, double halfWidth, double halfDepth) {
  const Vec3d mirrored(side * p.x(), p.y(), p.z());
  const double dome = ellipsoidField(mirrored, {0.084, 1.235, -0.030}, {halfWidth, 0.190, halfDepth});
  const double base = 1.200 - 0.175 * (p.z() + 0.03) - p.y();
  return besides(besides(smoothIntersection(dome, base, 0.03), heart(p)), liver(p));
}

double leftLung(const Vec3d& p) {
  return lung(p, 1.0, 0.055, 0.0565);
}
double rightLung(const Vec3d& p) {
  return lung(p, -1.0, 0.058, 0.071);
}

double stomach(const Vec3d& p) {
  const double body = taperedCapsule(p, {0.078, 1.168, 0.012}, {0.058, 1.105, 0.040}, 0.034, 0.025);
  const double exit = taperedCapsule(p, {0.058, 1.105, 0.040}, {0.005, 1.088, 0.052}, 0.022, 0.014);
  return besides(smoothUnion(body, exit, 0.03), liver(p));
}

double spleen(const Vec3d& p) {
  return besides(ellipsoidField(p, {0.098, 1.160, -0.058}, {0.024, 0.052, 0.030}), leftLung(p));
}

double kidney(const Vec3d& p, double side, double height) {
  return ellipsoidField(p, {side * 0.055, height, -0.066}, {0.026, 0.055, 0.0246});
}
double leftKidney(const Vec3d& p) {
  return besides(kidney(p, 1.0, 1.105), spleen(p));
}
double rightKidney(const Vec3d& p) {
  return besides(kidney(p, -1.0, 1.085), liver(p));
}

double largeIntestine(const Vec3d& p) {
  static const std::array<Station, 9> path{{{{-0.098, 0.970, 0.030}, 0.0187},
                                            {{-0.104, 1.045, 0.010}, 0.0187},
                                            {{-0.085, 1.066, 0.045}, 0.0187},
                                            {{-0.020, 1.048, 0.072}, 0.0187},
                                            {{0.050, 1.054, 0.066}, 0.0187},
                                            {{0.105, 1.070, 0.010}, 0.0187},
                                            {{0.106, 0.975, 0.010}, 0.0187},
                                            {{0.055, 0.930, -0.020}, 0.0187},
                                            {{0.000, 0.905, -0.045}, 0.0187}}};
  return limbField(p, path);
}

double smallIntestine(const Vec3d& p) {
  double field = ellipsoidField(p, {-0.036, 1.000, 0.034}, {0.041, 0.040, 0.043});
  field = smoothUnion(field, ellipsoidField(p, {0.038, 0.998, 0.034}, {0.041, 0.040, 0.043}), 0.012);
  field = smoothUnion(field, ellipsoidField(p, {0.000, 0.962, 0.034}, {0.056, 0.037, 0.040}), 0.012);
  field = smoothUnion(field, ellipsoidField(p, {0.000, 1.020, 0.012}, {0.058, 0.036, 0.040}), 0.012);
  return besides(field, largeIntestine(p));
}

double spinalCord(const Vec3d& p) {
  static const std::array<Station, 7> path{{{{0.0, 1.160, -0.072}, 0.0046},
                                            {{0.0, 1.242, -0.102}, 0.0046},
                                            {{0.0, 1.320, -0.112}, 0.0046},
                                            {{0.0, 1.390, -0.103}, 0.0046},
                                            {{0.0, 1.460, -0.078}, 0.0046},
                                            {{0.0, 1.530, -0.052}, 0.0046},
                                            {{0.0, 1.590, -0.042}, 0.0046}}};
  return limbField(p, path);
}

struct Recipe {
  const char* name;
  Field field;
  Vec3d low;  ///< box of the organ with some room
  Vec3d high;
  double cell;
};

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all{
      {"heart", heart, {-0.07, 1.20, -0.06}, {0.10, 1.37, 0.11}, 0.006},
      {"lung_left", leftLung, {0.0, 1.15, -0.13}, {0.16, 1.45, 0.07}, 0.009},
      {"lung_right", rightLung, {-0.16, 1.15, -0.13}, {0.0, 1.45, 0.07}, 0.009},
      {"liver", liver, {-0.17, 1.06, -0.10}, {0.07, 1.27, 0.11}, 0.009},
      {"spleen", spleen, {0.05, 1.09, -0.11}, {0.14, 1.23, 0.0}, 0.005},
      {"stomach", stomach, {-0.04, 1.05, -0.05}, {0.14, 1.23, 0.10}, 0.006},
      {"kidney_left", leftKidney, {0.01, 1.03, -0.11}, {0.10, 1.18, -0.02}, 0.005},
      {"kidney_right", rightKidney, {-0.10, 1.01, -0.11}, {-0.01, 1.16, -0.02}, 0.005},
      {"small_intestine", smallIntestine, {-0.11, 0.89, -0.06}, {0.11, 1.09, 0.10}, 0.008},
      {"large_intestine", largeIntestine, {-0.14, 0.87, -0.08}, {0.14, 1.11, 0.11}, 0.007},
      {"spinal_cord", spinalCord, {-0.0125, 1.1425, -0.1325}, {0.0125, 1.61, -0.02}, 0.003},
  };
  return all;
}

}  // namespace

std::vector<PlainOrgan> plainOrgans() {
  std::vector<PlainOrgan> organs;
  for (const Recipe& recipe : recipes()) {
    organs.push_back({recipe.name, geometry::isosurface(recipe.field, Box3d(recipe.low, recipe.high), recipe.cell)});
  }
  return organs;
}

std::vector<std::string> builtinOrganNames() {
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) {
    names.emplace_back(recipe.name);
  }
  return names;
}

}  // namespace lorica::manikin
