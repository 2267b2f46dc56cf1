#include "gltf_skin.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "gltf_accessor.h"

namespace lorica::io {

using geometry::Affine3d;
using human::JointIndex;

namespace {

constexpr double agreement = 1e-6;     // metres, or of the frame's size: what single precision can tell
constexpr double disagreement = 1e-4;  // from here on two bind poses of one joint are really two

/// Largest difference of two frames: of the axes against their length, of the origin against its distance.
double difference(const Affine3d& a, const Affine3d& b) {
  const double size = std::max(a.linear().cwiseAbs().maxCoeff(), 1e-30);
  const double distance = std::max(1.0, a.translation().cwiseAbs().maxCoeff());
  return std::max((a.linear() - b.linear()).cwiseAbs().maxCoeff() / size,
                  (a.translation() - b.translation()).cwiseAbs().maxCoeff() / distance);
}

struct Bind {
  std::size_t skin = 0;
  std::vector<std::size_t> joints;  // nodes
  std::vector<Affine3d> inverse;    // one per joint
  std::size_t root = 0;             // place of the top-most joint in `joints`
  std::size_t depth = 0;            // of the top-most joint below the scene
};

Affine3d inverseBind(const double* values, const std::string& place, const Reading& reading) {
  const Eigen::Matrix4d matrix(values);
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-4) {
    reading.fail(place, "is no transform: its last row must be 0 0 0 1");
  }
  Affine3d frame;
  frame.matrix() = matrix;
  frame.makeAffine();
  const double size = frame.linear().cwiseAbs().maxCoeff();
  if (!(std::abs(frame.linear().determinant()) > 1e-9 * size * size * size) || !frame.inverse().matrix().allFinite()) {
    reading.fail(place, "cannot be inverted");
  }
  return frame;
}

Bind readBind(const tinygltf::Model& model, const NodeGraph& graph, std::size_t skin, const Reading& reading) {
  const tinygltf::Skin& source = model.skins[skin];
  const std::string place = fmt::format("skin {}", skin);
  Bind bind;
  bind.skin = skin;
  for (const int joint : source.joints) {
    if (joint < 0 || static_cast<std::size_t>(joint) >= model.nodes.size()) {
      reading.fail(place, fmt::format("has node {} as a joint, but the file has {} nodes", joint, model.nodes.size()));
    }
    bind.joints.push_back(static_cast<std::size_t>(joint));
  }
  if (bind.joints.empty()) {
    reading.fail(place, "has no joints");
  }
  bind.inverse.assign(bind.joints.size(), Affine3d::Identity());
  if (source.inverseBindMatrices >= 0) {
    const Elements matrices =
        AccessorReader(model, reading)
            .numbers(source.inverseBindMatrices, Shape::mat4, {}, place + ", inverseBindMatrices");
    if (matrices.count < bind.joints.size()) {
      reading.fail(place,
                   fmt::format("has {} inverse bind matrices for {} joints", matrices.count, bind.joints.size()));
    }
    for (std::size_t j = 0; j < bind.joints.size(); ++j) {
      bind.inverse[j] =
          inverseBind(matrices.values.data() + 16 * j, fmt::format("{}, inverse bind matrix {}", place, j), reading);
    }
  }
  const auto root = std::min_element(bind.joints.begin(), bind.joints.end(),
                                     [&](std::size_t a, std::size_t b) { return graph.depth[a] < graph.depth[b]; });
  bind.root = static_cast<std::size_t>(root - bind.joints.begin());
  bind.depth = graph.depth[*root];
  return bind;
}

class RigBuilder {
 public:
  RigBuilder(const tinygltf::Model& model, const NodeGraph& graph, Reading& reading)
      : model_(model), graph_(graph), reading_(reading), bound_(model.nodes.size()) {
    rig_.jointOf.resize(model.nodes.size());
    rig_.skins.resize(model.skins.size());
  }

  Rig build(const std::vector<bool>& used) {
    std::vector<Bind> binds;
    for (std::size_t skin = 0; skin < model_.skins.size(); ++skin) {
      if (used[skin]) {
        binds.push_back(readBind(model_, graph_, skin, reading_));
      }
    }
    // A skin of a part of the body follows the rest of the whole body, so the higher roots come first.
    std::stable_sort(binds.begin(), binds.end(), [](const Bind& a, const Bind& b) { return a.depth < b.depth; });
    for (const Bind& bind : binds) {
      place(bind);
    }
    restFrames();
    makeJoints(binds);
    for (const Bind& bind : binds) {
      for (const std::size_t node : bind.joints) {
        rig_.skins[bind.skin].joints.push_back(rig_.jointOf[node]->value);
      }
    }
    return std::move(rig_);
  }

