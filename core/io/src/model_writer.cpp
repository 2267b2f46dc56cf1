#include "lorica/io/model_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "glb_document.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "reading.h"
#include "writers.h"

namespace lorica::io {

using geometry::Vec3f;
using human::Channel;
using human::ChannelPath;
using human::Interpolation;
using human::SkinWeights;

namespace {

using Row = std::array<float, 4>;

/// Four places of a vertex: a set of glTF.
template <class Number>
struct WeightSet {
  std::vector<std::array<Number, 4>> joints;
  std::vector<Row> weights;
};

/// The most joints that hold any vertex.
std::size_t usedInfluences(const SkinWeights& weights) {
  std::size_t used = 1;
  for (std::size_t i = 0; i < weights.weights.size(); ++i) {
    if (weights.weights[i] > 0.0F) {
      used = std::max(used, i % weights.influences + 1);
    }
  }
  return used;
}

template <class Number>
std::vector<WeightSet<Number>> weightSets(const SkinWeights& weights) {
  const std::size_t vertices = weights.vertices();
  std::vector<WeightSet<Number>> sets((usedInfluences(weights) + 3) / 4,
                                      {std::vector<std::array<Number, 4>>(vertices), std::vector<Row>(vertices)});
  for (std::size_t v = 0; v < vertices; ++v) {
    double others = 0.0;
    for (std::size_t k = 0; k < weights.influences; ++k) {
      const std::size_t i = v * weights.influences + k;
      if (weights.weights[i] > 0.0F) {  // a place without weight names joint 0, as glTF asks
        sets[k / 4].joints[v][k % 4] = static_cast<Number>(weights.joints[i]);
        sets[k / 4].weights[v][k % 4] = weights.weights[i];
        others += k > 0 ? static_cast<double>(weights.weights[i]) : 0.0;
      }
    }
    sets[0].weights[v][0] = static_cast<float>(1.0 - others);  // the strongest takes what rounding left over
  }
  return sets;
}

const char* word(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::step:
      return "STEP";
    case Interpolation::linear:
      return "LINEAR";
    case Interpolation::cubicSpline:
      return "CUBICSPLINE";
  }
  return "";
}

const char* word(ChannelPath path) {
  switch (path) {
    case ChannelPath::translation:
      return "translation";
    case ChannelPath::rotation:
      return "rotation";
    case ChannelPath::scale:
      return "scale";
  }
  return "";
}

class ModelWriter {
 public:
  std::string write(const RiggedModel& model) {
    for (const ModelMesh& mesh : model.meshes) {
      addNode(mesh, model.skeleton);
    }
    if (model.skeleton != nullptr) {
      addSkeleton(*model.skeleton);
      for (const human::Clip& clip : model.clips) {
        addClip(clip, model.skeleton->size());
      }
    }
    return document_.bytes();
  }

 private:
  void addNode(const ModelMesh& source, const human::Skeleton* skeleton) {
    const SceneMesh& mesh = source.mesh;
    Json node{{"name", oneLine(mesh.name)}};
    if (!mesh.triangles.empty()) {  // glTF has no empty accessors
      node["mesh"] = document_.meshes.size();
      Json attributes = surface(mesh);
      if (source.weights != nullptr) {
        LORICA_CHECK(skeleton != nullptr, "weights are on a skeleton");
        addWeights(*source.weights, mesh.positions.size(), skeleton->size(), attributes);
        node["skin"] = 0;
      }
      addMesh(mesh, std::move(attributes));
    }
    node["extras"] = {{"kind", mesh.kind}};
    if (!source.protects) {
      node["extras"]["protecting"] = false;
    }
    document_.roots.push_back(document_.nodes.size());
    document_.nodes.push_back(std::move(node));
  }

