#include <gtest/gtest.h>

#include <map>
#include <string>

#include "import_bytes.h"
#include "lorica/human/rotation_centres.h"
#include "real_data.h"
#include "skin_quality.h"

namespace lorica::test {
namespace {

/// The worst of a clip's poses, four a second.
struct ClipQuality {
  double volumeChange = 0.0;  ///< of the largest size
  double flippedShare = 0.0;
};

using Clips = std::map<std::string, ClipQuality>;

/// Every clip of the file, blended about centres and linearly.
std::pair<Clips, Clips> qualities(const std::string& file) {
  const io::Model model = io::importModel(realData() / file);
  const geometry::TriangleMesh& rest = model.parts.at(0).mesh;
  const human::SkinWeights& weights = *model.parts[0].weights;
  const std::vector<geometry::Vec3f> centres = human::rotationCentres(rest, weights, {});
  std::pair<Clips, Clips> result;
  geometry::Positions posed(rest.positions.size());
  for (const human::Clip& clip : model.clips) {
    for (double seconds = 0.0; seconds <= clip.duration(); seconds += 0.25) {
      const auto deltas = human::skinningDeltas(*model.skeleton, human::sample(clip, *model.skeleton, seconds));
      const auto judge = [&](std::span<const geometry::Vec3f> about, ClipQuality& worst) {
        human::skin(rest.positions, weights, about, deltas, posed, {});
        const SkinQuality quality = skinQuality(rest, weights, deltas, posed);
        if (std::abs(quality.volumeChange) > std::abs(worst.volumeChange)) {
          worst.volumeChange = quality.volumeChange;
        }
        worst.flippedShare = std::max(worst.flippedShare, quality.flippedShare);
      };
      judge(centres, result.first[clip.name]);
      judge({}, result.second[clip.name]);
    }
  }
  for (const auto& [name, ours] : result.first) {
    const ClipQuality& linear = result.second[name];
    std::cout << file << " " << name << ": volume " << 100.0 * ours.volumeChange << " %, flipped "
              << 100.0 * ours.flippedShare << " %; linear " << 100.0 * linear.volumeChange << " %, "
              << 100.0 * linear.flippedShare << " %\n";
  }
  return result;
}

TEST(RealSkinning, KeepsTheVisibleHumansVolumeWithoutFlippingItsSkin) {
  LORICA_NEEDS_REAL_DATA("visible-human-male/body.glb");
  const auto [ours, linear] = qualities("visible-human-male/body.glb");
  for (const char* clip : {"toe_touch", "belly_twist", "lateral_twist", "squat", "walk"}) {
    EXPECT_LT(std::abs(ours.at(clip).volumeChange), 0.05) << clip;
  }
  // With the arms raised the file's weights pull the flanks along; linear blending gains 4 % there as well.
  EXPECT_LT(ours.at("arm_raise").volumeChange, 0.065);
  for (const auto& [clip, quality] : ours) {
    EXPECT_LT(quality.flippedShare, 0.005) << clip;
  }
  EXPECT_LT(linear.at("squat").volumeChange, -0.1);
  EXPECT_LT(linear.at("toe_touch").volumeChange, -0.08);
}

TEST(RealSkinning, KeepsTheMakeHumanBodysVolumeAndFlipsLittleMoreThanItsWeightsDo) {
  for (const std::string file :
       {"makehuman-male/body.glb", "makehuman-male/body_12.glb", "makehuman-male/body_cmu.glb"}) {
    LORICA_NEEDS_REAL_DATA(file);
    const auto [ours, linear] = qualities(file);
    for (const auto& [clip, quality] : ours) {
      EXPECT_LT(std::abs(quality.volumeChange), 0.05) << file << " " << clip;
      EXPECT_LT(quality.flippedShare, linear.at(clip).flippedShare + 0.005) << file << " " << clip;
    }
  }
}

}  // namespace
}  // namespace lorica::test
