#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lorica/analysis/check.h"
#include "lorica/analysis/import_study.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

namespace fs = std::filesystem;

using geometry::Vec3d;

/// A person in T-pose who goes two metres to their left in a second, 1 unit being 1 cm. \param prefix of joint names
std::string sideways(const std::string& prefix) {
  std::string hierarchy;
  std::size_t joints = 0;
  const auto open = [&](const std::string& kind, const std::string& name, const Vec3d& offset) {
    hierarchy +=
        fmt::format("{} {}{}\n{{\nOFFSET {} {} {}\nCHANNELS {}Zrotation Xrotation Yrotation\n", kind, prefix, name,
                    offset.x(), offset.y(), offset.z(), kind == "ROOT" ? "6 Xposition Yposition Zposition " : "3 ");
    ++joints;
  };
  const auto close = [&](int count) {
    for (int i = 0; i < count; ++i) {
      hierarchy += "}\n";
    }
  };
  open("ROOT", "Hips", {0, 0, 0});
  open("JOINT", "Spine", {0, 12, 0});
  open("JOINT", "Spine2", {0, 24, 0});
  for (const double out : {1.0, -1.0}) {
    const std::string side = out > 0.0 ? "Left" : "Right";
    open("JOINT", side + "Arm", {18 * out, 12, 0});
    open("JOINT", side + "ForeArm", {28 * out, 0, 0});
    open("JOINT", side + "Hand", {25 * out, 0, 0});
    close(3);
  }
  close(2);
  for (const double out : {1.0, -1.0}) {
    const std::string side = out > 0.0 ? "Left" : "Right";
    open("JOINT", side + "UpLeg", {9 * out, -3, 0});
    open("JOINT", side + "Leg", {0, -42, 0});
    open("JOINT", side + "Foot", {0, -42, 0});
    close(3);
  }
  close(1);
  std::string frames;
  for (int f = 0; f <= 10; ++f) {
    frames += fmt::format("{} 95 0", 20 * f);
    for (std::size_t c = 0; c < 3 * joints; ++c) {
      frames += " 0";
    }
    frames += '\n';
  }
  return "HIERARCHY\n" + hierarchy + "MOTION\nFrames: 11\nFrame Time: 0.1\n" + frames;
}

class RecordedMotions : public testing::Test {
 protected:
  RecordedMotions() {
    base::writeFileAtomically(folder_.path() / "crab walk.bvh", sideways(""));
    base::writeFileAtomically(folder_.path() / "nameless.bvh", sideways("j."));
  }
  fs::path file() const { return folder_.path() / "s.lorica.json"; }
  study::Study study(const std::string& name, const std::string& motion) const {
    study::Study made;
    made.human.from = study::Builtin{"human"};
    made.motions.push_back({name, {motion, study::sha256OfInput(folder_.path() / motion), {}, {}}});
    return made;
  }
  void expectRefusal(const study::Study& study, const std::vector<std::string>& words) const {
    try {
      load(study, file(), {});
      ADD_FAILURE() << "was loaded";
    } catch (const base::InputError& error) {
      for (const std::string& word : words) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      }
    }
  }
  static Vec3d pelvis(const LoadedStudy& loaded, const std::string& pose) {
    const human::Skeleton& skeleton = *loaded.body->body().skeleton;
    const auto carry = human::carryTransforms(skeleton, *resolvePose(loaded, pose).pose);
    return carry[0] * skeleton.restPosition(human::JointIndex{std::size_t{0}}) -
           skeleton.restPosition(human::JointIndex{std::size_t{0}});
  }

  test::TemporaryFolder folder_;
};