  Json surface(const SceneMesh& mesh) {
    std::vector<Vec3f> normals = geometry::vertexNormals(mesh.positions, mesh.triangles);
    for (Vec3f& normal : normals) {
      if (normal.isZero(0.0F)) {
        normal = Vec3f::UnitY();  // glTF wants unit length everywhere
      }
    }
    const std::size_t position = document_.add(mesh.positions, "VEC3", GlbUse::attribute);
    Vec3f low = mesh.positions.front();
    Vec3f high = low;
    for (const Vec3f& p : mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    document_.setRange(position, {low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()});
    return {{"POSITION", position},
            {"NORMAL", document_.add(std::span<const Vec3f>(normals), "VEC3", GlbUse::attribute)}};
  }

  void addMesh(const SceneMesh& mesh, Json attributes) {
    Json primitive{{"attributes", std::move(attributes)},
                   {"indices", document_.add(mesh.triangles, "SCALAR", GlbUse::indices)},
                   {"material", document_.materials.size()}};
    document_.meshes.push_back({{"name", oneLine(mesh.name)}, {"primitives", Json::array({std::move(primitive)})}});
    const auto& c = mesh.colour;
    Json material{{"name", oneLine(mesh.name)},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {c[0], c[1], c[2], c[3]}}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}},
                  {"doubleSided", true}};
    if (c[3] < 1.0F) {
      material["alphaMode"] = "BLEND";
    }
    document_.materials.push_back(std::move(material));
  }

  void addWeights(const SkinWeights& weights, std::size_t vertices, std::size_t joints, Json& attributes) {
    LORICA_CHECK(weights.vertices() == vertices, "weights for every vertex");
    LORICA_CHECK(joints <= 65536, "glTF counts joints in 16 bits");
    LORICA_CHECK(
        std::all_of(weights.joints.begin(), weights.joints.end(), [&](std::uint32_t joint) { return joint < joints; }),
        "weights name joints of the skeleton");
    if (joints <= 256) {
      addSets(weightSets<std::uint8_t>(weights), attributes);
    } else {
      addSets(weightSets<std::uint16_t>(weights), attributes);
    }
  }

  template <class Number>
  void addSets(const std::vector<WeightSet<Number>>& sets, Json& attributes) {
    for (std::size_t s = 0; s < sets.size(); ++s) {
      attributes[fmt::format("JOINTS_{}", s)] =
          document_.add(std::span<const std::array<Number, 4>>(sets[s].joints), "VEC4", GlbUse::attribute);
      attributes[fmt::format("WEIGHTS_{}", s)] =
          document_.add(std::span<const Row>(sets[s].weights), "VEC4", GlbUse::attribute);
    }
  }

  /// The joints as nodes behind the meshes, and the one skin that all skinned meshes share.
  void addSkeleton(const human::Skeleton& skeleton) {
    firstJoint_ = document_.nodes.size();
    std::vector<Json> children(skeleton.size(), Json::array());
    Json joints = Json::array();
    std::vector<Eigen::Matrix4f> inverseBinds;
    std::size_t roots = 0;
    for (std::size_t j = 0; j < skeleton.size(); ++j) {
      const human::JointIndex index{j};
      const human::Joint& joint = skeleton.joint(index);
      joints.push_back(firstJoint_ + j);
      inverseBinds.emplace_back(skeleton.restFrame(index).inverse().matrix().cast<float>());
      if (joint.parent) {
        children[joint.parent->value].push_back(firstJoint_ + j);
      } else {
        document_.roots.push_back(firstJoint_ + j);
        ++roots;
      }
    }
    LORICA_CHECK(roots == 1, "a skeleton of glTF has one root");
    for (std::size_t j = 0; j < skeleton.size(); ++j) {
      document_.nodes.push_back(jointNode(skeleton.joint(human::JointIndex{j}), std::move(children[j])));
    }
    const std::size_t binds = document_.add(std::span<const Eigen::Matrix4f>(inverseBinds), "MAT4", GlbUse::other);
    document_.skins.push_back({{"name", "skeleton"}, {"inverseBindMatrices", binds}, {"joints", std::move(joints)}});
  }

  static Json jointNode(const human::Joint& joint, Json children) {
    Json node{{"name", oneLine(joint.name)}};
    const human::Trs& rest = joint.rest;
    if (!rest.translation.isZero(0.0)) {
      node["translation"] = {rest.translation.x(), rest.translation.y(), rest.translation.z()};
    }
    if (rest.rotation.coeffs() != geometry::Quatd::Identity().coeffs()) {
      const geometry::Quatd& q = rest.rotation;
      node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    }
    if (rest.scale != geometry::Vec3d::Ones()) {
      node["scale"] = {rest.scale.x(), rest.scale.y(), rest.scale.z()};
    }
    if (!children.empty()) {
      node["children"] = std::move(children);
    }
    return node;
  }

  void addClip(const human::Clip& clip, std::size_t joints) {
    Json channels = Json::array();
    Json samplers = Json::array();
    std::map<std::vector<float>, std::size_t> knownTimes;  // channels of one clip mostly share their times
    for (const Channel& channel : clip.channels) {
      LORICA_CHECK(channel.joint.value < joints, "channels move joints of the skeleton");
      channels.push_back({{"sampler", samplers.size()},
                          {"target", {{"node", firstJoint_ + channel.joint.value}, {"path", word(channel.path)}}}});
      const std::size_t times = addTimes(channel, knownTimes);
      samplers.push_back(
          {{"input", times}, {"output", addValues(channel)}, {"interpolation", word(channel.interpolation)}});
    }
    if (!channels.empty()) {  // glTF has no empty animations
      document_.animations.push_back(
          {{"name", oneLine(clip.name)}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}});
    }
  }

  std::size_t addTimes(const Channel& channel, std::map<std::vector<float>, std::size_t>& known) {
    std::vector<float> times;
    for (const double time : channel.times) {
      times.push_back(static_cast<float>(time));
      LORICA_CHECK(times.size() < 2 || times.back() > times[times.size() - 2], "times rise in single precision too");
    }
    const auto found = known.find(times);
    if (found != known.end()) {
      return found->second;
    }
    const std::size_t accessor = document_.add(std::span<const float>(times), "SCALAR", GlbUse::other);
    document_.setRange(accessor, Json::array({times.front()}), Json::array({times.back()}));
    known.emplace(std::move(times), accessor);
    return accessor;
  }

  std::size_t addValues(const Channel& channel) {
    if (channel.path == ChannelPath::rotation) {
      std::vector<Eigen::Vector4f> values;
      for (const Eigen::Vector4d& value : channel.values) {
        values.emplace_back(value.cast<float>());
      }
      return document_.add(std::span<const Eigen::Vector4f>(values), "VEC4", GlbUse::other);
    }
    std::vector<Vec3f> values;
    for (const Eigen::Vector4d& value : channel.values) {
      values.emplace_back(value.head<3>().cast<float>());
    }
    return document_.add(std::span<const Vec3f>(values), "VEC3", GlbUse::other);
  }

  GlbDocument document_;
  std::size_t firstJoint_ = 0;
};

}  // namespace

std::string modelBytes(const RiggedModel& model) {
  return ModelWriter().write(model);
}

std::string glbBytes(std::span<const SceneMesh> scene) {
  RiggedModel model;
  for (const SceneMesh& mesh : scene) {
    model.meshes.push_back({mesh});
  }
  return modelBytes(model);
}

}  // namespace lorica::io
