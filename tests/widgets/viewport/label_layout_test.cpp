#include "label_layout.h"

#include <gtest/gtest.h>

#include <random>

namespace lorica::viewport {
namespace {

bool overlap(const LabelBox& a, const LabelBox& b) {
  const Eigen::Vector2d apart = (a.middle - b.middle).cwiseAbs() - 0.5 * (a.size + b.size);
  return apart.x() < 0.0 && apart.y() < 0.0;
}

TEST(Labels, ThatHaveRoomAreAllSeen) {
  const std::vector<LabelBox> row{{{0, 0}, {10, 4}}, {{10, 0}, {10, 4}}, {{0, 4}, {10, 4}}};
  EXPECT_EQ(withoutOverlaps(row), std::vector<bool>(3, true)) << "touching is not overlapping";
}

TEST(Labels, TheMoreImportantOneStays) {
  EXPECT_EQ(withoutOverlaps({{{0, 0}, {10, 4}}, {{5, 1}, {10, 4}}}), (std::vector<bool>{true, false}));
  EXPECT_EQ(withoutOverlaps({{{0, 0}, {10, 4}}, {{5, 1}, {10, 4}, 1}}), (std::vector<bool>{false, true}));
}

TEST(Labels, NoTwoThatAreSeenOverlapAndEachThatIsNotHasAReason) {
  std::mt19937 random(5);
  const auto upTo = [&](int most) { return static_cast<double>(random() % static_cast<unsigned>(most)); };
  for (int round = 0; round < 50; ++round) {
    std::vector<LabelBox> labels;
    for (int i = 0; i < 30; ++i) {
      labels.push_back({{upTo(200), upTo(100)}, {1 + upTo(40), 1 + upTo(14)}, static_cast<int>(random() % 3)});
    }
    const std::vector<bool> seen = withoutOverlaps(labels);
    for (std::size_t a = 0; a < labels.size(); ++a) {
      bool hidden = false;
      for (std::size_t b = 0; b < labels.size(); ++b) {
        const bool meets = a != b && seen[b] && overlap(labels[a], labels[b]);
        EXPECT_FALSE(seen[a] && meets);
        hidden = hidden || (meets && labels[b].rank >= labels[a].rank);
      }
      EXPECT_TRUE(seen[a] || hidden) << "nothing of its rank or above is in the way";
    }
  }
}

}  // namespace
}  // namespace lorica::viewport
