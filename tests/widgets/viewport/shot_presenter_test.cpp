#include "shot_presenter.h"

#include <gtest/gtest.h>

namespace lorica::viewport {
namespace {

using Kind = ShotMeeting::Kind;
using Ref = analysis::StructureRef;

analysis::ShotPath shot(const std::vector<Ref>& met) {
  analysis::ShotPath path;
  double distance = 1.0;
  for (const Ref& structure : met) {
    path.crossings.push_back({structure, distance, true});
    distance += 1.0;
  }
  return path;
}

const Ref skin{Ref::Kind::body, 0, 0};
const Ref plate{Ref::Kind::piece, 0, 0};
const Ref otherPlate{Ref::Kind::piece, 1, 0};
const Ref heart{Ref::Kind::organ, 3, 0};
const Ref heartOfTheOtherModel{Ref::Kind::organ, 3, 1};

TEST(ShotMeeting, IsAMissWithoutCrossings) {
  EXPECT_EQ(meetingOf(shot({}), 0, {true}).kind, Kind::miss);
}

TEST(ShotMeeting, IsArmorOnlyWhereArmorComesBeforeTheBody) {
  EXPECT_EQ(meetingOf(shot({plate, skin, heart}), 0, {true}).kind, Kind::armor);
  EXPECT_EQ(meetingOf(shot({skin, heart, plate}), 0, {true}).kind, Kind::organ);
  EXPECT_EQ(meetingOf(shot({skin, plate}), 0, {true}).kind, Kind::body);
}

TEST(ShotMeeting, PassesArmorThatIsNotShown) {
  const ShotMeeting met = meetingOf(shot({plate, otherPlate, skin}), 0, {false, true});
  EXPECT_EQ(met.kind, Kind::armor);
  EXPECT_EQ(met.index, 1U);
  EXPECT_EQ(meetingOf(shot({plate, skin}), 0, {false, true}).kind, Kind::body);
}

TEST(ShotMeeting, KnowsTheOrgansOfItsOwnModel) {
  EXPECT_EQ(meetingOf(shot({skin, heartOfTheOtherModel}), 0, {}).kind, Kind::body);
  const ShotMeeting met = meetingOf(shot({skin, heartOfTheOtherModel}), 1, {});
  EXPECT_EQ(met.kind, Kind::organ);
  EXPECT_EQ(met.index, 3U);
}

}  // namespace
}  // namespace lorica::viewport
