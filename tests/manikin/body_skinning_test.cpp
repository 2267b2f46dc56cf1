#include <gtest/gtest.h>

#include "lorica/human/rotation_centres.h"
#include "lorica/manikin/body.h"
#include "lorica/manikin/task_clips.h"
#include "skin_quality.h"

namespace lorica::manikin {
namespace {

class BodySkinning : public testing::TestWithParam<human::Sex> {};

TEST_P(BodySkinning, KeepsVolumeAndTurnsLittleOverInEveryTask) {
  const Body body = makeBody(personAtPercentile(GetParam(), 50.0), {});
  const auto clips = taskClips(body.skeleton, human::findRoles(body.skeleton), measuredOn(body));
  const auto centres = human::rotationCentres(body.skin, body.weights, {});
  geometry::Positions posed(body.skin.positions.size());
  for (const human::Clip& clip : clips) {
    double volumeChange = 0.0;
    double flippedShare = 0.0;
    for (double seconds = 0.0; seconds <= clip.duration(); seconds += 0.25) {
      const auto deltas = human::skinningDeltas(body.skeleton, human::sample(clip, body.skeleton, seconds));
      human::skin(body.skin.positions, body.weights, centres, deltas, posed, {});
      const test::SkinQuality quality = test::skinQuality(body.skin, body.weights, deltas, posed);
      volumeChange = std::max(volumeChange, std::abs(quality.volumeChange));
      flippedShare = std::max(flippedShare, quality.flippedShare);
    }
    std::cout << clip.name << ": volume within " << 100.0 * volumeChange << " %, flipped " << 100.0 * flippedShare
              << " %\n";
    EXPECT_LT(volumeChange, 0.05) << clip.name;
    EXPECT_LT(flippedShare, 0.005) << clip.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Median, BodySkinning, testing::Values(human::Sex::male, human::Sex::female),
                         [](const auto& person) { return person.param == human::Sex::male ? "Man" : "Woman"; });

}  // namespace
}  // namespace lorica::manikin
