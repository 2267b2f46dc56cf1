#pragma once

#include <string>

#include "gltf_accessor.h"
#include "raw_model.h"

namespace tinygltf {
class Model;
}

namespace lorica::io {

/// What a mesh holds beside triangles, for the notes.
struct MeshExtras {
  bool morphTargets = false;
  std::size_t pointsOrLines = 0;  ///< primitives left out
  std::size_t weightSets = 0;     ///< most JOINTS_n/WEIGHTS_n pairs of a primitive
};

/// The primitives of a mesh as one part, in the mesh's own frame. Joints are indices into the skin's list and below
/// `skinJoints`; with 0 of them weights are not read.
/// \throw base::InputError naming mesh, primitive and accessor
RawPart readMesh(const tinygltf::Model& model, std::size_t mesh, std::size_t skinJoints, const Reading& reading,
                 MeshExtras& extras);

}  // namespace lorica::io
