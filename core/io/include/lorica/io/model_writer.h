#pragma once

/// \file
/// Whole rigged models out, as glTF 2.0 (.glb): skins with their weights, the skeleton, and its clips as animations.
/// importModel() of the file gives them back.

#include <span>
#include <string>
#include <vector>

#include "lorica/human/clip.h"
#include "lorica/human/skinning.h"
#include "lorica/io/export.h"

namespace lorica::io {

/// One mesh of a model; a node of its own at the scene's root.
struct ModelMesh {
  SceneMesh mesh;                               ///< at rest
  const human::SkinWeights* weights = nullptr;  ///< on the model's skeleton; null for a mesh that no joint carries
  bool protects = true;                         ///< false for armor that only carries; the node's extras say so
};

struct RiggedModel {
  std::vector<ModelMesh> meshes;
  const human::Skeleton* skeleton = nullptr;  ///< may be null when no mesh has weights
  std::span<const human::Clip> clips;         ///< on the skeleton
};

/// The file's bytes. Skins have JOINTS_n and WEIGHTS_n, as many sets of four as the strongest held vertex needs; the
/// weights of a vertex sum to 1 in single precision. Joints are nodes with their names and rest transforms in double
/// precision, inverse bind matrices in single. Every clip is an animation with the channels it has; its keys are in
/// single precision. Names are made one line. The same model gives the same bytes.
/// \pre corners are below positions.size(); weights are as many as positions and name joints of the skeleton; the
///      skeleton has one root, as glTF asks; the times of a channel differ in single precision too
std::string modelBytes(const RiggedModel& model);

}  // namespace lorica::io
