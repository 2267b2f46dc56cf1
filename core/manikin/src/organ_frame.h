#pragma once

/// \file
/// Where an anatomical place lies in a given body. Organs and vessels are designed once, in a canonical man of 1.755 m
/// whose joints are those of the joint table; this frame carries them into any body and back. Heights follow the joints
/// of the spine, depths are counted from the discs, breadths and depths follow the body's own sections, arms left out.

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "lorica/manikin/body.h"

namespace lorica::manikin {

using geometry::Vec3d;

/// A monotone cubic through knots (Fritsch and Carlson 1980), straight beyond them.
class Curve {
 public:
  Curve() = default;
  /// \pre as many values as knots, two at least; knots rise
  Curve(std::vector<double> knots, std::vector<double> values);
  double operator()(double x) const;

 private:
  std::vector<double> knots_;
  std::vector<double> values_;
  std::vector<double> slopes_;
};

/// The frame at one height.
struct Level {
  double canonicalHeight = 0.0;
  double spine = 0.0;           ///< z of the discs
  double canonicalSpine = 0.0;  ///< and in the canonical man
  double breadth = 1.0;         ///< body over canonical, along x
  double front = 1.0;           ///< along z before the spine
  double back = 1.0;            ///< and behind it

  Vec3d toCanonical(double x, double z) const;
};

/// Half breadth and the midline's foremost and hindmost z of the skin at a height, arms left out.
struct SkinSection {
  double halfBreadth = 0.0;
  double back = 0.0;
  double front = 0.0;
};

class AnatomyFrame {
 public:
  /// \pre the skeleton has the spine's, hips' and head's joints of the joint table
  explicit AnatomyFrame(const Body& body);

  /// Body over canonical man, by stature.
  double scale() const { return scale_; }
  Level level(double height) const;
  Vec3d toCanonical(const Vec3d& place) const;
  Vec3d toBody(const Vec3d& canonical) const;
  /// Half the breadth of the chest's skin, m.
  double chestHalfBreadth() const { return chestHalfBreadth_; }

 private:
  double scale_ = 1.0;
  double chestHalfBreadth_ = 0.0;
  Curve height_;          ///< of the body to canonical
  Curve spine_;           ///< z over the body's height
  Curve canonicalSpine_;  ///< z over canonical height
  Curve breadth_;         ///< ratios over the body's height
  Curve front_;
  Curve back_;
};

/// Stature of the canonical man, m.
constexpr double kCanonicalStature = 1.755;

/// \pre the joint exists
Vec3d jointPlace(const human::Skeleton& skeleton, std::string_view name);

/// Section of the skin without triangles that an arm's joint moves most.
SkinSection skinSection(const Body& body, double height);

}  // namespace lorica::manikin
