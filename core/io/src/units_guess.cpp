#include "units_guess.h"

#include <algorithm>

namespace lorica::io {

base::LengthUnit guessUnits(const geometry::Box3d& box) {
  const double largest = box.sizes().maxCoeff();
  if (largest < 4.0) {
    return base::LengthUnit::metre;
  }
  return largest <= 400.0 ? base::LengthUnit::centimetre : base::LengthUnit::millimetre;
}

UpAxis guessUp(const geometry::Box3d& box) {
  const geometry::Vec3d size = box.sizes();
  return size.z() >= 1.5 * std::max(size.x(), size.y()) && size.z() > 0.0 ? UpAxis::z : UpAxis::y;
}

}  // namespace lorica::io
