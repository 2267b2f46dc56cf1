#pragma once

/// \file
/// The body of the built-in human: skin, skeleton and skin weights of an adult of any size, made from published
/// numbers. Organs, armor and motions are made for it.

#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/person.h"
#include "lorica/human/skeleton.h"
#include "lorica/human/skinning.h"

namespace lorica::manikin {

/// Metres, y up, facing +z, x to the person's left, soles at y = 0, arms in the A-pose.
struct Body {
  human::Person person;
  geometry::TriangleMesh skin;  ///< closed, manifold, outward, one piece
  human::SkinWeights weights;   ///< at most four joints per vertex
  human::Skeleton skeleton;     ///< rest frames are translations only; names as in the joint table, sided ones _L, _R
};

/// Sizes a body can be made for: the middle 99.8 % of adults and some more.
struct PersonLimits {
  double leastStature = 1.40;  ///< m
  double greatestStature = 2.10;
  double greatestBmi = 45.0;  ///< kg/m2

  /// 17 kg/m2, and more for the tall: lungs grow faster with stature than the trunk of a slim person.
  double leastBmi(human::Sex sex, double stature) const;
};

/// Throws InputError with one sentence when no body can be made for the person.
void checkPerson(const human::Person& person, const PersonLimits& limits = {});

/// The person whose stature and mass are at a percentile of their own sex (ANSUR II), normal between the 5th, 50th
/// and 95th. \pre 0 < percentile < 100
human::Person personAtPercentile(human::Sex sex, double percentile);

/// Breadths, depths and girths are those the survey has for the person's stature and build; the whole has the person's
/// volume: mass over the mean density of ICRP publication 89, plus the air in the lungs.
/// Skin of 35,000 to 50,000 triangles. The same bytes at any number of threads.
/// Throws InputError as checkPerson(), Cancelled. Thread-safe. Cost: about 4 s on two threads.
Body makeBody(const human::Person& person, base::Threads threads, const base::Progress& progress = {});

/// Mean density of an adult without the air in the lungs, kg/m3 (ICRP publication 89).
double meanDensity(human::Sex sex);

/// Air in the lungs of a person, m3: that of the ICRP 89 reference adult, with the cube of stature.
double lungAir(const human::Person& person);

/// Volume the skin of a person encloses, m3: mass over mean density, plus the air in the lungs.
double bodyVolume(const human::Person& person);

}  // namespace lorica::manikin
