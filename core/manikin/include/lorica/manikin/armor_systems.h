#pragma once

/// \file
/// Body armor made to the measure of a body: soft panels that follow its skin, hard plates and a helmet that ride on
/// it. Sizes, areal densities and masses come from resources/tables/armor.csv.

#include <optional>
#include <string>
#include <vector>

#include "lorica/armor/piece_rig.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/manikin/body.h"

namespace lorica::manikin {

/// One piece of armor, at rest, in the body's frame.
struct ArmorPiece {
  std::string name;
  geometry::TriangleMesh mesh;  ///< closed, manifold, outward, one piece, not through itself
  armor::Carriage carriage = armor::Carriage::rigid;
  std::optional<human::SkinWeights> weights;  ///< on the body's skeleton, for skinned pieces
  /// The middle of the plate that a rigid piece belongs to: a plate, its bag and its pouches move as one, see
  /// carrierOf().
  std::optional<geometry::Vec3d> carriedAt;
  std::string material;
  double arealDensity = 0.0;  ///< kg/m2
  double area = 0.0;          ///< m2, covered: of the middle of a shell, of a plate's outline seen from its front
  double mass = 0.0;          ///< kg: areal density times area
  bool protecting = true;     ///< false for fabric, straps and pouches
  std::string source;         ///< where the numbers come from and how far they are verified
};

struct ArmorSystem {
  std::string name;
  std::vector<ArmorPiece> pieces;
};

/// The systems for a body, in this order:
///  - full_torso: soft vest (vest_front, vest_back, side_left, side_right, collar, shoulder_left, shoulder_right,
///    groin) and plates (plate_front, plate_back, side_plate_left, side_plate_right);
///  - plate_carrier: plate_front, plate_back, and what carries them without protecting: carrier_front, carrier_back,
///    cummerbund_left, cummerbund_right, bag_front, bag_back, pouch_1 to pouch_3;
///  - helmet: helmet;
///  - full_torso_helmet, plate_carrier_helmet: both together.
/// Soft pieces lie 2 to 6 mm over the skin where it is convex and bridge its hollows; where one lies over another (side
/// panels, collar, groin and shoulder pieces over the vest, the back's shoulder straps over the front's) it rises over
/// it with a gap of a millimetre or more. No piece cuts the skin or another piece of its system.
/// \pre the body stands at rest and its skeleton has the joints of the joint table
/// Thread-safe; the same bytes at any number of threads. Cost: about 3 s on two cores.
/// \throw base::Cancelled
std::vector<ArmorSystem> armorOf(const Body& body, base::Threads threads, const base::Progress& progress = {});

/// What carries a rigid piece of a system: the skin under its plate, or, where it belongs to none (the helmet), the
/// nearest interior site. Points into `system`.
armor::RigidCarrier carrierOf(const ArmorSystem& system, const ArmorPiece& piece);

/// What is known of a piece before there is a body.
struct PieceFacts {
  std::string name;
  armor::Carriage carriage = armor::Carriage::rigid;
  std::string material;
  std::optional<double> arealDensity;  ///< kg/m2; none for the helmet, whose area is that of the shell made
  bool protecting = true;
};

struct SystemFacts {
  std::string name;
  std::vector<PieceFacts> pieces;
};

/// The systems and pieces that armorOf() makes for a body of the person, in the same order. No mesh is made.
std::vector<SystemFacts> armorFacts(const human::Person& person);

}  // namespace lorica::manikin
