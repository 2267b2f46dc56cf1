#pragma once

/// \file
/// Surfaces through a field: slices by a plane, and surfaces of one value. Both carry values at their vertices.

#include <optional>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/geometry/smoothing.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/threat/field_sampler.h"

namespace lorica::threat {

struct ColouredSurface {
  geometry::TriangleMesh mesh;  ///< in the scene, metres
  std::vector<float> values;    ///< per vertex; not a number where there is none
};

/// Through `point`, across `normal`.
struct Plane {
  geometry::Vec3d point = geometry::Vec3d::Zero();
  geometry::Vec3d normal = geometry::Vec3d::UnitY();  ///< not of length 0
};

/// The field on a plane, at the crossings of a square grid of `spacing` metres; squares with a corner without a value
/// are left out. The values are those of FieldSampler::value().
/// \throw base::InputError when the grid would have more than 2^24 points; base::Cancelled
/// \pre spacing > 0
ColouredSurface slice(const FieldSampler& sampler, std::size_t attribute, double time, const Plane& plane,
                      double spacing, base::Threads threads = {}, const base::Progress& progress = {});

/// One attribute at one time on a lattice of cubes, in the scene: how scattered points become a volume.
/// \return a field of one attribute and one step without a time; lattice points without a value are not a number
/// \throw base::InputError when the lattice would have more than 2^27 points; base::Cancelled
/// \pre spacing > 0
ThreatField onLattice(const FieldSampler& sampler, std::size_t attribute, double time, double spacing,
                      base::Threads threads = {}, const base::Progress& progress = {});

struct LevelOptions {
  std::optional<double> spacing;      ///< of the cubes, metres; default: typicalSpacing()
  geometry::TaubinOptions smoothing;  ///< no rounds: as marching cubes leave it
  std::optional<std::size_t> colour;  ///< another attribute for the values; default: that of the surface
};

/// The surface where an attribute has the value `level`, greater values inside: topologically consistent marching
/// cubes (geometry::isosurface), smoothed after Taubin. It is closed: where greater values reach the end of the data,
/// it runs along there, within a tenth of a cube.
/// \throw as onLattice()
/// \pre level is finite
ColouredSurface levelSurface(const FieldSampler& sampler, std::size_t attribute, double time, double level,
                             const LevelOptions& options = {}, base::Threads threads = {},
                             const base::Progress& progress = {});

}  // namespace lorica::threat
