#pragma once

/// \file
/// Where shots come from, ready to use. Every kind but Eq 15 draws its shots evenly over something that has a size - a
/// solid angle, or an area across the shots - so that every shot weighs the same, and a share of the shots is a share
/// of that size.
///
/// Azimuth and elevation say where a shot comes from, seen from the body: azimuth 0 is ahead of the person (+z), 90 on
/// the person's left (+x), 180 behind; elevation 90 is above (+y).

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lorica/geometry/vectors.h"
#include "lorica/raycast/caster.h"

namespace lorica::shotline {

/// How the shots of a point are spread.
enum class Sampler {
  cone,       ///< evenly in the solid angle of a cone around the body
  rectangle,  ///< evenly in the solid angle of a rectangle around the target, across the line to it
  disk,       ///< the same of a disk
  thesis  ///< Eq 15: (target - position) times a random vector in [-10, 10]^3, component by component. For comparison:
          ///< half of its shots go backwards and its hit rate depends on the world's axes; it has no weights
};

/// Where the numbers behind the shots come from.
enum class Sequence {
  random,  ///< independent
  sobol,   ///< scrambled Sobol points: evener, independent only from trial to trial
  grid     ///< of a parallel beam: a square grid, shifted at random in each trial
};

struct PointSource {
  geometry::Vec3d position = geometry::Vec3d::Zero();  ///< metres
  geometry::Vec3d target = geometry::Vec3d::Zero();    ///< what the axis runs through
  Sampler sampler = Sampler::cone;
  double halfAngle = 0.0;  ///< of cone and disk, radians, 0 to pi
  double width = 0.0;      ///< of the rectangle, metres, level
  double height = 0.0;     ///< of the rectangle, metres, across its width
};

/// Parallel shots from far away over a disk, or as a grid over the square around it, that faces them.
struct ParallelBeam {
  double azimuth = 0.0;    ///< radians
  double elevation = 0.0;  ///< radians
  geometry::Vec3d centre = geometry::Vec3d::Zero();
  double radius = 1.0;         ///< of the disk, metres
  std::uint64_t gridSide = 1;  ///< cells along each side of the square, for Sequence::grid
};

struct AngleRange {
  double from = 0.0;  ///< radians
  double to = 0.0;    ///< radians, above `from`
  bool operator==(const AngleRange&) const = default;
};

/// Shots from far away and from every direction of a band, evenly in its solid angle and over the disk that faces each
/// direction.
struct DirectionBand {
  AngleRange azimuth;    ///< at most a full turn
  AngleRange elevation;  ///< within a quarter turn down and up
  geometry::Vec3d centre = geometry::Vec3d::Zero();
  double radius = 1.0;  ///< of the disk, metres
};

/// Shots given one by one.
struct ShotList {
  std::shared_ptr<const std::vector<raycast::Ray>> rays;
};

struct Source {
  std::string name;
  std::variant<PointSource, ParallelBeam, DirectionBand, ShotList> shape;
  Sequence sequence = Sequence::random;
};

/// What a share of all shots is a share of.
enum class Basis {
  solidAngle,  ///< steradians
  area,        ///< square metres across the shots, of a band as a mean over its directions
  shots        ///< nothing but shots
};

struct Measure {
  Basis basis = Basis::shots;
  double total = 0.0;  ///< of all shots together: sr or m2; 0 for shots alone
};

/// What all shots of a source together make.
Measure measureOf(const Source& source);

/// Whether the shots are drawn anew in every trial; those of a list are the same.
bool isDrawn(const Source& source);
/// Whether the shots of one trial are independent of each other, as Wilson's interval asks.
bool independentShots(const Source& source);

/// Unit vector towards where shots come from.
geometry::Vec3d towards(double azimuth, double elevation);

/// Half-angle at `position` of the cone around the axis to `target` that holds all points of the posed skins; pi, all
/// directions, when it would reach 90 degrees (the source is at the body or in it).
/// \pre position != target, and there are points
double boundingHalfAngle(const geometry::Vec3d& position, const geometry::Vec3d& target,
                         std::span<const std::span<const geometry::Vec3f>> posedSkins);

/// Radius around a point of the ball that holds all points of the posed skins.
double boundingRadius(const geometry::Vec3d& centre, std::span<const std::span<const geometry::Vec3f>> posedSkins);
/// Radius of the disk around the line through a point along `axis` that holds them. \pre axis has length 1
double boundingRadius(const geometry::Vec3d& centre, const geometry::Vec3d& axis,
                      std::span<const std::span<const geometry::Vec3f>> posedSkins);

/// Solid angle of a cone, steradians.
double solidAngle(double halfAngle);
/// Solid angle of a rectangle seen from `distance` before its middle, steradians.
double solidAngle(double width, double height, double distance);

/// Reads shots: a line of names, x,y,z,dx,dy,dz or x,y,z,az,el (metres; degrees, where the shot comes from), then a
/// line for each shot. A shot begins at x,y,z. \param name what errors call the text, as a file's path \throw
/// base::InputError with the line of the first that cannot be used
ShotList readShotList(std::string_view csv, const std::string& name);
/// Whether a text begins as readShotList() wants it.
bool isShotList(std::string_view csv);

}  // namespace lorica::shotline
