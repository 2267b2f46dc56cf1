#include "armor_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "armor_sizes.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::manikin {

namespace {

using geometry::TriangleMesh;
using human::JointIndex;

JointIndex joint(const human::Skeleton& skeleton, const std::string& name) {
  const auto found = skeleton.find(name);
  LORICA_CHECK(found.has_value(), "armor is cut by the joints of the joint table");
  return *found;
}

std::vector<char> branch(const human::Skeleton& skeleton, const std::vector<std::string>& roots) {
  std::vector<char> in(skeleton.size(), 0);
  for (const std::string& name : roots) {
    in[joint(skeleton, name).value] = 1;
  }
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const auto& parent = skeleton.joints()[j].parent;
    in[j] = in[j] != 0 || (parent && in[parent->value] != 0) ? 1 : 0;
  }
  return in;
}

std::vector<double> shareOf(const Body& body, const std::vector<std::string>& roots) {
  const std::vector<char> in = branch(body.skeleton, roots);
  std::vector<double> share(body.skin.positions.size(), 0.0);
  for (std::size_t i = 0; i < body.weights.joints.size(); ++i) {
    if (in[body.weights.joints[i]] != 0) {
      share[i / body.weights.influences] += static_cast<double>(body.weights.weights[i]);
    }
  }
  return share;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void extend(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double middle() const { return 0.5 * (low + high); }
};

/// Where a line along an axis meets the mesh.
std::optional<Range> along(const TriangleMesh& mesh, Eigen::Index axis, const Vec3d& through) {
  const Eigen::Index u = (axis + 1) % 3;
  const Eigen::Index v = (axis + 2) % 3;
  Range range;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0);
    const Vec3d b = mesh.corner(t, 1);
    const Vec3d c = mesh.corner(t, 2);
    const double whole = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    const double s = (through[u] - a[u]) * (c[v] - a[v]) - (through[v] - a[v]) * (c[u] - a[u]);
    const double r = (b[u] - a[u]) * (through[v] - a[v]) - (b[v] - a[v]) * (through[u] - a[u]);
    if (whole == 0.0 || s / whole < 0.0 || r / whole < 0.0 || (s + r) / whole > 1.0) {
      continue;
    }
    range.extend(a[axis] + (s * (b[axis] - a[axis]) + r * (c[axis] - a[axis])) / whole);
  }
  return range.low <= range.high ? std::optional(range) : std::nullopt;
}

/// The triangles whose three corners pass.
template <class Keep>
TriangleMesh part(const TriangleMesh& mesh, const Keep& keep) {
  TriangleMesh kept{mesh.positions, {}};
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(kept.triangles),
               [&](const geometry::Triangle& t) { return keep(t[0]) && keep(t[1]) && keep(t[2]); });
  return kept;
}

double trunkMiddle(const TriangleMesh& trunk, double x, double y) {
  const auto range = along(trunk, 2, Vec3d(x, y, 0.0));
  LORICA_CHECK(range.has_value(), "a trunk between hips and shoulders");
  return range->middle();
}

/// The ridge of the shoulder beside x: the highest place of the skin over the trunk's depth.
void findRidge(ArmorLandmarks& marks, const TriangleMesh& trunk) {
  marks.shoulderTop = -std::numeric_limits<double>::infinity();
  constexpr int steps = 40;
  for (int i = -steps; i <= steps; ++i) {
    const double z = marks.shoulder.z() + 0.08 * i / steps;
    const auto range = along(trunk, 1, Vec3d(marks.midline + marks.strap, 0.0, z));
    if (range && range->high > marks.shoulderTop) {
      marks.shoulderTop = range->high;
      marks.ridge = z;
    }
  }
  LORICA_CHECK(std::isfinite(marks.shoulderTop), "shoulders beside the neck");
}

/// Least and most of half the breadths of the trunk between two heights.
Range halfBreadths(const ArmorLandmarks& marks, const TriangleMesh& trunk, double low, double high) {
  constexpr int levels = 16;
  Range halves;
  for (int i = 0; i <= levels; ++i) {
    const double y = low + (high - low) * i / levels;
    if (const auto range = along(trunk, 0, Vec3d(0.0, y, marks.coronal(y)))) {
      halves.extend(0.5 * (range->high - range->low));
    }
  }
  LORICA_CHECK(halves.low <= halves.high, "a trunk between crotch and armpit");
  return halves;
}

