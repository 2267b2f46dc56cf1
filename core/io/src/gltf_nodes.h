#pragma once

/// \file
/// The node graph of a glTF file: a forest, checked to be one.

#include <optional>
#include <string>
#include <vector>

#include "lorica/human/skeleton.h"
#include "reading.h"

namespace tinygltf {
class Model;
}

namespace lorica::io {

struct NodeGraph {
  std::vector<std::optional<std::size_t>> parent;  ///< per node
  std::vector<std::size_t> depth;                  ///< per node; 0 for those without parent
  std::vector<human::Trs> local;                   ///< per node; matrices taken apart
  std::vector<geometry::Affine3d> localFrame;      ///< per node, as the file has it
  std::vector<geometry::Affine3d> frame;           ///< per node, in the scene
  std::vector<std::size_t> order;                  ///< every node once, parents before children
  std::vector<std::size_t> inScene;                ///< nodes of the scene that is read, in `order`
};

/// "node 3" or "node 3 'Hips'".
std::string nodeName(const tinygltf::Model& model, std::size_t node);

/// \throw base::InputError for children that do not exist, have two parents or go in circles, for bad transforms
NodeGraph readNodes(const tinygltf::Model& model, Reading& reading);

/// A matrix taken apart.
struct Decomposed {
  human::Trs trs;
  bool sheared = false;   ///< the matrix is more than translation, rotation and scale; trs is the nearest
  bool mirrored = false;  ///< the scale is negative along x
};

Decomposed decompose(const geometry::Affine3d& frame);

}  // namespace lorica::io
