#pragma once

/// \file
/// The skeleton of a glTF file: all joints of the skins in use with every node above them, at rest in the bind pose.

#include <optional>
#include <vector>

#include "gltf_nodes.h"
#include "raw_model.h"

namespace lorica::io {

struct Rig {
  /// How a skin's vertices get to their rest place, and its list of joints as indices into `joints`.
  struct Skin {
    geometry::Affine3d toScene = geometry::Affine3d::Identity();
    std::vector<std::uint32_t> joints;
  };
  std::vector<human::Joint> joints;
  std::vector<std::optional<human::JointIndex>> jointOf;  ///< per node of the file
  std::vector<Skin> skins;                                ///< per skin of the file; empty when it is not in use
  std::vector<geometry::Affine3d> restFrame;              ///< per node of the file: bound joints and what hangs on them
  std::vector<bool> carried;                              ///< per node of the file: it or a node above it is a joint
};

/// The rest pose of a skin is its bind pose, moved as a whole to where its top-most joint is in the file.
/// \param used per skin of the file
/// \throw base::InputError for joints and matrices that cannot be
Rig readRig(const tinygltf::Model& model, const NodeGraph& graph, const std::vector<bool>& used, Reading& reading);

}  // namespace lorica::io
