#pragma once

/// \file
/// The rigid bodies of the thesis' Test Cases 1 and 2 (section 2.4), put into a body.

#include "lorica/geometry/triangle_mesh.h"
#include "lorica/manikin/body.h"

namespace lorica::manikin {

/// A cube of 40 mm under the skin of the back, beside the left shoulder blade.
geometry::TriangleMesh shoulderCube(const Body& body);

/// A box of 80 x 24 x 24 mm along the left forearm, nearer to the wrist than to the elbow.
geometry::TriangleMesh forearmBox(const Body& body);

}  // namespace lorica::manikin
