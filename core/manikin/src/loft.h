#pragma once

/// \file
/// A part of the body as a loft: cross-sections along a straight axis, smooth between them.

#include <span>
#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::manikin {

using geometry::Vec3d;

/// A cross-section: a superellipse whose front and back halves meet on a line across the axis. Lengths in metres.
struct Section {
  double at = 0.0;           ///< along the axis
  double halfBreadth = 0.0;  ///< to either side
  double front = 0.0;        ///< foremost point, along the frame's `front`
  double back = 0.0;         ///< hindmost point (smaller than `front`)
  double widest = 0.5;       ///< where between back (0) and front (1) the breadth is taken
  double squareness = 2.2;   ///< exponent: 2 is an ellipse, more is squarer
  double aside = 0.0;        ///< of the middle, along the frame's `side`
};

/// Right-angled unit vectors and where the axis begins.
struct LoftFrame {
  Vec3d origin = Vec3d::Zero();
  Vec3d axis = Vec3d::UnitY();
  Vec3d side = Vec3d::UnitX();
  Vec3d front = Vec3d::UnitZ();
};

/// Values between the sections are monotone cubics (Fritsch and Carlson 1980), so nothing bulges that no section asks
/// for; `softness` (metres) rounds the corners of the profile off. The ends are domes.
class Loft {
 public:
  /// \pre two sections at least, `at` strictly rising; dome heights positive
  Loft(const LoftFrame& frame, std::span<const Section> sections, double startDome, double endDome,
       double softness = 0.0);

  /// Negative inside, near the surface about the distance to it, metres.
  double field(const Vec3d& p) const;
  Section sectionAt(double at) const;

 private:
  LoftFrame frame_;
  std::vector<Section> samples_;  ///< evenly spaced
  double begin_ = 0.0;
  double end_ = 0.0;
  double perMetre_ = 0.0;  ///< samples
  double startDome_ = 0.0;
  double endDome_ = 0.0;
};

}  // namespace lorica::manikin
