#pragma once

#include "body_field.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/human/skinning.h"

namespace lorica::manikin {

/// How much each joint moves each vertex of the skin: at most four, neighbours along one limb, none of another limb.
human::SkinWeights bodyWeights(const geometry::TriangleMesh& skin, const Anthropometry& sizes, const BodyJoints& joints,
                               const BodyField& field, base::Threads threads);

}  // namespace lorica::manikin
