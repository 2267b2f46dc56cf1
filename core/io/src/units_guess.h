#pragma once

#include "lorica/geometry/vectors.h"
#include "lorica/io/import.h"

namespace lorica::io {

/// The unit in which a box would be a person, or a piece of one: up to 4 is metres, up to 400 centimetres, above that
/// millimetres.
base::LengthUnit guessUnits(const geometry::Box3d& box);

/// z when the box is tall like a standing body along z (1.5 times the other sides), else y.
UpAxis guessUp(const geometry::Box3d& box);

}  // namespace lorica::io
