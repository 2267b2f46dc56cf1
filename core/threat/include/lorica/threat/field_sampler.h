#pragma once

/// \file
/// The value of a threat field at any place and time.
///
/// On a lattice: trilinear between the eight points around, so that what is linear in x, y and z is met exactly (up to
/// the floats the values are kept in). Between scattered points: the k nearest within a radius, weighted after Franke
/// and Nielson (1980, "Smooth interpolation of large sets of scattered data") with (1/d - 1/R)^2, R the lesser of the
/// radius and the distance of the next nearest point. So a constant is met exactly, a point's own value at the point,
/// no value leaves the range of the values around it, and the result changes continuously where points come and go.
/// What is linear is not met exactly: the error stays below the difference of the values within R.
/// Linear in time between steps. Outside the lattice (by more than 1e-6 of its size), where one of the points around
/// has no value, farther than the radius from every point, and before the first and after the last time there is no
/// value.

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "lorica/base/parallel.h"
#include "lorica/threat/threat_field.h"

namespace lorica::threat {

struct SamplerOptions {
  std::size_t neighbours = 8;    ///< of scattered points, 1 to 15
  std::optional<double> radius;  ///< metres; default: three times typicalSpacing()
};

/// Mean distance of up to 1000 points, spread evenly over the list of the first step, to their nearest neighbour at
/// another place; of a lattice the smallest distance of its planes. Metres; 0 when there is one place only.
double typicalSpacing(const ThreatField& field);

/// Points and weights, sum 1, that give the value at a place; none where there is no value.
struct Stencil {
  std::array<std::uint32_t, 16> point{};
  std::array<double, 16> weight{};
  std::uint32_t count = 0;
};

class PointTree;

/// Keeps a search tree (VTK's vtkStaticPointLocator) for each distinct set of points. Const functions are thread-safe;
/// results depend on nothing but field, options, place and time.
/// Cost: building 0.1 us a point, a query 0.1 us on a lattice, about 10 us between 10 million points.
class FieldSampler {
 public:
  /// \pre the field has a step, and neighbours is 1 to 15
  explicit FieldSampler(std::shared_ptr<const ThreatField> field, const SamplerOptions& options = {});

  const ThreatField& field() const { return *field_; }
  double radius() const { return radius_; }  ///< metres; 0 on a lattice

  /// The value, or the length of the vector. \pre attribute is one of the field's
  std::optional<double> value(const geometry::Vec3d& place, double time, std::size_t attribute) const;
  /// The vector, in the scene. \pre the attribute has three components
  std::optional<geometry::Vec3d> vector(const geometry::Vec3d& place, double time, std::size_t attribute) const;
  /// Values at many places; not a number where there is none. Runs in parallel.
  std::vector<float> values(std::span<const geometry::Vec3f> places, double time, std::size_t attribute,
                            base::Threads threads = {}) const;

  /// What value() is made of, for those who ask for one place at many times. \pre step < field().steps.size()
  Stencil stencil(const geometry::Vec3d& place, std::size_t step) const;
  /// \pre the stencil is of this step or of one with the same points
  std::optional<double> value(const Stencil& stencil, std::size_t step, std::size_t attribute) const;
  /// Whether stencils of one step serve the other.
  bool samePoints(std::size_t a, std::size_t b) const;

 private:
  /// The steps around a time and the share of the second; none outside.
  struct Moment {
    std::size_t before = 0;
    std::size_t after = 0;
    double share = 0.0;
  };
  std::optional<Moment> momentAt(double time) const;
  Stencil latticeStencil(const geometry::Vec3d& place) const;
  Stencil pointStencil(const geometry::Vec3d& place, const PointTree& tree) const;
  std::optional<geometry::Vec3d> blend(const Stencil& stencil, std::size_t step, std::size_t attribute) const;
  std::optional<geometry::Vec3d> blendAt(const geometry::Vec3d& place, double time, std::size_t attribute) const;

  std::shared_ptr<const ThreatField> field_;
  std::size_t neighbours_;
  double radius_ = 0.0;
  geometry::RigidTransform toField_;
  std::vector<std::shared_ptr<const PointTree>> trees_;  ///< per step; none on a lattice
};

}  // namespace lorica::threat
