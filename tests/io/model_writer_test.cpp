#include "lorica/io/model_writer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "import_bytes.h"
#include "lorica/geometry/primitives.h"

namespace lorica::test {
namespace {

using geometry::Quatd;
using geometry::TriangleMesh;
using geometry::Vec3d;
using human::Channel;
using human::ChannelPath;
using human::Interpolation;
using human::JointIndex;
using io::RiggedModel;

/// A skin on joints, with clips. Not to be copied: the model points into it.
struct Rig {
  TriangleMesh skin;
  human::SkinWeights weights;
  human::Skeleton skeleton;
  std::vector<human::Clip> clips;

  RiggedModel model() const {
    return {{{{"skin", "body", skin.positions, skin.triangles, {0.9F, 0.7F, 0.6F, 1.0F}}, &weights}}, &skeleton, clips};
  }
};

/// A post of two joints, the upper one 0.5 m above the lower; vertices above the middle are shared.
Rig post() {
  Rig rig;
  rig.skin = geometry::ellipsoid({0.0, 0.5, 0.0}, {0.2, 0.5, 0.2}, 2);
  rig.skeleton = human::Skeleton({{"hip", {}, {}}, {"knee", JointIndex{0}, {Vec3d(0.0, 0.5, 0.0)}}});
  rig.weights.influences = 2;
  for (const geometry::Vec3f& p : rig.skin.positions) {
    const bool shared = p.y() > 0.5F;
    rig.weights.joints.insert(rig.weights.joints.end(), {shared ? 1U : 0U, 0U});
    rig.weights.weights.insert(rig.weights.weights.end(), {shared ? 0.7F : 1.0F, shared ? 0.3F : 0.0F});
  }
  rig.clips = {{"bend",
                {{JointIndex{1},
                  ChannelPath::rotation,
                  Interpolation::linear,
                  {0.0, 0.5, 2.0},
                  {{0.0, 0.0, 0.0, 1.0}, {0.6, 0.0, 0.0, 0.8}, {0.0, 0.0, 0.0, 1.0}}}}}};
  return rig;
}

struct Parsed {
  nlohmann::json json;
  std::string binary;

