#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>

#include "formats.h"
#include "gltf_animation.h"
#include "gltf_file.h"
#include "gltf_mesh.h"
#include "gltf_nodes.h"
#include "gltf_skin.h"

namespace lorica::io {

using geometry::Affine3d;
using geometry::Triangle;
using geometry::Vec3d;

namespace {

void moveToScene(RawPart& part, const Affine3d& frame) {
  if (frame.matrix() == Eigen::Matrix4d::Identity()) {
    return;
  }
  for (Vec3d& position : part.positions) {
    position = frame * position;
  }
  if (frame.linear().determinant() < 0.0) {
    for (Triangle& triangle : part.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

/// A node's extras may say "protecting": false, as modelBytes() writes it.
bool protects(const tinygltf::Node& node) {
  if (!node.extras.IsObject()) {
    return true;
  }
  const tinygltf::Value& said = node.extras.Get("protecting");
  return !said.IsBool() || said.Get<bool>();
}

class GltfImporter {
 public:
  GltfImporter(const tinygltf::Model& model, Reading& reading)
      : model_(model), reading_(reading), graph_(readNodes(model, reading)) {}

  RawModel read() {
    const std::vector<bool> used = skinsInUse();
    isRigged_ = std::find(used.begin(), used.end(), true) != used.end();
    rig_ = readRig(model_, graph_, used, reading_);
    RawModel raw;
    for (const std::size_t node : graph_.inScene) {
      if (model_.nodes[node].mesh >= 0) {
        raw.parts.push_back(part(node));
      }
    }
    if (isRigged_) {
      raw.clips = readClips(model_, rig_, reading_);
      raw.joints = std::move(rig_.joints);
    } else if (!model_.animations.empty()) {
      reading_.note("animations", "are not used: no mesh of the file has a skin");
    }
    noteUnused();
    return raw;
  }

 private:
  std::vector<bool> skinsInUse() const {
    std::vector<bool> used(model_.skins.size(), false);
    for (const std::size_t node : graph_.inScene) {
      const tinygltf::Node& source = model_.nodes[node];
      if (source.mesh < 0) {
        continue;
      }
      if (static_cast<std::size_t>(source.mesh) >= model_.meshes.size()) {
        reading_.fail(nodeName(model_, node),
                      fmt::format("refers to mesh {}, but the file has {}", source.mesh, model_.meshes.size()));
      }
      if (source.skin < 0) {
        continue;
      }
      if (static_cast<std::size_t>(source.skin) >= model_.skins.size()) {
        reading_.fail(nodeName(model_, node),
                      fmt::format("refers to skin {}, but the file has {}", source.skin, model_.skins.size()));
      }
      used[static_cast<std::size_t>(source.skin)] = true;
    }
    return used;
  }

  RawPart part(std::size_t node) {
    const tinygltf::Node& source = model_.nodes[node];
    const auto mesh = static_cast<std::size_t>(source.mesh);
    MeshExtras extras;
    RawPart result;
    if (source.skin >= 0) {
      const Rig::Skin& skin = rig_.skins[static_cast<std::size_t>(source.skin)];
      result = readMesh(model_, mesh, skin.joints.size(), reading_, extras);
      for (human::Influence& influence : result.weights) {
        influence.joint = skin.joints[influence.joint];
      }
      moveToScene(result, skin.toScene);
    } else {
      result = readMesh(model_, mesh, 0, reading_, extras);
      placeUnskinned(result, node);
    }
    result.name = oneLine(source.name).empty() ? model_.meshes[mesh].name : source.name;
    result.protects = protects(source);
    noteExtras(extras, node);
    return result;
  }

  /// Below a joint a part without weights is carried by that joint alone.
  void placeUnskinned(RawPart& part, std::size_t node) {
    const bool carried = rig_.carried[node];
    const Affine3d& atRest = rig_.restFrame[node];
    const bool moved = carried && !atRest.isApprox(graph_.frame[node], 1e-6);
    moveToScene(part, moved ? atRest : graph_.frame[node]);
    if (!carried) {
      return;
    }
    std::size_t joint = node;
    while (!rig_.jointOf[joint]) {
      joint = *graph_.parent[joint];
    }
    part.influences = 1;
    part.weights.assign(part.positions.size(), {rig_.jointOf[joint]->value, 1.0});
    reading_.warn(nodeName(model_, node),
                  fmt::format("has no skin; it is carried rigidly by {}", nodeName(model_, joint)));
  }

  void noteExtras(const MeshExtras& extras, std::size_t node) {
    const std::string place = nodeName(model_, node);
    if (extras.morphTargets) {
      reading_.note(place, "its morph targets are not used");
    }
    if (extras.pointsOrLines > 0) {
      reading_.note(place, fmt::format("{} primitives of points or lines are not used", extras.pointsOrLines));
    }
    if (extras.weightSets > 1) {
      reading_.note(place, fmt::format("its {} sets of weights were joined and normalised as one", extras.weightSets));
    }
  }

  void noteUnused() {
    if (!model_.images.empty() || !model_.textures.empty()) {
      reading_.note("textures", "are not used");
    }
    if (!model_.cameras.empty()) {
      reading_.note("cameras", "are not used");
    }
    if (!model_.lights.empty()) {
      reading_.note("lights", "are not used");
    }
  }

  const tinygltf::Model& model_;
  Reading& reading_;
  NodeGraph graph_;
  Rig rig_;
  bool isRigged_ = false;
};

}  // namespace

RawModel readGltf(std::string_view bytes, Reading& reading) {
  const tinygltf::Model model = parseGltf(bytes, reading);
  return GltfImporter(model, reading).read();
}

}  // namespace lorica::io
