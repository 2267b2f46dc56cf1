#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>
#include <random>

#include "import_bytes.h"
#include "lorica/io/motion.h"

namespace lorica::test {
namespace {

using geometry::Quatd;
using geometry::Vec3d;
using io::importMotion;
using io::Motion;

const std::string kTwoBones =
    "HIERARCHY\n"
    "ROOT Hips\n"
    "{\n"
    "  OFFSET 0 10 0\n"
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "  JOINT Chest\n"
    "  {\n"
    "    OFFSET 0 5 0\n"
    "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "    End Site\n"
    "    {\n"
    "      OFFSET 0 4 0\n"
    "    }\n"
    "  }\n"
    "}\n"
    "MOTION\n"
    "Frames: 2\n"
    "Frame Time: 0.25\n"
    "1 2 3 0 0 0 0 0 0\n"
    "1 2 3 90 0 0 0 90 0\n";

Motion read(const std::string& text, std::optional<io::UpAxis> up = std::nullopt) {
  return importMotion("walk.bvh", text, up);
}

/// Where the points of a skeleton are that rest at `rest`.
Vec3d carried(const Motion& motion, double seconds, std::string_view joint, const Vec3d& rest) {
  const auto carry = human::carryTransforms(motion.skeleton, human::sample(motion.clip, motion.skeleton, seconds));
  return carry[motion.skeleton.find(joint).value().value] * rest;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

void expectRefusal(const std::string& text, const std::string& expected) {
  try {
    read(text);
    ADD_FAILURE() << "taken instead of: " << expected;
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("walk.bvh"), std::string::npos) << error.what();
  }
}

TEST(Bvh, HasJointsFramesAndTheirTime) {
  const Motion motion = read(kTwoBones);
  ASSERT_EQ(motion.skeleton.size(), 2U);
  EXPECT_EQ(motion.skeleton.joints()[1].name, "Chest");
  EXPECT_EQ(motion.skeleton.restPosition(human::JointIndex{std::size_t{1}}), Vec3d(0, 15, 0));
  EXPECT_EQ(motion.clip.name, "walk");
  EXPECT_EQ(motion.frames, 2U);
  EXPECT_EQ(motion.clip.duration(), 0.25);
  EXPECT_TRUE(motion.issues.empty());
}

TEST(Bvh, TurnsInTheOrderOfTheChannelsAndMovesToTheirPositions) {
  const Motion motion = read(kTwoBones);
  EXPECT_LT((carried(motion, 0.0, "Hips", {0, 10, 0}) - Vec3d(1, 2, 3)).norm(), 1e-12);
  // At the end the hips have turned a quarter about z, which lays the trunk along -x, and the chest a quarter about its
  // own x, which the hips' turn made y: what stood up on it points along z.
  EXPECT_LT((carried(motion, 0.25, "Chest", {0, 15, 0}) - Vec3d(-4, 2, 3)).norm(), 1e-12);
  EXPECT_LT((carried(motion, 0.25, "Chest", {0, 19, 0}) - Vec3d(-4, 2, 7)).norm(), 1e-12);
}

TEST(Bvh, IsReadHoweverItIsLaidOut) {
  const Motion plain = read(kTwoBones);
  const auto same = [&](const std::string& text) {
    const Motion other = read(text);
    EXPECT_EQ(other.skeleton.size(), plain.skeleton.size());
    EXPECT_EQ(other.clip.channels.size(), plain.clip.channels.size());
    EXPECT_LT((carried(other, 0.25, other.skeleton.joints()[1].name, {0, 19, 0}) - Vec3d(-4, 2, 7)).norm(), 1e-12);
    return other;
  };
  std::string crlf;
  for (const char letter : kTwoBones) {
    crlf += letter == '\n' ? "\r\n" : std::string(1, letter);
  }
  same(crlf);
  same(replaced(kTwoBones, "ROOT Hips\n{", "root Hips {"));
  same(replaced(kTwoBones, "Frames: 2", "Frames: 2\n\n"));
  same(replaced(kTwoBones, "Frames:", "Frames"));
  same(replaced(kTwoBones, "1 2 3 90 0 0 0 90 0", "1 2 3 90\n0 0\n0 90 0"));
  EXPECT_EQ(same(replaced(kTwoBones, "JOINT Chest", "JOINT mixamorig:Left Chest  ")).skeleton.joints()[1].name,
            "mixamorig:Left Chest");
  EXPECT_EQ(same(kTwoBones + "\n\n1 2\n").issues.size(), 1U);
}

TEST(Bvh, StandsUprightWhicheverAxisIsUp) {
  std::string lying = replaced(kTwoBones, "OFFSET 0 10 0", "OFFSET 0 0 10");
  lying = replaced(lying, "OFFSET 0 5 0", "OFFSET 0 0 5");
  lying = replaced(lying, "OFFSET 0 4 0", "OFFSET 0 0 4");
  const Motion motion = read(lying);
  EXPECT_EQ(motion.up, io::UpAxis::z);
  EXPECT_TRUE(motion.upGuessed);
  EXPECT_LT((motion.skeleton.restPosition(human::JointIndex{std::size_t{1}}) - Vec3d(0, 15, 0)).norm(), 1e-12);
  // Forward was -y.
  EXPECT_LT((carried(motion, 0.0, "Hips", {0, 10, 0}) - Vec3d(1, 3, -2)).norm(), 1e-12);
  // A quarter about the old z is one about the new y: what was along x goes backwards.
  EXPECT_LT((carried(motion, 0.25, "Hips", {1, 10, 0}) - Vec3d(1, 3, -3)).norm(), 1e-12);
  EXPECT_EQ(read(lying, io::UpAxis::y).up, io::UpAxis::y);
}

TEST(Bvh, RoundTripsRandomMotions) {
  std::mt19937 random(3);
  const auto degrees = [&] {
    return 360.0 * (static_cast<double>(random()) / static_cast<double>(std::mt19937::max())) - 180.0;
  };
  constexpr int frames = 20;
  std::string text = kTwoBones.substr(0, kTwoBones.find("Frames:"));
  text += fmt::format("Frames: {}\nFrame Time: 0.01\n", frames);
  std::vector<std::array<Quatd, 2>> turns;
  for (int f = 0; f < frames; ++f) {
    std::array<double, 6> angle{};
    std::generate(angle.begin(), angle.end(), degrees);
    text += fmt::format("0 0 0 {}\n", fmt::join(angle, " "));
    const auto turn = [&](std::size_t first) {
      const auto about = [&](std::size_t k, const Vec3d& axis) {
        return Quatd(Eigen::AngleAxisd(angle.at(first + k) * std::numbers::pi / 180.0, axis));
      };
      return Quatd(about(0, Vec3d::UnitZ()) * about(1, Vec3d::UnitX()) * about(2, Vec3d::UnitY()));
    };
    turns.push_back({turn(0), turn(3)});
  }
  const Motion motion = read(text);
  for (int f = 0; f < frames; ++f) {
    const Vec3d expected = turns[static_cast<std::size_t>(f)][0] *
                           (Vec3d(0, 5, 0) + turns[static_cast<std::size_t>(f)][1] * Vec3d(0, 4, 0));
    EXPECT_LT((carried(motion, 0.01 * f, "Chest", {0, 19, 0}) - expected).norm(), 1e-9) << f;
  }
}

TEST(BadBvh, LineIsNamed) {
  expectRefusal("", "HIERARCHY");
  expectRefusal("hello", "line 1: HIERARCHY was expected, not 'hello'");
  expectRefusal("HIERARCHY\nMOTION\n", "line 2: the motion begins, and there was no ROOT");
  expectRefusal("HIERARCHY\nROOT a\n{\n OFFSET 0 0\n", "the file ends where the z of an OFFSET");
  expectRefusal("HIERARCHY\nROOT a\n{\n", "the file ends where");
  expectRefusal(replaced(kTwoBones, "OFFSET 0 5 0", "OFFSET 0 5,2 0"),
                "line 8: the y of an OFFSET was expected, not '5,2'");
  expectRefusal(replaced(kTwoBones, "OFFSET 0 5 0", "OFFSET 0 nan 0"), "line 8");
  expectRefusal(replaced(kTwoBones, "CHANNELS 3", "CHANNELS 7"), "line 9: a joint has 0 to 6 channels, not 7");
  expectRefusal(replaced(kTwoBones, "CHANNELS 3", "CHANNELS -3"), "line 9");
  expectRefusal(replaced(kTwoBones, "CHANNELS 3 Zrotation", "CHANNELS 3 Wrotation"), "not 'Wrotation'");
  expectRefusal(replaced(kTwoBones, "Frames: 2", "Frames: 0"), "line 17: the number of frames");
  expectRefusal(replaced(kTwoBones, "Frames: 2", "Frames: 2.5"), "line 17");
  expectRefusal(replaced(kTwoBones, "Frames: 2", "Frames: 2000000000000"), "the file is too short for them");
  expectRefusal(
      replaced(replaced(kTwoBones, "Frames: 2", "Frames: 3"), "1 2 3 0 0", "1.000000 2.000000 3.000000 0.000000 0"),
      "the file ends where frame 2 was expected");
  expectRefusal(replaced(kTwoBones, "0.25", "0"), "line 18: the time of a frame");
  expectRefusal(replaced(kTwoBones, "1 2 3 90 0 0 0 90 0", "1 2 3 90 0 0 0 x 0"),
                "line 20: Xrotation of joint \"Chest\" in frame 1 was expected, not 'x'");
  expectRefusal(replaced(replaced(kTwoBones, "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation",
                                  "CHANNELS 0"),
                         "CHANNELS 3 Zrotation Xrotation Yrotation", ""),
                "no joint has CHANNELS");
}

TEST(BadBvh, IsRefusedOrReadAtEveryCutAndFlip) {
  for (std::size_t cut = 0; cut < kTwoBones.size(); ++cut) {
    for (const std::string& text :
         {kTwoBones.substr(0, cut), kTwoBones.substr(0, cut) + "}" + kTwoBones.substr(cut + 1),
          kTwoBones.substr(0, cut) + "\x01" + kTwoBones.substr(cut),
          kTwoBones.substr(0, cut) + "9" + kTwoBones.substr(cut)}) {
      try {
        const Motion motion = read(text);
        EXPECT_GE(motion.skeleton.size(), 1U);
        human::sample(motion.clip, motion.skeleton, 0.1);
      } catch (const base::InputError&) {
      }
    }
  }
}

TEST(BadBvh, AHundredThousandJointsInAChainEndInASentence) {
  std::string text = "HIERARCHY\nROOT a\n{\n";
  for (int i = 0; i < 100000; ++i) {
    text += "JOINT b\n{\n";
  }
  expectRefusal(text, "more than 10000 joints");
}

}  // namespace
}  // namespace lorica::test
