#include "lorica/base/units.h"

namespace lorica::base {

double metresPer(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return 1.0;
    case LengthUnit::centimetre:
      return 0.01;
    case LengthUnit::millimetre:
      return 0.001;
    case LengthUnit::inch:
      return 0.0254;
  }
  return 1.0;
}

std::string name(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return "m";
    case LengthUnit::centimetre:
      return "cm";
    case LengthUnit::millimetre:
      return "mm";
    case LengthUnit::inch:
      return "in";
  }
  return "m";
}

std::optional<LengthUnit> lengthUnitNamed(std::string_view wanted) {
  for (const LengthUnit unit : {LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::inch}) {
    if (name(unit) == wanted) {
      return unit;
    }
  }
  return std::nullopt;
}

}  // namespace lorica::base
