#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lorica/human/joint_roles.h"
#include "lorica/manikin/armor_systems.h"
#include "lorica/manikin/body_measures.h"
#include "lorica/manikin/human.h"
#include "lorica/manikin/task_clips.h"
#include "posed_skin.h"

namespace lorica::manikin {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using test::PosedSkin;

constexpr base::Threads kTwo{2};
constexpr int kFrames = 8;         // of each clip
constexpr double kLeast = 0.001;   // m
constexpr std::size_t kEvery = 8;  // vertex is asked whether it lies in a fold

struct Worn {
  const ArmorPiece* piece = nullptr;
  armor::PieceRig rig;
};

/// A body, what it wears and what it does.
struct Wearer {
  Body body;
  std::vector<ArmorSystem> systems;
  std::vector<human::Clip> clips;
  parenting::BodyRig rig;
  std::vector<Worn> pieces;

  explicit Wearer(const human::Person& person)
      : body(makeBody(person, kTwo)),
        systems(armorOf(body, kTwo)),
        clips(taskClips(body.skeleton, human::findRoles(body.skeleton), measuredOn(body))),
        rig({body.skin, body.skeleton, body.weights, human::bodyRegions(body.skin, body.weights, body.skeleton)}, {},
            kTwo) {
    for (const ArmorSystem& system : systems) {
      if (system.name != "full_torso_helmet" && system.name != "plate_carrier") {
        continue;
      }
      for (const ArmorPiece& piece : system.pieces) {
        pieces.push_back({&piece, armor::bindPiece(piece.mesh, piece.name, piece.carriage, rig,
                                                   piece.weights ? &*piece.weights : nullptr,
                                                   piece.weights ? &body.skeleton : nullptr, kTwo,
                                                   carrierOf(system, piece), armor::SoftFit::heldOff)});
      }
    }
  }
};

bool soft(const ArmorPiece& piece) {
  return piece.carriage == armor::Carriage::skinned;
}

/// What a motion does to a piece: metres from the posed skin, negative inside; of the inner face of soft pieces.
struct Strain {
  double least = 1.0;      ///< outside folds
  double greatest = -1.0;  ///< of soft pieces' outer face too
  int near = 0;            ///< vertices nearer than 1 mm or inside, outside folds, over the frames
  double folds = 0.0;      ///< share of the piece in folds, in the worst frame; of every eighth vertex
  double entered = 0.0;    ///< share of the vertices nearer than 1 mm in folds, in the worst frame
  double deepest = 1.0;    ///< folds included
  double creased = 0.0;    ///< share of the edges over which a soft piece has folded back on itself, in the worst frame

  void add(const Strain& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
    near += other.near;
    folds = std::max(folds, other.folds);
    entered = std::max(entered, other.entered);
    deepest = std::min(deepest, other.deepest);
    creased = std::max(creased, other.creased);
  }
};

Strain measure(const ArmorPiece& piece, const geometry::Positions& moved, const PosedSkin& skin) {
  const std::size_t inner = soft(piece) ? moved.size() / 2 : moved.size();
  std::vector<double> distance(moved.size());
  std::vector<char> fold(inner, 0);
  base::parallelFor(moved.size(), 128, kTwo, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster = skin.caster();
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3d p = moved[v].cast<double>();
      distance[v] = skin.distance(p, caster);
      if (v < inner && (distance[v] < kLeast || v % kEvery == 0)) {
        fold[v] = skin.folds(p, caster) ? 1 : 0;
      }
    }
  });
  Strain strain;
  strain.greatest = *std::max_element(distance.begin(), distance.end());
  const double one = 1.0 / static_cast<double>(inner);
  const double ofAsked = 1.0 / static_cast<double>((inner + kEvery - 1) / kEvery);
  for (std::size_t v = 0; v < inner; ++v) {
    strain.folds += v % kEvery == 0 && fold[v] != 0 ? ofAsked : 0.0;
    if (distance[v] < kLeast) {
      strain.entered += fold[v] != 0 ? one : 0.0;
      strain.near += fold[v] != 0 ? 0 : 1;
    }
    strain.deepest = std::min(strain.deepest, distance[v]);
    strain.least = fold[v] != 0 ? strain.least : std::min(strain.least, distance[v]);
  }
  return strain;
}

/// Share of the edges whose triangles were within 60 degrees at rest and are more than 120 degrees apart.
double creases(const TriangleMesh& rest, const geometry::Positions& moved) {
  const auto normals = [&](const geometry::Positions& at) {
    std::vector<Vec3d> all;
    for (const geometry::Triangle& t : rest.triangles) {
      const Vec3d a = at[t[0]].cast<double>();
      all.emplace_back((at[t[1]].cast<double>() - a).cross(at[t[2]].cast<double>() - a).normalized());
    }
    return all;
  };
  const std::vector<Vec3d> before = normals(rest.positions);
  const std::vector<Vec3d> after = normals(moved);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> sideOf;
  std::size_t edges = 0;
  std::size_t creased = 0;
  for (std::uint32_t t = 0; t < rest.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = rest.triangles[t][k];
      const std::uint32_t to = rest.triangles[t][(k + 1) % 3];
      sideOf[{from, to}] = t;
      if (const auto twin = sideOf.find({to, from}); twin != sideOf.end()) {
        ++edges;
        const bool flat = before[t].dot(before[twin->second]) > 0.5;
        creased += flat && after[t].dot(after[twin->second]) < -0.5 ? 1 : 0;
      }
    }
  }
  return static_cast<double>(creased) / static_cast<double>(edges);
}

