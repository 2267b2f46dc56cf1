#pragma once

/// \file
/// Generated plates: the published medium plate, and where it lies on the chest or back of a standing body.

#include <optional>
#include <string>

#include "lorica/base/issue.h"
#include "lorica/geometry/transform.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/skeleton.h"

namespace lorica::armor {

/// A plate bent about a vertical axis and, where it is a multi-curve plate, about a horizontal one too, its upper
/// corners cut off. Metres and kilograms.
struct PlateSpec {
  double width = 0.0;   ///< chord, side to side
  double height = 0.0;  ///< chord, bottom to top
  double thickness = 0.0;
  double topWidth = 0.0;           ///< chord of the top edge, between the cut corners; at most `width`
  double cornerHeight = 0.0;       ///< how far down the cut corners reach; below `height`
  double curvatureRadius = 0.0;    ///< of the front face, in the horizontal plane
  double verticalCurvature = 0.0;  ///< of the front face's middle line, 1/m; 0 when it is straight
  double mass = 0.0;
  std::string source;  ///< where the numbers come from and how far they are verified
};

/// The medium SAPI plate, as resources/tables/plates.csv documents it.
PlateSpec mediumSapi();

/// Area of the outline seen from the front, the cut corners left out, m2.
double frontalArea(const PlateSpec& spec);

/// Closed outward mesh of about 2,000 even triangles in the plate's own frame: centre of its box at the origin, y up,
/// the convex front face towards +z.
/// \pre the lengths are positive, 2 * thickness < curvatureRadius, width < curvatureRadius, the vertical curvature is
///      not negative and less than 1 / height
geometry::TriangleMesh plate(const PlateSpec& spec);

/// A cover over a plate's front face and edges, open behind, as a plate's bag shows it: a closed outward shell in the
/// plate's frame, `gap` metres off the plate and `thickness` metres thick.
/// \pre as plate(), and gap and thickness are positive
geometry::TriangleMesh plateCover(const PlateSpec& spec, double gap, double thickness);

/// A box on the plate's front face, bent with it: from `left` to `right` across the plate and from `low` to `high`
/// above its lower edge (metres, across counted along the face from the middle), from `bottom` to `top` metres off the
/// face.
/// \pre as plate(); left < right, low < high, bottom < top
geometry::TriangleMesh boxOnPlate(const PlateSpec& spec, double left, double right, double low, double high,
                                  double bottom, double top);

enum class PlateSide {
  front,
  back,
  left,  ///< +x
  right
};

struct PlacedPlate {
  geometry::TriangleMesh mesh;     ///< in the body's frame
  geometry::RigidTransform place;  ///< from the plate's frame to the body's
  base::Issues issues;             ///< guessed landmarks (notes), bodies the rules do not fit (warnings)
};

struct PlatePlacement {
  double clearance = 0.008;   ///< least distance to the skin, for what is worn under the plate
  double belowNotch = 0.020;  ///< of the plate's top edge below the suprasternal notch
  std::optional<double> top;  ///< y of the plate's top edge, where the notch does not rule it
};

/// Lays a plate on the chest, the back or the side of a standing body: y up, facing +z, at rest. Beside a body its arms
/// are in the way: hand in a skin without them. The top edge lies below the suprasternal notch, whose height comes from
/// a collar-bone or neck joint where one with a known name is plausible (0.78 to 0.86 of stature), else from the mean
/// share of stature in ANSUR II. Sideways it is centred on the trunk's sections. It keeps `clearance` everywhere and is
/// pitched so that the mean gap behind it is smallest. Its corners stand off far: a trunk is bent more than a plate.
/// Every skin gets a plate; one the rules do not fit gets a warning with it.
/// \param skeleton of the body, or null
/// \pre the skin has triangles; what `plate` asks of the spec
/// Thread-safe. Cost: a few passes over the skin, about 0.1 s.
PlacedPlate placePlate(const geometry::TriangleMesh& skin, const human::Skeleton* skeleton, PlateSide side,
                       const PlateSpec& spec, const PlatePlacement& placement = {});

}  // namespace lorica::armor
