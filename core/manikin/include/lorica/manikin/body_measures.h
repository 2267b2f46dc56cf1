#pragma once

/// \file
/// What a tape, calipers and a scale read on a body, beside what the survey has for its person.

#include <string>
#include <vector>

#include "lorica/manikin/body.h"

namespace lorica::manikin {

struct BodyMeasure {
  std::string name;       ///< "chest_girth", "hip_breadth", ...
  double value = 0.0;     ///< metres, on the skin's triangles
  double target = 0.0;    ///< metres, the survey's for the person
  std::string dimension;  ///< the survey's name for it
  std::string source;     ///< of the target, and how far it was verified
};

/// stature; girths of head, neck, chest, waist, hip, thigh, calf and upper_arm; breadth and depth of chest and hip.
/// A girth is that of the convex hull of a plane section, as a tape lies; sections of trunk, head and thigh are level,
/// those of neck and upper arm at a right angle to it. Of a section that falls into pieces the one around the place is
/// read, so that arms are left out of the trunk and one leg out of the other. Left limbs are read. Targets lie at the
/// survey's percentile (ANSUR II) that the person has in stature (stature, head) or in mass over stature (all others);
/// girths leave them a little for the sake of the mass: one person has not the same percentile everywhere.
/// Thread-safe. Cost: some tens of milliseconds.
/// \pre the body is at rest and its skeleton has the joints of the joint table
std::vector<BodyMeasure> measureBody(const Body& body);

/// Mass of what the skin encloses, kg: its volume without the air in the lungs (lungAir()) times meanDensity().
double measuredMass(const Body& body);

}  // namespace lorica::manikin
