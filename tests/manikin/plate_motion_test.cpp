#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/measures.h"
#include "lorica/human/joint_roles.h"
#include "lorica/manikin/body_measures.h"
#include "lorica/manikin/human.h"
#include "lorica/manikin/task_clips.h"
#include "lorica/parenting/body_rig.h"

namespace lorica::manikin {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;

constexpr base::Threads kTwo{2};
constexpr int kFrames = 8;                  // of each clip
constexpr double kMiddle = 0.050;           // m, about a plate's middle
constexpr double kMostLifted = 0.020;       // m, of a plate's middle more than at rest
constexpr double kDeepest = 0.0;            // m
constexpr double kDeepestInAFold = -0.020;  // m, where the bent belly folds up over the plate's lower edge

/// The skin of the trunk, without arms, legs and head: what a plate lies on.
class Trunk {
 public:
  explicit Trunk(const parenting::Body& body) : skin_{body.skin.positions, {}} {
    const auto ofTrunk = [&](std::size_t t) {
      const std::string& region = body.regions.names[body.regions.ofTriangle[t]];
      return region.starts_with("chest") || region.starts_with("abdomen") || region == "pelvis";
    };
    std::vector<char> edge(body.skin.positions.size(), 0);
    for (std::size_t t = 0; t < body.skin.triangles.size(); ++t) {
      for (const std::uint32_t corner : body.skin.triangles[t]) {
        edge[corner] = edge[corner] != 0 || !ofTrunk(t) ? 1 : 0;
      }
    }
    for (std::size_t t = 0; t < body.skin.triangles.size(); ++t) {
      const geometry::Triangle& corners = body.skin.triangles[t];
      if (ofTrunk(t)) {
        skin_.triangles.push_back(corners);
        atEdge_.push_back(std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return edge[c] != 0; }));
      }
    }
  }

  /// Of points from the trunk in a pose, m; negative inside. Beside an edge, where arm or neck go on, there is no
  /// inside.
  std::vector<double> distances(const geometry::Positions& posed, const geometry::Positions& points) const {
    const geometry::ClosestPointTree tree(TriangleMesh{posed, skin_.triangles});
    std::vector<double> all(points.size());
    base::parallelFor(points.size(), 64, kTwo, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3d p = points[i].cast<double>();
        const geometry::ClosestPoint near = *tree.closest(p);
        const bool inside = !atEdge_[near.triangle] && near.pseudoNormal.dot(p - near.point) < 0.0;
        all[i] = inside ? -near.distance : near.distance;
      }
    });
    return all;
  }

 private:
  TriangleMesh skin_;
  std::vector<bool> atEdge_;
};

/// How a plate lies on the trunk, m.
struct Fit {
  double deepest = std::numeric_limits<double>::infinity();  ///< the least distance, negative inside
  double middle = 0.0;                                       ///< the greatest of the middle of its inner face
  double furthest = 0.0;                                     ///< the greatest of all of it, corners and outer face

  void add(const Fit& other) {
    deepest = std::min(deepest, other.deepest);
    middle = std::max(middle, other.middle);
    furthest = std::max(furthest, other.furthest);
  }
};

/// The vertices of a plate's inner face about its middle.
std::vector<std::size_t> middleOf(const ArmorPiece& plate, const Vec3d& outwards) {
  const auto normals = geometry::vertexNormals(plate.mesh.positions, plate.mesh.triangles);
  std::vector<std::size_t> middle;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const double aside = (plate.mesh.positions[v].cast<double>() - *plate.carriedAt).norm();
    if (normals[v].cast<double>().dot(outwards) < -0.5 && aside < kMiddle) {
      middle.push_back(v);
    }
  }
  return middle;
}

struct Worn {
  std::string name;
  armor::PieceRig bySkin;
  armor::PieceRig bySite;
  std::vector<std::size_t> middle;
};

/// A person, their plates and how they lie.
class Wearer {
 public:
  explicit Wearer(const human::Person& person)
      : human_(keptHuman(person, kTwo)),
        rig_({human_.body.skin, human_.body.skeleton, human_.body.weights,
              human::bodyRegions(human_.body.skin, human_.body.weights, human_.body.skeleton)},
             {.thesisSites = false}, kTwo),
        trunk_(rig_.body()) {
    for (const ArmorSystem& system : human_.systems) {
      for (const ArmorPiece& piece : system.pieces) {
        const bool wanted = system.name == "full_torso" || system.name == "plate_carrier";
        if (wanted && piece.name.find("plate_") != std::string::npos) {
          armor::RigidCarrier carrier = carrierOf(system, piece);
          Worn worn{system.name + "/" + piece.name, bound(piece, carrier), {}, {}};
          carrier.by = armor::CarriedBy::site;
          worn.bySite = bound(piece, carrier);
          worn.middle = middleOf(piece, worn.bySkin.outwards);
          plates_.push_back(std::move(worn));
        }
      }
    }
  }

