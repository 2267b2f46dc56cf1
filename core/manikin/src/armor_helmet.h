#pragma once

/// \file
/// The helmet: a shell at an even distance around the head, cut like an ACH.

#include "armor_landmarks.h"
#include "lorica/base/parallel.h"

namespace lorica::manikin {

struct Helmet {
  geometry::TriangleMesh mesh;
  double middleArea = 0.0;  ///< m2, half way between the faces
};

/// Convex girth of the head above the brows, m.
double headCircumference(const Body& body, const BodyShares& shares);

/// \param standoff of the shell from the head, m: where its pads sit; over the ears it comes closer
Helmet helmetOn(const Body& body, const BodyShares& shares, double standoff, double thickness, base::Threads threads);

}  // namespace lorica::manikin