  template <class T>
  std::vector<T> numbers(std::size_t accessor) const {
    const auto& facts = json["accessors"][accessor];
    const auto& view = json["bufferViews"][facts["bufferView"].get<std::size_t>()];
    std::vector<T> values(view["byteLength"].get<std::size_t>() / sizeof(T));
    std::memcpy(values.data(), binary.data() + view["byteOffset"].get<std::size_t>(), values.size() * sizeof(T));
    return values;
  }
};

Parsed parse(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return {nlohmann::json::parse(bytes.substr(20, length)), bytes.substr(28 + length)};
}

/// Joint names and weights of a vertex.
std::map<std::string, double> heldBy(const human::SkinWeights& weights, const human::Skeleton& skeleton,
                                     std::size_t vertex) {
  std::map<std::string, double> held;
  for (std::size_t k = 0; k < weights.influences; ++k) {
    const std::size_t i = vertex * weights.influences + k;
    if (weights.weights[i] > 0.0F) {
      held[skeleton.joints()[weights.joints[i]].name] += static_cast<double>(weights.weights[i]);
    }
  }
  return held;
}

/// The importer may put joints into another order; by their names they must be the same.
void expectSameRig(const io::Model& found, const Rig& rig) {
  ASSERT_EQ(found.parts.size(), 1U);
  EXPECT_EQ(flat(found.parts[0].mesh.positions), flat(rig.skin.positions));
  EXPECT_EQ(found.parts[0].mesh.triangles, rig.skin.triangles);
  ASSERT_TRUE(found.skeleton);
  ASSERT_EQ(found.skeleton->size(), rig.skeleton.size());
  for (const human::Joint& joint : rig.skeleton.joints()) {
    const auto index = found.skeleton->find(joint.name);
    ASSERT_TRUE(index) << joint.name;
    const human::Joint& same = found.skeleton->joint(*index);
    ASSERT_EQ(same.parent.has_value(), joint.parent.has_value());
    if (joint.parent) {
      EXPECT_EQ(found.skeleton->joint(*same.parent).name, rig.skeleton.joint(*joint.parent).name);
    }
    EXPECT_LT((same.rest.matrix().matrix() - joint.rest.matrix().matrix()).cwiseAbs().maxCoeff(), 1e-5) << joint.name;
  }
  ASSERT_TRUE(found.parts[0].weights);
  for (std::size_t v = 0; v < rig.skin.positions.size(); ++v) {
    const auto expected = heldBy(rig.weights, rig.skeleton, v);
    const auto held = heldBy(*found.parts[0].weights, *found.skeleton, v);
    ASSERT_EQ(held.size(), expected.size());
    for (const auto& [joint, weight] : expected) {
      ASSERT_NEAR(held.at(joint), weight, 1e-6);
    }
  }
}

void expectSameClips(const io::Model& found, const Rig& rig) {
  ASSERT_EQ(found.clips.size(), rig.clips.size());
  for (std::size_t c = 0; c < rig.clips.size(); ++c) {
    EXPECT_EQ(found.clips[c].name, rig.clips[c].name);
    ASSERT_EQ(found.clips[c].channels.size(), rig.clips[c].channels.size());
    for (std::size_t i = 0; i < rig.clips[c].channels.size(); ++i) {
      const Channel& expected = rig.clips[c].channels[i];
      const Channel& same = found.clips[c].channels[i];
      EXPECT_EQ(found.skeleton->joint(same.joint).name, rig.skeleton.joint(expected.joint).name);
      EXPECT_EQ(same.path, expected.path);
      EXPECT_EQ(same.interpolation, expected.interpolation);
      ASSERT_EQ(same.times.size(), expected.times.size());
      ASSERT_EQ(same.values.size(), expected.values.size());
      for (std::size_t k = 0; k < expected.times.size(); ++k) {
        EXPECT_NEAR(same.times[k], expected.times[k], 1e-6);
      }
      for (std::size_t k = 0; k < expected.values.size(); ++k) {
        EXPECT_LT((same.values[k] - expected.values[k]).cwiseAbs().maxCoeff(), 1e-6);
      }
    }
  }
}

TEST(ModelWriter, AnOrdinaryRigComesBackWithItsBitsAndWithoutAnIssue) {
  const Rig rig = post();
  const io::Model model = importBytes(io::modelBytes(rig.model()), "post.glb");
  expectSameRig(model, rig);
  expectSameClips(model, rig);
  EXPECT_TRUE(model.issues.empty()) << model.issues.front().line();
  EXPECT_EQ(model.parts[0].name, "skin");
  EXPECT_EQ(model.skeleton->joints()[1].rest, rig.skeleton.joints()[1].rest) << "translations keep their bits";
}

TEST(ModelWriter, WritesWhatGltfAsksFor) {
  const Rig rig = post();
  const std::string bytes = io::modelBytes(rig.model());
  EXPECT_EQ(bytes.size() % 4, 0U);
  const Parsed file = parse(bytes);
  const auto& primitive = file.json["meshes"][0]["primitives"][0];
  const auto& attributes = primitive["attributes"];
  EXPECT_FALSE(attributes.contains("JOINTS_1")) << "two influences fit into one set";
  std::set<std::size_t> ofVertices;
  for (const auto& [name, index] : attributes.items()) {
    const auto& accessor = file.json["accessors"][index.get<std::size_t>()];
    EXPECT_EQ(accessor["count"], rig.skin.positions.size()) << name;
    ofVertices.insert(accessor["bufferView"].get<std::size_t>());
  }
  const auto indices = file.json["accessors"][primitive["indices"].get<std::size_t>()];
  std::size_t end = 0;
  for (std::size_t v = 0; v < file.json["bufferViews"].size(); ++v) {
    const auto& view = file.json["bufferViews"][v];
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>(), end);
    end += view["byteLength"].get<std::size_t>();
    if (ofVertices.contains(v)) {
      EXPECT_EQ(view["target"], 34962);
    } else if (v == indices["bufferView"].get<std::size_t>()) {
      EXPECT_EQ(view["target"], 34963);
    } else {
      EXPECT_FALSE(view.contains("target"));
    }
  }
  EXPECT_EQ(end, file.binary.size());
  const auto& times = file.json["accessors"][file.json["animations"][0]["samplers"][0]["input"].get<std::size_t>()];
  EXPECT_EQ(times["min"], nlohmann::json({0.0}));
  EXPECT_EQ(times["max"], nlohmann::json({2.0}));
  EXPECT_EQ(file.json["skins"][0]["joints"], nlohmann::json({1, 2}));
  EXPECT_EQ(file.json["scenes"][0]["nodes"], nlohmann::json({0, 1}));
  EXPECT_EQ(file.json["nodes"][1]["children"], nlohmann::json({2}));
  const auto inverse = file.numbers<float>(file.json["skins"][0]["inverseBindMatrices"].get<std::size_t>());
  ASSERT_EQ(inverse.size(), 32U);
  EXPECT_EQ(inverse[16 + 13], -0.5F) << "the knee stands half a metre high";
}

TEST(ModelWriter, ChannelsWithTheSameTimesShareThem) {
  Rig rig = post();
  rig.clips[0].channels.push_back(rig.clips[0].channels[0]);
  rig.clips[0].channels[1].joint = JointIndex{0};
  const Parsed file = parse(io::modelBytes(rig.model()));
  const auto& samplers = file.json["animations"][0]["samplers"];
  EXPECT_EQ(samplers[0]["input"], samplers[1]["input"]);
  EXPECT_NE(samplers[0]["output"], samplers[1]["output"]);
}

TEST(ModelWriter, SkinnedAndPlainMeshesStandBesideEachOther) {
  const Rig rig = post();
  const TriangleMesh plate = geometry::box({-0.1, 0.4, 0.3}, {0.1, 0.6, 0.32});
  RiggedModel model = rig.model();
  model.meshes.push_back({{"plate", "armor", plate.positions, plate.triangles}});
  model.meshes.push_back({{"pouch", "armor", plate.positions, plate.triangles}, nullptr, false});
  const io::Model found = importBytes(io::modelBytes(model), "dressed.glb");
  ASSERT_EQ(found.parts.size(), 3U);
  EXPECT_TRUE(found.parts[0].weights);
  EXPECT_FALSE(found.parts[1].weights);
  EXPECT_TRUE(found.parts[1].protects);
  EXPECT_FALSE(found.parts[2].protects);
  EXPECT_TRUE(found.issues.empty());
}

TEST(ModelWriter, RefusesWhatCannotBeWritten) {
  const auto writes = [](const Rig& rig) { return io::modelBytes(rig.model()); };
  Rig strayJoint = post();
  strayJoint.weights.joints[0] = 2;
  EXPECT_THROW(writes(strayJoint), base::CallerError);
  Rig twoRoots = post();
  twoRoots.skeleton = human::Skeleton({{"a", {}, {}}, {"b", {}, {}}});
  EXPECT_THROW(writes(twoRoots), base::CallerError);
  Rig sameTimes = post();
  sameTimes.clips[0].channels[0].times = {0.0, 1.0, 1.0 + 1e-12};
  EXPECT_THROW(writes(sameTimes), base::CallerError);
  Rig fewWeights = post();
  fewWeights.weights.joints.resize(2);
  fewWeights.weights.weights.resize(2);
  EXPECT_THROW(writes(fewWeights), base::CallerError);
}

double drawn(double low, double high) {
  return *rc::gen::inRange(static_cast<int>(low * 1000), static_cast<int>(high * 1000) + 1) / 1000.0;
}

Vec3d drawnPoint(double reach) {
  const double x = drawn(-reach, reach);
  const double y = drawn(-reach, reach);
  return {x, y, drawn(-reach, reach)};
}

Quatd drawnTurn() {
  const Vec3d axis = drawnPoint(1.0);
  return axis.norm() < 0.1 ? Quatd::Identity()
                           : Quatd(Eigen::AngleAxisd(drawn(-std::numbers::pi, std::numbers::pi), axis.normalized()));
}

human::Skeleton drawnSkeleton(std::size_t joints) {
  std::vector<human::Joint> all;
  for (std::size_t j = 0; j < joints; ++j) {
    human::Joint joint;
    joint.name = "joint " + std::to_string(j);
    if (j > 0) {
      joint.parent = JointIndex{*rc::gen::inRange<std::size_t>(0, j)};
    }
    joint.rest = {drawnPoint(0.3), drawnTurn(), Vec3d::Ones()};
    all.push_back(std::move(joint));
  }
  return human::Skeleton(std::move(all));
}

human::SkinWeights drawnWeights(std::size_t vertices, std::size_t joints) {
  const std::size_t most = std::min<std::size_t>(joints, *rc::gen::inRange<std::size_t>(1, 8));
  std::vector<human::Influence> influences;
  for (std::size_t i = 0; i < vertices * most; ++i) {
    const double weight = i % most == 0 ? 1.0 : drawn(0.0, 1.0);
    influences.push_back({*rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(joints)), weight});
  }
  return human::normaliseWeights(influences, most).weights;
}

