#pragma once

/// \file
/// The outlines of soft pieces on a body: functions about as steep as the distance from the outline, positive inside.

#include <functional>

#include "armor_landmarks.h"
#include "lorica/armor/plates.h"

namespace lorica::manikin {

using Outline = std::function<double(const Vec3d&)>;

/// Outlines share the body's landmarks and stay valid while it does.
class Outlines {
 public:
  explicit Outlines(const ArmorLandmarks& marks);

  Outline vestFront() const;
  Outline vestBack() const;
  Outline side(double sign) const;
  Outline collar() const;
  Outline shoulder(double sign) const;
  Outline groin() const;

  /// Fabric behind a plate whose top edge lies at `top`, with straps to the shoulders.
  Outline carrierFront(const armor::PlateSpec& plate, double top) const;
  Outline carrierBack(const armor::PlateSpec& plate, double top) const;
  Outline cummerbund(double sign, const armor::PlateSpec& plate, double top) const;

 private:
  /// x, y, z with x counted from the midline, not negative.
  Vec3d folded(const Vec3d& p) const { return {std::abs(p.x() - marks_.midline), p.y(), p.z()}; }
  double beforeCoronal(const Vec3d& q) const { return q.z() - marks_.coronal(q.y()); }
  double shoulderShare(double y) const;
  double outsideNeck(const Vec3d& p) const;
  double aboveNeckBase(const Vec3d& p) const;
  double outsideArmhole(const Vec3d& q) const;

  ArmorLandmarks marks_;
  Vec3d neckBase_;
  Vec3d neckForward_;  ///< unit, from the nape to the notch
  Vec3d neckUp_;
  double neckDepth_;  ///< half
};

}  // namespace lorica::manikin
