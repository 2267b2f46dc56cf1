#pragma once

/// \file
/// The rigid bodies of the thesis' Test Cases 1 and 2 (section 2.4), put into a body.

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/manikin/body.h"

namespace lorica::manikin {

/// A cube of 40 mm under the skin of the back, beside the left shoulder blade.
geometry::TriangleMesh shoulderCube(const Body& body);

/// A flat box of 60 x 50 x 10 mm in the middle of the left forearm, nearly as wide as the forearm is there.
geometry::TriangleMesh forearmBox(const Body& body);

}  // namespace lorica::manikin
