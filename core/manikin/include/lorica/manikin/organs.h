#pragma once

/// \file
/// The organs and vessels of the built-in human: how large they are in a person, and their meshes in a body.
/// Sizes: ICRP publication 89 (resources/tables/organs.csv). Places: the levels of the textbooks on the body's own
/// spine, inside its own sections.

#include <string>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/manikin/body.h"

namespace lorica::manikin {

enum class OrganScaling {
  /// ICRP 89 reference volumes times: lean body mass over the reference adult's (Boer 1984) for heart, liver, stomach,
  /// kidneys, spleen, pancreas, intestines and thyroid; stature to the power 2.763 (men) or 2.605 (women) for the lungs
  /// (functional residual capacity, Global Lung Function Initiative 2021); stature for the spinal cord; brain, eyes and
  /// bladder stay.
  referenceMass,
  /// ICRP 89 reference volumes times the cube of a length: heart diameter over the reference adult's for the heart,
  /// lung width over the reference adult's for all others (thesis, section 2.3). Brain, eyes, spinal cord and bladder
  /// stay.
  thesis,
};

/// The unit in which the thesis' lung formula reads the heart's diameter and gives the lungs' width.
enum class LungFormulaUnit { inches, centimetres };

struct OrganOptions {
  OrganScaling scaling = OrganScaling::referenceMass;
  LungFormulaUnit lungFormula = LungFormulaUnit::inches;  ///< used by OrganScaling::thesis only
  base::Threads threads;
};

/// Transverse diameter of the heart's shadow, m: 8.6566 (W/H)^0.4895 with pounds and inches gives centimetres (thesis,
/// section 2.3, which prints inches); within -1.2 to +2.4 % of the Ungerleider and Clark rule for men. 8 mm less for
/// women, as their rule has it.
double heartTransverseDiameter(const human::Person& person);

/// Width across both lungs, m: 1.9381 (heart diameter)^1.083 in the unit wanted, at most `innerChestBreadth` metres.
double lungWidth(const human::Person& person, LungFormulaUnit unit, double innerChestBreadth);

/// Lean body mass, kg (Boer 1984).
double leanBodyMass(const human::Person& person);

/// What a structure should hold in a person.
struct OrganTarget {
  std::string name;
  double volume = 0.0;   ///< m3; 0 where none is published
  double density = 0.0;  ///< kg/m3; 0 where none is published
  std::string source;    ///< of mass and density, and how far they were verified
  double mass() const { return volume * density; }
};

/// One for each of organNames(). \param innerChestBreadth m, limits the lungs' width in OrganScaling::thesis
std::vector<OrganTarget> organTargets(const human::Person& person, const OrganOptions& options,
                                      double innerChestBreadth);

/// heart, lung_left, lung_right, liver, stomach, kidney_left, kidney_right, spleen, pancreas, small_intestine,
/// large_intestine, trachea, bladder, brain, spinal_cord, thyroid, eyes, arteries, veins.
const std::vector<std::string>& organNames();

struct Organ {
  std::string name;
  geometry::TriangleMesh mesh;  ///< closed, manifold, outward, inside the skin
  double targetVolume = 0.0;    ///< m3; 0 where none is published
  double density = 0.0;         ///< kg/m3; 0 where none is published
  std::string source;           ///< of mass and density, and how far they were verified
};

/// The organs of a body in the order of organNames(), each within 1 % of its target volume, or smaller where a very
/// slim trunk has no room for it; no two of them overlap, liver and heart lie at least 15 mm deep.
/// The same bytes at any number of threads. Cost: a few seconds.
/// \pre the skeleton has the joints of the joint table
/// \throw base::Cancelled
std::vector<Organ> organsOf(const Body& body, const OrganOptions& options = {}, const base::Progress& progress = {});

/// Breadth of the heart over the inner breadth of the chest; up to 0.5 on a radiograph of a healthy adult (Danzer
/// 1919). \pre the organs are of the body
double cardiothoracicRatio(const Body& body, const std::vector<Organ>& organs);

}  // namespace lorica::manikin
