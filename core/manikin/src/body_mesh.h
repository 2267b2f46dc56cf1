#pragma once

#include "body_field.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/geometry/triangle_mesh.h"

namespace lorica::manikin {

/// The skin as even triangles, finer at face, hands and feet and where the body bends. Closed, manifold, one piece.
/// Cost: about 4 s on two threads. \throw base::Cancelled
geometry::TriangleMesh skinMesh(const Anthropometry& sizes, const BodyJoints& joints, const BodyField& field,
                                base::Threads threads, const base::Progress& progress);

/// Moves a point onto the surface where a field is zero, along the field's gradient.
Vec3d ontoSurface(const std::function<double(const Vec3d&)>& field, const Vec3d& p);

}  // namespace lorica::manikin