Channel drawnChannel(JointIndex joint, ChannelPath path) {
  Channel channel{
      joint, path, *rc::gen::element(Interpolation::step, Interpolation::linear, Interpolation::cubicSpline), {}, {}};
  const std::size_t keys = *rc::gen::inRange<std::size_t>(1, 5);
  const std::size_t each = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
  double time = 0.0;
  for (std::size_t k = 0; k < keys; ++k) {
    channel.times.push_back(time);
    time += drawn(0.01, 1.0);
    for (std::size_t i = 0; i < each; ++i) {
      const Vec3d point = drawnPoint(1.0);
      channel.values.emplace_back(path == ChannelPath::rotation
                                      ? Eigen::Vector4d(drawnTurn().coeffs())
                                      : Eigen::Vector4d(point.x(), point.y(), point.z(), 0.0));
    }
  }
  return channel;
}

Rig drawnRig() {
  Rig rig;
  const std::size_t joints = *rc::gen::element<std::size_t>(1, 2, 3, 7, 20, 300);
  rig.skin = geometry::ellipsoid(drawnPoint(0.5), {drawn(0.1, 0.5), drawn(0.1, 0.5), drawn(0.1, 0.5)}, 1);
  rig.skeleton = drawnSkeleton(joints);
  rig.weights = drawnWeights(rig.skin.positions.size(), joints);
  const int clips = *rc::gen::inRange(0, 3);
  for (int c = 0; c < clips; ++c) {
    human::Clip clip{"clip " + std::to_string(c), {}};
    for (std::size_t j = 0; j < std::min<std::size_t>(joints, 4); ++j) {
      clip.channels.push_back(drawnChannel(
          JointIndex{j}, *rc::gen::element(ChannelPath::translation, ChannelPath::rotation, ChannelPath::scale)));
    }
    rig.clips.push_back(std::move(clip));
  }
  return rig;
}

