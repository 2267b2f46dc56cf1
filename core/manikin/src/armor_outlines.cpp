#include "armor_outlines.h"

#include <algorithm>
#include <cmath>

#include "fields.h"

namespace lorica::manikin {

namespace {

/// The smaller of two with the corner rounded, over about `radius` metres.
double both(double a, double b, double radius = 0.02) {
  return smoothUnion(a, b, radius);
}

/// The larger of two, filleted alike.
double either(double a, double b, double radius) {
  return smoothIntersection(a, b, radius);
}

/// About the distance outside an ellipse around the origin.
double outsideEllipse(double x, double y, double rx, double ry) {
  const double u = x / rx;
  const double v = y / ry;
  const double share = std::hypot(u, v);
  if (share < 1e-9) {
    return -std::min(rx, ry);
  }
  // The value over its slope, to first order.
  const double slope = std::hypot(u / rx, v / ry) / share;
  return (share - 1.0) / slope;
}

constexpr double kCollarGap = 0.022;  ///< from the neck to a vest's neck line
constexpr double kCollarReach = kCollarGap + 0.018;
constexpr double kSideHalf = 0.055;   ///< half a side panel's depth
constexpr double kUnderSide = 0.03;   ///< how far front and back reach under a side panel
constexpr double kStrapOver = 0.025;  ///< how far the back's straps reach over the front's
constexpr double kSideBelowArmpit = 0.038;
constexpr double kFrontArmhole = 0.028;    ///< how far an armhole reaches below the armpit
constexpr double kBackArmhole = 0.045;     ///< the lowered arm presses against the back of it
constexpr double kCummerbundLeast = 0.02;  ///< of a side's breadth that a cummerbund covers
constexpr double kSideBelowHem = 0.025;    ///< the side panels reach down to the iliac crest

}  // namespace

Outlines::Outlines(const ArmorLandmarks& marks)
    : marks_(marks),
      neckBase_(0.5 * (marks.notch + marks.nape)),
      neckForward_((marks.notch - marks.nape).normalized()),
      neckUp_(neckForward_.cross(Vec3d::UnitX()).normalized()),
      neckDepth_(0.5 * (marks.notch - marks.nape).norm()) {}

double Outlines::shoulderShare(double y) const {
  return smoothStep(marks_.armpit, marks_.armpit + 0.06, y);
}

double Outlines::outsideNeck(const Vec3d& p) const {
  const Vec3d d = p - neckBase_;
  const double around = outsideEllipse(d.x(), d.dot(neckForward_), 1.25 * marks_.neckHalfBreadth, neckDepth_);
  return either(around, -d.dot(neckUp_), 0.02);  // chest and back run down beside the neck's axis
}

double Outlines::aboveNeckBase(const Vec3d& p) const {
  return (p - neckBase_).dot(neckUp_);
}

double Outlines::outsideArmhole(const Vec3d& q, double belowArmpit) const {
  const double inner = 0.82 * marks_.shoulder.x();
  const double centreX = marks_.shoulder.x() + 0.03;
  const double bottom = marks_.armpit - belowArmpit;
  const double centreY = 0.5 * (bottom + marks_.shoulderTop);
  const double y = q.y() - centreY;
  // Above its middle the armhole runs nearly straight up to the shoulder; all that lies further out is arm.
  return outsideEllipse(std::min(q.x() - centreX, 0.0), y, centreX - inner, y < 0.0 ? centreY - bottom : 0.25);
}

Outline Outlines::vestFront() const {
  return [*this](const Vec3d& p) {
    const Vec3d q = folded(p);
    const double seam = beforeCoronal(q) - (kSideHalf - kUnderSide) * (1.0 - shoulderShare(q.y()));
    const double neck = both(outsideNeck(p) - kCollarGap, neckBase_.y() + 0.05 - q.y());
    return both(both(seam, outsideArmhole(q, kFrontArmhole)), both(neck, q.y() - marks_.hem));
  };
}

Outline Outlines::vestBack() const {
  return [*this](const Vec3d& p) {
    const Vec3d q = folded(p);
    const double share = shoulderShare(q.y());
    const double seam = kStrapOver * share - (kSideHalf - kUnderSide) * (1.0 - share) - beforeCoronal(q);
    const double neck = both(outsideNeck(p) - kCollarGap, neckBase_.y() + 0.05 - q.y());
    return both(both(seam, outsideArmhole(q, kBackArmhole)), both(neck, q.y() - marks_.hem));
  };
}

Outline Outlines::side(double sign) const {
  return [*this, sign](const Vec3d& p) {
    const Vec3d q = folded(p);
    if (sign * (p.x() - marks_.midline) < 0.0) {
      return -0.1;
    }
    const double across = kSideHalf - std::abs(beforeCoronal(q));
    const double top = marks_.armpit - kSideBelowArmpit - q.y();
    return both(across, both(top, q.y() - marks_.hem + kSideBelowHem));
  };
}

Outline Outlines::collar() const {
  return [*this](const Vec3d& p) {
    const Vec3d d = p - neckBase_;
    // 1 at the throat, 0 at the nape.
    const double front = 0.5 + 0.5 * d.dot(neckForward_) / std::max(1e-6, std::hypot(d.x(), d.dot(neckForward_)));
    const Vec3d throat(marks_.midline, marks_.chin, marks_.notch.z());
    const double high = 0.06;
    const double low = std::clamp(aboveNeckBase(throat) - 0.025, 0.02, high);
    return both(high + front * (low - high) - aboveNeckBase(p), kCollarReach - outsideNeck(p), 0.01);
  };
}

Outline Outlines::shoulder(double sign) const {
  const Vec3d axis = (marks_.elbow - marks_.shoulder).normalized();
  const Vec3d outward = (Vec3d::UnitX() - axis.x() * axis).normalized();
  const double length = 0.42 * (marks_.elbow - marks_.shoulder).norm();
  return [*this, sign, axis, outward, length](const Vec3d& p) {
    const Vec3d q = folded(p);
    if (sign * (p.x() - marks_.midline) < 0.0) {
      return -0.1;
    }
    const Vec3d d = q - marks_.shoulder;
    const double along = d.dot(axis);
    const Vec3d across = d - along * axis;
    const double angle = std::atan2(across.cross(outward).norm(), across.dot(outward));
    const double around = 0.05 * (1.6 - angle);
    const double overVest = 0.012 - outsideArmhole(q, kFrontArmhole);
    const double besideCollar = outsideNeck(p) - kCollarReach - 0.01;
    return both(both(length - along, around), both(overVest, besideCollar, 0.01));
  };
}

Outline Outlines::groin() const {
  return [*this](const Vec3d& p) {
    const Vec3d q = folded(p);
    const double top = marks_.hem + 0.02;
    const double bottom = marks_.crotch + 0.012;
    const double share = std::clamp((q.y() - bottom) / (top - bottom), 0.0, 1.0);
    const double half = marks_.shoulder.x() * (0.36 + 0.34 * smoothStep(0.0, 1.0, share));
    const double front = q.z() - marks_.hemMiddle - 0.02;
    return both(both(half - q.x(), front), both(top - q.y(), q.y() - bottom));
  };
}

Outline Outlines::carrierFront(const armor::PlateSpec& plate, double top) const {
  return [*this, plate, top](const Vec3d& p) {
    const Vec3d q = folded(p);
    const double front = beforeCoronal(q);
    const double panel =
        both(0.5 * plate.width + 0.022 - q.x(), both(top + 0.012 - q.y(), q.y() - (top - plate.height - 0.022)));
    const double strap = both(0.026 - std::abs(q.x() - marks_.strap), q.y() - (top - 0.06));
    const double neck = outsideNeck(p) - 0.01;
    return both(either(panel, strap, 0.03), both(front, neck));
  };
}

Outline Outlines::carrierBack(const armor::PlateSpec& plate, double top) const {
  return [*this, plate, top](const Vec3d& p) {
    const Vec3d q = folded(p);
    const double back = kStrapOver * shoulderShare(q.y()) - beforeCoronal(q);
    const double panel =
        both(0.5 * plate.width + 0.022 - q.x(), both(top + 0.012 - q.y(), q.y() - (top - plate.height - 0.022)));
    const double strap = both(0.026 - std::abs(q.x() - marks_.strap), q.y() - (top - 0.06));
    const double neck = outsideNeck(p) - 0.01;
    return both(either(panel, strap, 0.03), both(back, neck));
  };
}

Outline Outlines::cummerbund(double sign, const armor::PlateSpec& plate, double top) const {
  // Beside the plate's bag; on a trunk that is hardly broader than its plate, under it.
  const double start = std::min(0.5 * plate.width + 0.006, marks_.waistHalf - kCummerbundLeast);
  return [*this, sign, plate, top, start](const Vec3d& p) {
    const Vec3d q = folded(p);
    if (sign * (p.x() - marks_.midline) < 0.0) {
      return -0.1;
    }
    const double low = std::max(top - plate.height + 0.01, marks_.hem);
    const double high = std::min(low + 0.15, marks_.armpit - kSideBelowArmpit);
    return both(q.x() - start, both(high - q.y(), q.y() - low));
  };
}

}  // namespace lorica::manikin
