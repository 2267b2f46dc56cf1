#pragma once

/// \file
/// Threat data: what reaches places in space and time - pressure, scores, fragments (thesis chapter 5). A field is what
/// a file says and nothing more: values at points, at times. lorica/threat/field_sampler.h tells what holds between
/// them.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lorica/geometry/transform.h"
#include "lorica/geometry/vectors.h"

namespace lorica::threat {

/// What the values of a column or an array are.
struct Attribute {
  std::string name;
  std::string unit;            ///< as the file says it, such as "kPa"; empty when it does not
  std::size_t components = 1;  ///< 3 for vectors
  bool operator==(const Attribute&) const = default;
};

/// "pressure (kPa)", or the name alone.
std::string label(const Attribute& attribute);

/// Points at all crossings of planes across the three axes; the index runs along x first, then y, then z.
struct Lattice {
  std::array<std::vector<double>, 3> axes;  ///< metres, rising, at least one plane each

  std::size_t points() const { return axes[0].size() * axes[1].size() * axes[2].size(); }
  /// \pre index < points()
  geometry::Vec3d place(std::size_t index) const;
};

/// The field at one time.
struct Step {
  double time = 0.0;  ///< seconds
  /// Metres; none on a lattice. Steps with the same points share them.
  std::shared_ptr<const geometry::Positions> points;
  /// Of each point, who it is: points of one id over time are one fragment. None where the file has no ids.
  std::vector<std::int64_t> ids;
  /// Per attribute, per point, `components` numbers together. On a lattice not a number where there is no value.
  std::vector<std::vector<float>> values;
};

/// Immutable in use; const functions are thread-safe. Memory: 4 bytes a value, 12 a point of each distinct set of
/// points, 8 an id.
struct ThreatField {
  std::vector<Attribute> attributes;
  std::optional<Lattice> lattice;  ///< none: scattered points
  std::vector<Step> steps;         ///< at least one, times rising
  bool timed = false;              ///< whether the file has times; a field without holds at any time
  /// From the axes and points above to the scene's frame.
  geometry::RigidTransform placement;

  /// Of a step.
  std::size_t points(std::size_t step) const { return lattice ? lattice->points() : steps[step].points->size(); }
  /// Where a point is in the scene, metres.
  geometry::Vec3d place(std::size_t step, std::size_t point) const;
  /// Around all points at all times, in the scene.
  geometry::Box3d bounds() const;
  /// Index of the attribute with that name; none when there is none.
  std::optional<std::size_t> attributeNamed(const std::string& name) const;
};

/// Pascals in one of a unit of pressure ("kPa", "bar", "psi", ...); none for other units.
std::optional<double> pascalsPer(const std::string& unit);

}  // namespace lorica::threat
