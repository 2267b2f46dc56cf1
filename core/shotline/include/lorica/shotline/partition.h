#pragma once

/// \file
/// What one shot goes through: an interval for each passage through a structure, and the shot cut into pieces that say
/// who owns them. Lengths are metres along the shot from its origin.

#include <cstdint>
#include <span>
#include <vector>

#include "lorica/raycast/caster.h"

namespace lorica::shotline {

/// One way through one mesh: where it winds around the shot, so that overlapping parts are one passage, a hollow is
/// none, and what a deformation turned inside out is one too. An open mesh has a passage of no length, a
/// crossing, for each hit.
struct Passage {
  std::uint32_t mesh = 0;
  bool closed = true;         ///< false: a crossing of an open part, exit == enter
  bool startsInside = false;  ///< the shot's origin lies in it; enter is 0
  double enter = 0.0;
  double exit = 0.0;
  double obliquityIn = 0.0;   ///< radians between the shot and the surface's normal, 0 to pi/2; 0 when it starts inside
  double obliquityOut = 0.0;  ///< likewise

  double thickness() const { return exit - enter; }
  /// Line-of-sight thickness times the cosine of the obliquity at entry: that of a plate with parallel faces.
  double normalThickness() const;
};

/// Passages in the order in which they begin, then by mesh.
/// \param hits all of the ray at the scene, in complete order
std::vector<Passage> passagesOf(const raycast::Ray& ray, std::span<const raycast::Hit> hits,
                                const raycast::Scene& scene);

/// Who owns what several structures claim.
enum class OverlapPolicy {
  allClaim,   ///< each of them
  outermost,  ///< the one the shot entered first
  priority    ///< the one that stands first in a list, then the one entered first
};

/// A piece of a shot.
struct Segment {
  double from = 0.0;
  double to = 0.0;
  std::vector<std::size_t> owners;  ///< indices of passages, rising; none in a gap
};

/// Cuts a shot where passages begin and end, from the first beginning to the last end. Crossings own nothing.
/// \param ranks of the passages, the lower first; for `priority`
/// \pre ranks has one entry per passage, or none with another policy
std::vector<Segment> partition(std::span<const Passage> passages, OverlapPolicy policy,
                               std::span<const std::size_t> ranks = {});

}  // namespace lorica::shotline