void print(const std::string& clip, const std::string& piece, const Strain& strain) {
  std::printf("%-14s %-17s %8.1f %8.1f %8d %10.1f %12.1f %8.1f %9.2f\n", clip.c_str(), piece.c_str(),
              1e3 * strain.least, 1e3 * strain.greatest, strain.near, 100.0 * strain.folds, 100.0 * strain.entered,
              1e3 * strain.deepest, 100.0 * strain.creased);
}

/// The most of a soft piece that folds may hold, and that may be entered there, in any frame. A lowered arm lies along
/// the whole side, a raised thigh along the whole groin; chest and back are nearly free of folds.
struct MostInFolds {
  double folds;
  double entered;
};
MostInFolds mostInFolds(const std::string& piece) {
  if (piece.starts_with("side_") || piece.starts_with("cummerbund_")) {
    return {1.0, 0.65};
  }
  if (piece == "groin") {
    return {1.0, 0.35};
  }
  const bool free = piece.starts_with("shoulder_") || piece == "collar";
  return free ? MostInFolds{0.30, 0.02} : MostInFolds{0.45, 0.10};
}

constexpr double kDeepest = -0.020;  // m, of what enters a soft piece in a fold

class ArmorInMotion : public testing::TestWithParam<human::Person> {};

TEST_P(ArmorInMotion, StaysOnTheSkinThroughEveryTask) {
  const Wearer who(GetParam());
  ASSERT_EQ(who.clips.size(), 9U);
  std::printf("%-14s %-17s %8s %8s %8s %10s %12s %8s %9s\n", "clip", "piece", "least", "most", "< 1 mm", "% in folds",
              "% entered", "deepest", "% creased");
  for (const human::Clip& clip : who.clips) {
    std::vector<Strain> strains(who.pieces.size());
    for (int frame = 1; frame <= kFrames; ++frame) {
      const human::Pose pose = human::sample(clip, who.body.skeleton, clip.duration() * frame / (kFrames + 1));
      const parenting::PosedBody posed = who.rig.pose(pose, kTwo);
      const PosedSkin skin(who.rig, posed.skin);
      for (std::size_t p = 0; p < who.pieces.size(); ++p) {
        const ArmorPiece& piece = *who.pieces[p].piece;
        geometry::Positions moved(piece.mesh.positions.size());
        armor::posePiece(who.pieces[p].rig, posed, moved, kTwo);
        Strain strain = measure(piece, moved, skin);
        strain.creased = soft(piece) ? creases(piece.mesh, moved) : 0.0;
        strains[p].add(strain);
      }
    }
    for (std::size_t p = 0; p < who.pieces.size(); ++p) {
      const ArmorPiece& piece = *who.pieces[p].piece;
      print(clip.name, piece.name, strains[p]);
      if (soft(piece)) {
        EXPECT_EQ(strains[p].near, 0) << clip.name << " " << piece.name;
        EXPECT_LE(strains[p].folds, mostInFolds(piece.name).folds + 1e-9) << clip.name << " " << piece.name;
        EXPECT_LE(strains[p].entered, mostInFolds(piece.name).entered) << clip.name << " " << piece.name;
        EXPECT_GE(strains[p].deepest, kDeepest) << clip.name << " " << piece.name;
        EXPECT_LE(strains[p].greatest, 0.030) << clip.name << " " << piece.name;
        EXPECT_LE(strains[p].creased, 0.03) << clip.name << " " << piece.name;
      }
    }
  }
}

TEST(PosedSkin, HasFoldsWhereSkinFacesSkinOnly) {
  const Body body = keptHuman({}, kTwo).body;
  const parenting::BodyRig rig(
      {body.skin, body.skeleton, body.weights, human::bodyRegions(body.skin, body.weights, body.skeleton)}, {}, kTwo);
  const PosedSkin skin(rig, body.skin.positions);
  raycast::Caster caster = skin.caster();
  const auto joint = [&](const char* name) {
    return Vec3d(body.skeleton.restPosition(body.skeleton.find(name).value()));
  };
  // From well outside straight to the skin: before and behind the trunk, and up between the thighs.
  const auto onSkin = [&](const Vec3d& from, const Vec3d& way) {
    Vec3d p = from;
    while (skin.distance(p, caster) > 0.002) {
      p += 0.001 * way;
    }
    return p;
  };
  const Vec3d chest = 0.5 * (joint("spine_C7T1") + joint("spine_L3L4"));
  EXPECT_FALSE(skin.folds(onSkin(chest + Vec3d(0.05, 0.0, 0.4), {0.0, 0.0, -1.0}), caster));
  EXPECT_FALSE(skin.folds(onSkin(chest + Vec3d(0.05, 0.0, -0.4), {0.0, 0.0, 1.0}), caster));
  const Vec3d crotch(0.0, joint("hip_L").y() - 0.4, joint("hip_L").z());
  EXPECT_TRUE(skin.folds(onSkin(crotch, {0.0, 1.0, 0.0}), caster));
}

std::string personName(const testing::TestParamInfo<human::Person>& info) {
  const human::Person& p = info.param;
  return std::string(p.sex == human::Sex::female ? "Woman" : "Man") + std::to_string(std::lround(1000 * p.stature)) +
         "_" + std::to_string(std::lround(p.mass));
}

INSTANTIATE_TEST_SUITE_P(
    On, ArmorInMotion,
    testing::Values(personAtPercentile(human::Sex::male, 50), personAtPercentile(human::Sex::male, 5),
                    personAtPercentile(human::Sex::male, 95), personAtPercentile(human::Sex::female, 50),
                    personAtPercentile(human::Sex::female, 5), personAtPercentile(human::Sex::female, 95),
                    human::Person{human::Sex::male, 1.755, 120}, human::Person{human::Sex::female, 1.63, 48}),
    personName);

}  // namespace
}  // namespace lorica::manikin