RC_GTEST_PROP(ModelWriterProperty, AnyRigComesBackAsItWasAndGivesTheSameBytes, ()) {
  const Rig rig = drawnRig();
  const std::string bytes = io::modelBytes(rig.model());
  RC_ASSERT(bytes == io::modelBytes(rig.model()));
  const io::Model model = importBytes(bytes, "rig.glb");
  expectSameRig(model, rig);
  expectSameClips(model, rig);
  RC_ASSERT(!testing::Test::HasFailure());
}

RC_GTEST_PROP(ModelWriterProperty, WeightsOfAVertexSumToOneInSinglePrecision, ()) {
  const Rig rig = drawnRig();
  const Parsed file = parse(io::modelBytes(rig.model()));
  const auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
  std::vector<float> sums(rig.skin.positions.size(), 0.0F);
  for (std::size_t set = 0; attributes.contains("WEIGHTS_" + std::to_string(set)); ++set) {
    RC_ASSERT(attributes.contains("JOINTS_" + std::to_string(set)));
    const auto weights = file.numbers<float>(attributes["WEIGHTS_" + std::to_string(set)].get<std::size_t>());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      RC_ASSERT(weights[i] >= 0.0F);
      sums[i / 4] += weights[i];
    }
  }
  for (const float sum : sums) {
    RC_ASSERT(std::abs(sum - 1.0F) <= 4e-7F);
  }
}

}  // namespace
}  // namespace lorica::test
