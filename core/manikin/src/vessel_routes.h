#pragma once

/// \file
/// The courses of arteries and veins in a body: waypoints of resources/tables/vessels.csv, carried by the frame of the
/// trunk and by the limbs' own bones, then moved apart until nothing touches.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fields.h"
#include "lorica/geometry/closest_point.h"
#include "organ_frame.h"
#include "organ_lattice.h"

namespace lorica::manikin {

/// A tube that runs away from the heart.
struct Vessel {
  std::string name;  ///< with _L or _R where there are two
  bool artery = true;
  std::optional<std::size_t> parent;  ///< it leaves, an earlier one of the list
  std::size_t leaves = 0;             ///< station of the parent where it does
  std::vector<Station> stations;      ///< about 5 mm apart; the first lies in the parent
};

/// Waypoints joined by smooth curves. Parents stand before their branches.
std::vector<Vessel> vesselRoutes(const Body& body, const AnatomyFrame& frame);

/// What vessels keep clear of.
struct Surroundings {
  std::vector<const Lattice*> solids;        ///< distances, positive outside
  std::function<double(const Vec3d&)> bone;  ///< the same
  const geometry::ClosestPointTree* skin = nullptr;
  double gap = 0.0015;        ///< between walls, m
  double skinDepth = 0.0025;  ///< of the wall, m
};

/// Moves the stations until walls keep their distances, as far as that goes; courses stay smooth.
void settle(std::vector<Vessel>& vessels, const Surroundings& around);

struct VesselSurface {
  geometry::TriangleMesh mesh;              ///< one closed piece for each root, with its branches
  std::vector<std::vector<Station>> tubes;  ///< the courses as they were swept
};

/// The walls of all arteries, or of all veins.
VesselSurface vesselSurface(const std::vector<Vessel>& vessels, bool arteries);

}  // namespace lorica::manikin