  const std::vector<human::Clip>& clips() const { return human_.clips; }
  const std::vector<Worn>& plates() const { return plates_; }
  parenting::PosedBody rest() const { return rig_.pose(std::nullopt, kTwo); }
  parenting::PosedBody pose(const human::Clip& clip, double share) const {
    return rig_.pose(human::sample(clip, human_.body.skeleton, share * clip.duration()), kTwo);
  }

  Fit fit(const Worn& plate, const armor::PieceRig& carried, const parenting::PosedBody& posed) const {
    geometry::Positions moved(carried.rest.positions.size());
    armor::posePiece(carried, posed, moved, kTwo);
    const std::vector<double> distances = trunk_.distances(posed.skin, moved);
    Fit fit;
    for (const double distance : distances) {
      fit.add({distance, 0.0, distance});
    }
    for (const std::size_t v : plate.middle) {
      fit.middle = std::max(fit.middle, distances[v]);
    }
    return fit;
  }

 private:
  armor::PieceRig bound(const ArmorPiece& piece, const armor::RigidCarrier& carrier) const {
    return armor::bindPiece(piece.mesh, piece.name, piece.carriage, rig_, nullptr, nullptr, kTwo, carrier);
  }

  Human human_;
  parenting::BodyRig rig_;
  Trunk trunk_;
  std::vector<Worn> plates_;
};

void print(const std::string& clip, const std::string& plate, const Fit& site, const Fit& skin) {
  std::printf("%-14s %-28s %8.1f %8.1f %8.1f | %8.1f %8.1f %8.1f\n", clip.c_str(), plate.c_str(), 1e3 * site.deepest,
              1e3 * site.middle, 1e3 * site.furthest, 1e3 * skin.deepest, 1e3 * skin.middle, 1e3 * skin.furthest);
}

TEST(PlatesInMotion, LieOnTheTrunkThroughEveryTask) {
  const Wearer who({});
  ASSERT_EQ(who.plates().size(), 6U);
  ASSERT_EQ(who.clips().size(), 9U);
  std::printf(
      "mm from the trunk, carried by one site | by the skin under the plate\n%-14s %-28s %8s %8s %8s | %8s %8s %8s\n",
      "clip", "plate", "deepest", "middle", "furthest", "deepest", "middle", "furthest");
  std::vector<Fit> atRest;
  for (const Worn& plate : who.plates()) {
    atRest.push_back(who.fit(plate, plate.bySkin, who.rest()));
    print("rest", plate.name, atRest.back(), atRest.back());
  }
  std::vector<Fit> allBySite(who.plates().size());
  std::vector<Fit> allBySkin(who.plates().size());
  for (const human::Clip& clip : who.clips()) {
    std::vector<Fit> bySite(who.plates().size());
    std::vector<Fit> bySkin(who.plates().size());
    for (int frame = 1; frame <= kFrames; ++frame) {
      const parenting::PosedBody posed = who.pose(clip, static_cast<double>(frame) / (kFrames + 1));
      for (std::size_t p = 0; p < who.plates().size(); ++p) {
        const Worn& plate = who.plates()[p];
        bySite[p].add(who.fit(plate, plate.bySite, posed));
        bySkin[p].add(who.fit(plate, plate.bySkin, posed));
      }
    }
    for (std::size_t p = 0; p < who.plates().size(); ++p) {
      print(clip.name, who.plates()[p].name, bySite[p], bySkin[p]);
      EXPECT_LE(bySkin[p].middle, atRest[p].middle + kMostLifted) << clip.name << " " << who.plates()[p].name;
      EXPECT_GE(bySkin[p].deepest, clip.name == "toe_touch" ? kDeepestInAFold : kDeepest)
          << clip.name << " " << who.plates()[p].name;
      allBySite[p].add(bySite[p]);
      allBySkin[p].add(bySkin[p]);
    }
  }
  for (std::size_t p = 0; p < who.plates().size(); ++p) {
    print("all", who.plates()[p].name, allBySite[p], allBySkin[p]);
    EXPECT_GT(allBySkin[p].deepest, allBySite[p].deepest) << who.plates()[p].name;
  }
}

}  // namespace
}  // namespace lorica::manikin