double armpitHeight(const Body& body, const BodyShares& shares, const Vec3d& shoulder) {
  // The fold is the lowest place at which arm and trunk meet.
  double lowest = shoulder.y();
  for (const geometry::Triangle& t : body.skin.triangles) {
    Range arm;
    Range height;
    for (const std::uint32_t v : t) {
      arm.extend(shares.arms[v]);
      height.extend(static_cast<double>(body.skin.positions[v].y()));
    }
    if (arm.low < 0.5 && arm.high >= 0.5) {
      lowest = std::min(lowest, height.middle());
    }
  }
  return lowest;
}

}  // namespace

double ArmorLandmarks::coronal(double y) const {
  const double low = std::min(hem, armpit - 0.05);
  if (y <= armpit) {
    return hemMiddle + std::max(0.0, (y - low) / (armpit - low)) * (armpitMiddle - hemMiddle);
  }
  return armpitMiddle + std::min(1.0, (y - armpit) / (shoulderTop - armpit)) * (ridge - armpitMiddle);
}

BodyShares bodyShares(const Body& body) {
  return {shareOf(body, {"glenohumeral_L", "glenohumeral_R"}), shareOf(body, {"hip_L", "hip_R"}),
          shareOf(body, {"head_C0C1"})};
}

geometry::TriangleMesh withoutArms(const geometry::TriangleMesh& skin, const BodyShares& shares) {
  return part(skin, [&](std::uint32_t v) { return shares.arms[v] < 0.5; });
}

ArmorLandmarks armorLandmarks(const Body& body, const BodyShares& shares) {
  const auto at = [&](const char* name) { return body.skeleton.restPosition(joint(body.skeleton, name)); };
  const auto left = [&](const std::string& name) {
    const Vec3d l = body.skeleton.restPosition(joint(body.skeleton, name + "_L"));
    const Vec3d r = body.skeleton.restPosition(joint(body.skeleton, name + "_R"));
    return Vec3d(0.5 * (l.x() - r.x()), 0.5 * (l.y() + r.y()), 0.5 * (l.z() + r.z()));
  };
  const geometry::Box3d box = geometry::bounds(body.skin.positions);
  const TriangleMesh trunk = withoutArms(body.skin, shares);
  const TriangleMesh lower = part(trunk, [&](std::uint32_t v) { return shares.head[v] < 0.5; });
  const TriangleMesh head = part(body.skin, [&](std::uint32_t v) { return shares.head[v] >= 0.5; });

  ArmorLandmarks marks;
  marks.stature = box.sizes().y();
  marks.midline = at("pelvis_root").x();
  marks.shoulder = left("glenohumeral");
  marks.elbow = left("elbow");

  const double notchY = left("sternoclavicular").y() + notchOverSternoclavicular() * marks.stature;
  const double napeY = at("spine_C7T1").y() + cervicaleOverC7T1() * marks.stature;
  const auto chest = along(lower, 2, Vec3d(marks.midline, notchY, 0.0));
  const auto back = along(lower, 2, Vec3d(marks.midline, napeY, 0.0));
  LORICA_CHECK(chest && back, "a neck over the trunk");
  marks.notch = {marks.midline, notchY, chest->high};
  marks.nape = {marks.midline, napeY, back->low};

  const Vec3d neck = 0.5 * (at("spine_C7T1") + at("head_C0C1"));
  const auto neckRange = along(trunk, 0, neck);
  LORICA_CHECK(neckRange.has_value(), "a neck between trunk and head");
  marks.neckHalfBreadth = 0.5 * (neckRange->high - neckRange->low);

  marks.chin = at("head_C0C1").y();
  for (const geometry::Triangle& t : head.triangles) {
    for (const std::uint32_t v : t) {
      const Vec3d p = head.positions[v].cast<double>();
      if (std::abs(p.x() - marks.midline) < 0.03 && p.z() > at("head_C0C1").z() + 0.03) {
        marks.chin = std::min(marks.chin, p.y());
      }
    }
  }

  marks.strap = 0.58 * marks.shoulder.x();
  findRidge(marks, trunk);
  marks.armpit = armpitHeight(body, shares, marks.shoulder);
  marks.hem = at("spine_L3L4").y();
  marks.hemMiddle = trunkMiddle(trunk, marks.midline, marks.hem);
  marks.armpitMiddle = trunkMiddle(trunk, marks.midline, marks.armpit);

  const double hip = left("hip").y();
  const auto between = along(trunk, 1, Vec3d(marks.midline, 0.0, marks.hemMiddle));
  const double lowest = hip - 0.06 * marks.stature;  // where the thighs touch, the line runs on between them
  marks.crotch = between ? std::max(between->low, lowest) : lowest;
  marks.waistHalf = halfBreadths(marks, trunk, marks.hem, marks.armpit).low;
  marks.flankHalf = halfBreadths(marks, trunk, marks.crotch, marks.armpit).high;
  return marks;
}

}  // namespace lorica::manikin