TEST_F(RecordedMotions, AreClipsOfTheBody) {
  const LoadedStudy loaded = load(study("crab", "crab walk.bvh"), file(), {});
  ASSERT_EQ(loaded.clips.back().name, "crab");
  EXPECT_DOUBLE_EQ(loaded.clips.back().duration(), 1.0);
  // Two metres on legs of 84 cm, as far as the body's legs take it.
  const Vec3d end = pelvis(loaded, "crab@1");
  EXPECT_NEAR(pelvis(loaded, "crab@0.5").x(), 0.5 * end.x(), 1e-9);
  EXPECT_NEAR(end.x(), 2.0 * 0.4715 * 1.755 / 0.84, 0.05);
  EXPECT_NEAR(end.z(), 0.0, 1e-9);
  EXPECT_NEAR(end.y(), 0.0, 0.01) << "the feet stay on the floor, whose legs are a little straighter";
  const auto says = [&](const std::string& words) {
    return std::any_of(loaded.issues.begin(), loaded.issues.end(), [&](const base::Issue& issue) {
      return issue.file == "crab walk.bvh" && issue.text.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("11 frames of 100.00 ms"));
  EXPECT_TRUE(says("goes 2.0 m through the room"));
}

TEST_F(RecordedMotions, StayOnTheSpotWhereTheStudySaysSo) {
  study::Study wanted = study("crab", "crab walk.bvh");
  wanted.motions[0].inPlace = true;
  const LoadedStudy loaded = load(wanted, file(), {});
  EXPECT_LT(pelvis(loaded, "crab@1").norm(), 0.01);
}

TEST_F(RecordedMotions, NeedAClipNameOfTheirOwn) {
  expectRefusal(study("toe_touch", "crab walk.bvh"), {"/motions/0/name", "toe_touch", "another name"});
}

TEST_F(RecordedMotions, OfNamelessJointsNeedRoles) {
  // "j.Hips" still says hips; only letters that say nothing are in the way.
  std::string text = sideways("");
  for (const std::string name : {"Hips", "UpLeg", "ForeArm"}) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
      text.replace(at, name.size(), "xq" + std::to_string(name.size()));
    }
  }
  base::writeFileAtomically(folder_.path() / "nameless.bvh", text);
  study::Study wanted = study("crab", "nameless.bvh");
  expectRefusal(wanted, {"nameless.bvh", "joint_roles"});
  wanted.motions[0].jointRoles = {{"pelvis", {"xq4"}}};
  expectRefusal(wanted, {"/motions/0/joint_roles"});
  wanted.motions[0].jointRoles = {{"pelvis", {"xq4"}},
                                  {"lumbar", {"Spine"}},
                                  {"thoracic", {"Spine2"}},
                                  {"shoulder_left", {"LeftArm"}},
                                  {"elbow_left", {"Leftxq7"}},
                                  {"wrist_left", {"LeftHand"}},
                                  {"shoulder_right", {"RightArm"}},
                                  {"elbow_right", {"Rightxq7"}},
                                  {"wrist_right", {"RightHand"}},
                                  {"hip_left", {"Leftxq5"}},
                                  {"knee_left", {"LeftLeg"}},
                                  {"ankle_left", {"LeftFoot"}},
                                  {"hip_right", {"Rightxq5"}},
                                  {"knee_right", {"RightLeg"}},
                                  {"ankle_right", {"RightFoot"}}};
  EXPECT_EQ(load(wanted, file(), {}).clips.back().name, "crab");
}

TEST_F(RecordedMotions, WhoseFileChangedAreRefused) {
  study::Study wanted = study("crab", "crab walk.bvh");
  base::writeFileAtomically(folder_.path() / "crab walk.bvh", sideways("") + "\n");
  expectRefusal(wanted, {"crab walk.bvh", "has changed", "--accept-inputs"});
}

TEST_F(RecordedMotions, AreTakenFromAnEarlierLoadingUnlessTheyChanged) {
  const LoadedStudy first = load(study("crab", "crab walk.bvh"), file(), {});
  LoadOptions options;
  options.previous = &first;
  study::Study wanted = first.study;
  wanted.seed = 7;
  const LoadedStudy same = load(wanted, file(), {}, {}, options);
  EXPECT_EQ(same.clips.size(), first.clips.size());
  EXPECT_EQ(pelvis(same, "crab@1"), pelvis(first, "crab@1"));
  EXPECT_EQ(same.issues.size(), first.issues.size());
  wanted.motions[0].inPlace = true;
  const LoadedStudy onTheSpot = load(wanted, file(), {}, {}, options);
  EXPECT_EQ(onTheSpot.clips.size(), first.clips.size());
  EXPECT_LT(pelvis(onTheSpot, "crab@1").norm(), 0.01);
  wanted.motions.clear();
  EXPECT_EQ(load(wanted, file(), {}, {}, options).clips.size(), first.clips.size() - 1);
}

TEST_F(RecordedMotions, AreCheckedByThemselves) {
  const base::Issues issues = checkFile(folder_.path() / "crab walk.bvh", {});
  ASSERT_FALSE(issues.empty());
  EXPECT_NE(issues.front().text.find("motion of 11 frames, 1.000 s"), std::string::npos);
}

}  // namespace
}  // namespace lorica::analysis