 private:
  /// Frame of a node with the skins placed so far.
  Affine3d currentFrame(std::size_t node) const {
    Affine3d below = Affine3d::Identity();
    while (!bound_[node]) {
      below = graph_.localFrame[node] * below;
      if (!graph_.parent[node]) {
        return below;
      }
      node = *graph_.parent[node];
    }
    return *bound_[node] * below;
  }

  void place(const Bind& bind) {
    Affine3d& toScene = rig_.skins[bind.skin].toScene;
    toScene = currentFrame(bind.joints[bind.root]) * bind.inverse[bind.root];
    if (difference(Affine3d::Identity(), toScene) < agreement) {
      toScene = Affine3d::Identity();  // rounding of the file's matrices must not move the vertices
    }
    std::size_t differing = 0;
    for (std::size_t j = 0; j < bind.joints.size(); ++j) {
      const Affine3d frame = toScene * bind.inverse[j].inverse();
      auto& bound = bound_[bind.joints[j]];
      if (!bound) {
        bound = frame;
      } else if (difference(*bound, frame) > disagreement) {
        ++differing;
      }
    }
    if (differing > 0) {
      reading_.warn(
          fmt::format("skin {}", bind.skin),
          fmt::format("binds {} joints elsewhere than an earlier skin; its parts may be posed wrongly", differing));
    }
  }

  void restFrames() {
    rig_.restFrame.assign(model_.nodes.size(), Affine3d::Identity());
    rig_.carried.assign(model_.nodes.size(), false);
    for (const std::size_t node : graph_.order) {
      const auto& parent = graph_.parent[node];
      rig_.restFrame[node] = bound_[node] ? *bound_[node]
                             : parent     ? rig_.restFrame[*parent] * graph_.localFrame[node]
                                          : graph_.localFrame[node];
      rig_.carried[node] = bound_[node] || (parent && rig_.carried[*parent]);
    }
  }

  void makeJoints(const std::vector<Bind>& binds) {
    std::vector<bool> needed(model_.nodes.size(), false);
    for (const Bind& bind : binds) {
      for (std::optional<std::size_t> node : bind.joints) {
        for (; node && !needed[*node]; node = graph_.parent[*node]) {
          needed[*node] = true;
        }
      }
    }
    std::vector<Affine3d> made;  // frames that the joints' own transforms add up to
    for (const std::size_t node : graph_.order) {
      if (!needed[node]) {
        continue;
      }
      rig_.jointOf[node] = JointIndex{rig_.joints.size()};
      const auto parent = graph_.parent[node] ? rig_.jointOf[*graph_.parent[node]] : std::nullopt;
      const Affine3d above = parent ? made[parent->value] : Affine3d::Identity();
      rig_.joints.push_back({model_.nodes[node].name, parent, localRest(node, above)});
      made.push_back(above * rig_.joints.back().rest.matrix());
      if (!made.back().matrix().allFinite() || std::abs(made.back().linear().determinant()) < 1e-30) {
        reading_.fail(nodeName(model_, node), "its scale is zero or beyond all measure, so no skin can follow it");
      }
    }
  }

  /// The node's own transform where the bind pose agrees with it, bit for bit; else what the bind pose asks for.
  human::Trs localRest(std::size_t node, const Affine3d& above) {
    if (!bound_[node]) {
      return graph_.local[node];
    }
    const auto& parent = graph_.parent[node];
    const Affine3d parentFrame = parent ? rig_.restFrame[*parent] : Affine3d::Identity();
    if (difference(*bound_[node], parentFrame * graph_.local[node].matrix()) < agreement) {
      return graph_.local[node];
    }
    const Affine3d local = above.inverse() * *bound_[node];
    if (!local.matrix().allFinite()) {
      reading_.fail(nodeName(model_, node), "its bind pose cannot be expressed below its parent");
    }
    const Decomposed parts = decompose(local);
    if (parts.sheared || parts.mirrored) {
      reading_.warn(nodeName(model_, node), fmt::format("its bind pose {}; a joint cannot do that exactly",
                                                        parts.sheared ? "shears" : "mirrors"));
    }
    return parts.trs;
  }

  const tinygltf::Model& model_;
  const NodeGraph& graph_;
  Reading& reading_;
  std::vector<std::optional<Affine3d>> bound_;  // per node: frame in the bind pose, placed in the scene
  Rig rig_;
};

}  // namespace

Rig readRig(const tinygltf::Model& model, const NodeGraph& graph, const std::vector<bool>& used, Reading& reading) {
  return RigBuilder(model, graph, reading).build(used);
}

}  // namespace lorica::io
