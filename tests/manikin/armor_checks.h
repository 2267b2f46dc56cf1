#pragma once

/// \file
/// What the armor of every body is held to, at rest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/intersections.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/manikin/armor_systems.h"

namespace lorica::manikin::test {

using geometry::ClosestPointTree;
using geometry::TriangleMesh;
using geometry::Vec3d;

inline constexpr base::Threads kTwo{2};

struct Dressed {
  Body body;
  std::vector<ArmorSystem> systems;
  ClosestPointTree skin;

  explicit Dressed(Body wearer) : body(std::move(wearer)), systems(armorOf(body, kTwo)), skin(body.skin) {}
};

inline const ArmorSystem& systemOf(const Dressed& who, const std::string& name) {
  return *std::find_if(who.systems.begin(), who.systems.end(), [&](const auto& system) { return system.name == name; });
}

inline const ArmorPiece& pieceOf(const Dressed& who, const std::string& system, const std::string& name) {
  const ArmorSystem& found = systemOf(who, system);
  return *std::find_if(found.pieces.begin(), found.pieces.end(), [&](const auto& piece) { return piece.name == name; });
}

inline bool soft(const ArmorPiece& piece) {
  return piece.carriage == armor::Carriage::skinned;
}

inline double smallestAngle(const TriangleMesh& mesh, std::size_t t) {
  double smallest = 180.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3d u = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
    const Vec3d v = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
    smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi);
  }
  return smallest;
}

inline void expectSoundSurfaces(const Dressed& who) {
  for (const std::string system : {"full_torso", "plate_carrier", "helmet"}) {
    for (const ArmorPiece& piece : systemOf(who, system).pieces) {
      const geometry::MeshAudit audit = geometry::audit(piece.mesh);
      EXPECT_TRUE(audit.closed()) << piece.name;
      EXPECT_EQ(audit.components.size(), 1U) << piece.name;
      EXPECT_EQ(audit.oddEdges, 0U) << piece.name;
      EXPECT_EQ(audit.degenerateTriangles, 0U) << piece.name;
      EXPECT_GT(geometry::signedVolume(piece.mesh), 0.0) << piece.name;
      EXPECT_TRUE(geometry::selfIntersections(piece.mesh, kTwo).empty()) << piece.name;
      std::size_t slivers = 0;
      for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
        slivers += smallestAngle(piece.mesh, t) < 5.0 ? 1 : 0;
      }
      EXPECT_LE(100 * slivers, piece.mesh.triangles.size()) << piece.name;
      EXPECT_LE(piece.mesh.triangles.size(), 12000U) << piece.name;
      EXPECT_GE(piece.mesh.triangles.size(), 250U) << piece.name;
    }
  }
}

inline void expectClearOfSkin(const Dressed& who) {
  for (const std::string system : {"full_torso", "plate_carrier", "helmet"}) {
    for (const ArmorPiece& piece : systemOf(who, system).pieces) {
      EXPECT_TRUE(geometry::intersections(piece.mesh, who.body.skin, kTwo).empty()) << piece.name;
      double least = 1.0;
      for (const geometry::Vec3f& position : piece.mesh.positions) {
        least = std::min(least, who.skin.signedDistance(position.cast<double>()));
      }
      EXPECT_GT(least, 0.001) << piece.name;
    }
  }
}

inline void expectPiecesApart(const Dressed& who) {
  for (const std::string name : {"full_torso_helmet", "plate_carrier_helmet"}) {
    const ArmorSystem& system = systemOf(who, name);
    for (std::size_t a = 0; a < system.pieces.size(); ++a) {
      for (std::size_t b = a + 1; b < system.pieces.size(); ++b) {
        EXPECT_TRUE(geometry::intersections(system.pieces[a].mesh, system.pieces[b].mesh, kTwo).empty())
            << system.pieces[a].name << " and " << system.pieces[b].name;
      }
    }
  }
}

inline void expectCloseToSkin(const Dressed& who) {
  for (const std::string system : {"full_torso", "plate_carrier"}) {
    for (const ArmorPiece& piece : systemOf(who, system).pieces) {
      if (!soft(piece)) {
        continue;
      }
      std::vector<double> distances;
      for (std::size_t v = 0; v < piece.mesh.positions.size() / 2; ++v) {
        distances.push_back(who.skin.signedDistance(piece.mesh.positions[v].cast<double>()));
      }
      std::sort(distances.begin(), distances.end());
      EXPECT_GT(distances.front(), 0.0015) << piece.name;
      EXPECT_LT(distances.back(), 0.030) << piece.name;
      if (piece.name == "vest_front" || piece.name == "vest_back") {
        EXPECT_LT(distances[distances.size() / 2], 0.006) << piece.name;
      }
    }
  }
}

inline void expectBothSidesAlike(const Dressed& who) {
  for (const std::string name : {"side", "shoulder", "side_plate"}) {
    const ArmorPiece& left = pieceOf(who, "full_torso", name + "_left");
    const ArmorPiece& right = pieceOf(who, "full_torso", name + "_right");
    EXPECT_NEAR(left.area, right.area, 0.03 * left.area) << name;
    const Vec3d l = geometry::centroid(left.mesh);
    const Vec3d r = geometry::centroid(right.mesh);
    EXPECT_GT(l.x(), 0.0) << name;
    EXPECT_LT((l - Vec3d(-r.x(), r.y(), r.z())).norm(), 0.004) << name;
  }
}

inline void expectWellDressed(const Dressed& who) {
  expectSoundSurfaces(who);
  expectClearOfSkin(who);
  expectPiecesApart(who);
  expectCloseToSkin(who);
  expectBothSidesAlike(who);
}

}  // namespace lorica::manikin::test
