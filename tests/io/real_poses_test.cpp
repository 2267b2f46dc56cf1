#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "import_bytes.h"
#include "lorica/base/files.h"
#include "real_data.h"

namespace lorica::test {
namespace {

using nlohmann::json;

json read(const std::string& file) {
  return json::parse(base::readFile(realData() / file));
}

const human::Clip& clipNamed(const io::Model& model, const std::string& name) {
  for (const human::Clip& clip : model.clips) {
    if (clip.name == name) {
      return clip;
    }
  }
  throw std::out_of_range(name);
}

std::vector<geometry::Vec3f> posed(const io::Model& model, const human::Pose& pose) {
  const geometry::Positions& rest = model.parts.at(0).mesh.positions;
  std::vector<geometry::Vec3f> result(rest.size());
  human::skin(rest, *model.parts[0].weights, human::skinningDeltas(*model.skeleton, pose), result, {1});
  return result;
}

/// Largest distance of the listed vertices from where they should be, metres.
double largestError(const std::vector<geometry::Vec3f>& found, const json& vertices, const json& expected) {
  double largest = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const geometry::Vec3d point(expected[i][0].get<double>(), expected[i][1].get<double>(),
                                expected[i][2].get<double>());
    largest = std::max(largest, (found.at(vertices[i].get<std::size_t>()).cast<double>() - point).norm());
  }
  return largest;
}

TEST(ExpectedSkinning, OfTheVisibleHumanIsMet) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/expected_skinning.json");
  const json expected = read("visible-human-male/expected_skinning.json");
  const io::Model model = io::importModel(realData() / "visible-human-male/body.glb");
  ASSERT_FALSE(expected["cases"].empty());
  for (const json& item : expected["cases"]) {
    const double seconds = item["time_s"].get<double>();
    const auto pose = human::sample(clipNamed(model, item["clip"].get<std::string>()), *model.skeleton, seconds);
    EXPECT_LT(largestError(posed(model, pose), expected["vertices"], item["positions"]),
              expected["tolerance_m"].get<double>())
        << item["clip"] << " at " << seconds;
  }
}

TEST(ExpectedPoses, OfTheMakeHumanBodiesAreMet) {
  LORICA_NEEDS_REAL_DATA("makehuman-male/expected_poses.json");
  const json expected = read("makehuman-male/expected_poses.json");
  std::size_t poses = 0;
  for (const auto& [file, variants] : expected["files"].items()) {
    const io::Model model = io::importModel(realData() / "makehuman-male" / file);
    for (const auto& [variant, cases] : variants.items()) {
      if (variant.find("raw") != std::string::npos) {
        continue;  // what a reader that does not normalise would give
      }
      for (const auto& [name, positions] : cases.items()) {
        const std::size_t at = name.find('@');
        const human::Pose pose =
            at == std::string::npos
                ? human::restPose(*model.skeleton)
                : human::sample(clipNamed(model, name.substr(0, at)), *model.skeleton, std::stod(name.substr(at + 1)));
        EXPECT_LT(largestError(posed(model, pose), expected["vertices"], positions), 2e-6)
            << file << " " << variant << " " << name;
        ++poses;
      }
    }
  }
  EXPECT_GT(poses, 30U);
}

}  // namespace
}  // namespace lorica::test
