#include "lorica/threat/threat_field.h"

#include <algorithm>
#include <utility>

namespace lorica::threat {

using geometry::Box3d;
using geometry::Vec3d;

std::string label(const Attribute& attribute) {
  return attribute.unit.empty() ? attribute.name : attribute.name + " (" + attribute.unit + ")";
}

Vec3d Lattice::place(std::size_t index) const {
  const std::size_t x = axes[0].size();
  const std::size_t y = axes[1].size();
  return {axes[0][index % x], axes[1][index / x % y], axes[2][index / x / y]};
}

Vec3d ThreatField::place(std::size_t step, std::size_t point) const {
  const Vec3d own = lattice ? lattice->place(point) : (*steps[step].points)[point].cast<double>();
  return placement.isIdentity() ? own : placement * own;
}

Box3d ThreatField::bounds() const {
  Box3d box;
  if (lattice) {
    const auto& axes = lattice->axes;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const auto end = [&](std::size_t axis) {
        return (corner >> axis & 1U) != 0 ? axes.at(axis).back() : axes.at(axis).front();
      };
      box.extend(placement * Vec3d(end(0), end(1), end(2)));
    }
    return box;
  }
  const geometry::Positions* seen = nullptr;
  for (const Step& step : steps) {
    if (step.points.get() != seen) {
      for (const geometry::Vec3f& point : *step.points) {
        box.extend(placement * point.cast<double>());
      }
    }
    seen = step.points.get();
  }
  return box;
}

std::optional<std::size_t> ThreatField::attributeNamed(const std::string& name) const {
  const auto found =
      std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& known) { return known.name == name; });
  return found == attributes.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - attributes.begin()));
}

std::optional<double> pascalsPer(const std::string& unit) {
  static constexpr auto units = std::to_array<std::pair<const char*, double>>({{"Pa", 1.0},
                                                                               {"hPa", 100.0},
                                                                               {"mbar", 100.0},
                                                                               {"kPa", 1e3},
                                                                               {"bar", 1e5},
                                                                               {"MPa", 1e6},
                                                                               {"GPa", 1e9},
                                                                               {"atm", 101325.0},
                                                                               {"psi", 6894.757293168361}});
  for (const auto& [name, pascals] : units) {
    if (unit == name) {
      return pascals;
    }
  }
  return std::nullopt;
}

}  // namespace lorica::threat
