#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "lorica/armor/piece_rig.h"
#include "lorica/armor/plates.h"
#include "lorica/geometry/primitives.h"

// Plates on upright columns, which are moved as a whole or bent to a circle about a horizontal axis.

namespace lorica::armor {
namespace {

using geometry::Positions;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;

constexpr double kRadius = 0.15;     // m, of the column
constexpr double kClearance = 0.01;  // m
constexpr double kMiddle = 1.0;      // m, height of the plate's middle

/// A closed upright column of even rings.
TriangleMesh column() {
  constexpr std::uint32_t around = 96;
  constexpr std::uint32_t rings = 101;
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t a = 0; a < around; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / around;
      mesh.positions.push_back(
          Vec3d(kRadius * std::sin(angle), 0.5 + r * 0.01, kRadius * std::cos(angle)).cast<float>());
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t a = 0; a < around; ++a) {
      const std::uint32_t low = r * around + a;
      const std::uint32_t next = r * around + (a + 1) % around;
      mesh.triangles.push_back({low, next, low + around});
      mesh.triangles.push_back({next, next + around, low + around});
    }
  }
  for (const std::uint32_t end : {0U, (rings - 1) * around}) {
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0.0F, end == 0 ? 0.5F : 1.5F, 0.0F);
    for (std::uint32_t a = 0; a < around; ++a) {
      const std::uint32_t one = end + a;
      const std::uint32_t two = end + (a + 1) % around;
      mesh.triangles.push_back(end == 0 ? geometry::Triangle{two, one, middle} : geometry::Triangle{one, two, middle});
    }
  }
  return mesh;
}

/// A box before the column, cut fine.
TriangleMesh flatPlate() {
  TriangleMesh mesh = geometry::box(Vec3d(-0.1, kMiddle - 0.15, kRadius + kClearance),
                                    Vec3d(0.1, kMiddle + 0.15, kRadius + kClearance + 0.02));
  for (int round = 0; round < 5; ++round) {
    TriangleMesh finer{mesh.positions, {}};
    for (const geometry::Triangle& t : mesh.triangles) {
      const auto half = [&](std::uint32_t a, std::uint32_t b) {
        finer.positions.push_back(0.5F * (mesh.positions[a] + mesh.positions[b]));
        return static_cast<std::uint32_t>(finer.positions.size() - 1);
      };
      const std::uint32_t ab = half(t[0], t[1]);
      const std::uint32_t bc = half(t[1], t[2]);
      const std::uint32_t ca = half(t[2], t[0]);
      finer.triangles.insert(finer.triangles.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    mesh = std::move(finer);
  }
  return mesh;
}

const parenting::BodyRig& columnBody() {
  static const parenting::BodyRig rig = [] {
    parenting::Body body;
    body.skin = column();
    body.regions.names = {"unassigned"};
    body.regions.ofTriangle.assign(body.skin.triangles.size(), 0);
    return parenting::BodyRig(std::move(body), {.siteSpacing = 0.2, .thesisSites = false}, {});
  }();
  return rig;
}

PieceRig carriedBySkin(const TriangleMesh& piece, const TriangleMesh* plate = nullptr) {
  return bindPiece(piece, "plate", Carriage::rigid, columnBody(), nullptr, nullptr, {}, {CarriedBy::skin, {}, plate});
}

parenting::PosedBody posedBody(Positions skin) {
  parenting::PosedBody posed = columnBody().pose(std::nullopt, {});
  posed.skin = std::move(skin);
  return posed;
}

Positions posedPiece(const PieceRig& piece, const parenting::PosedBody& body) {
  Positions posed(piece.rest.positions.size());
  posePiece(piece, body, posed, {});
  return posed;
}

/// The column bent backwards to a circle: y becomes the way along it, and what lies before the column its outside.
Positions bent(const Positions& rest, double radius) {
  Positions posed;
  for (const Vec3f& p : rest) {
    const double angle = (static_cast<double>(p.y()) - kMiddle) / radius;
    const double from = radius + static_cast<double>(p.z());
    posed.push_back(Vec3d(static_cast<double>(p.x()), kMiddle + from * std::sin(angle), from * std::cos(angle) - radius)
                        .cast<float>());
  }
  return posed;
}

/// Of a point off the bent column's surface.
double heightOverBent(const Vec3f& p, double radius) {
  const double from = std::hypot(static_cast<double>(p.y()) - kMiddle, static_cast<double>(p.z()) + radius);
  const double z = std::copysign(from, radius) - radius;
  return std::hypot(static_cast<double>(p.x()), z) - kRadius;
}

TEST(PlateCarriage, KeepsEveryBitAtRest) {
  const PieceRig piece = carriedBySkin(flatPlate());
  ASSERT_GT(piece.under.size(), 100U);
  EXPECT_LE(piece.under.size(), 400U);
  EXPECT_NEAR(piece.outwards.z(), 1.0, 1e-6);
  const Positions posed = posedPiece(piece, columnBody().pose(std::nullopt, {}));
  EXPECT_EQ(std::memcmp(posed.data(), piece.rest.positions.data(), posed.size() * sizeof(Vec3f)), 0);
}

TEST(PlateCarriage, MovesWithABodyThatMovesAsOne) {
  const PieceRig piece = carriedBySkin(flatPlate());
  for (const double degrees : {1.0, 90.0, 180.0, 233.0}) {
    const geometry::RigidTransform motion{
        geometry::Quatd(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vec3d(1.0, -2.0, 0.5).normalized())),
        Vec3d(0.3, -1.2, 2.0)};
    const Positions posed =
        posedPiece(piece, posedBody(geometry::transformed(columnBody().body().skin.positions, motion)));
    const Positions expected = geometry::transformed(piece.rest.positions, motion);
    double furthest = 0.0;
    for (std::size_t v = 0; v < posed.size(); ++v) {
      furthest = std::max(furthest, static_cast<double>((posed[v] - expected[v]).norm()));
    }
    EXPECT_LT(furthest, 2e-6) << degrees;
  }
}

TEST(PlateCarriage, LiesOnABentColumnNeitherInItNorOffIt) {
  const PieceRig piece = carriedBySkin(flatPlate());
  const Positions& rest = columnBody().body().skin.positions;
  // Bent away from the plate it touches at its middle; bent around it, near its ends, with the sagitta behind its
  // middle. The skin that was under its ends at rest, to half a place, has then been pressed together, and the plate's
  // ends reach beyond it by what the sagitta still grows.
  const double place = std::sqrt(0.2 * 0.3 / 300.0);
  for (const double radius : {0.8, 1.5, 5.0, -1.0, -2.0}) {
    const double front = std::abs(radius + kRadius);
    const auto sagitta = [&](double along) { return front - std::sqrt(front * front - along * along); };
    const double lastPlace = front * std::sin((0.15 - 0.5 * place) / std::abs(radius));
    const double beyond = radius > 0.0 ? 0.0 : sagitta(0.15) - sagitta(lastPlace);
    double least = 1.0;
    double atMiddle = 1.0;
    for (const Vec3f& p : posedPiece(piece, posedBody(bent(rest, radius)))) {
      const double height = heightOverBent(p, radius);
      least = std::min(least, height);
      if (std::abs(static_cast<double>(p.x())) < 0.02 && std::abs(static_cast<double>(p.y()) - kMiddle) < 0.02) {
        atMiddle = std::min(atMiddle, height);
      }
    }
    EXPECT_LE(least, kClearance + 0.0005) << radius;
    EXPECT_GE(least, kClearance - beyond - 0.0005) << radius;
    EXPECT_GE(atMiddle, kClearance - 0.0005) << radius;
    EXPECT_LE(atMiddle, kClearance + (radius > 0.0 ? 0.0 : sagitta(0.15)) + 0.0005) << radius;
  }
}

TEST(PlateCarriage, TakesWhatIsFixedToThePlateAlong) {
  const TriangleMesh plate = flatPlate();
  const TriangleMesh pouch = geometry::box(Vec3d(0.03, 0.9, 0.19), Vec3d(0.09, 1.0, 0.22));
  const PieceRig both[] = {carriedBySkin(plate), carriedBySkin(pouch, &plate)};
  const parenting::PosedBody body = posedBody(bent(columnBody().body().skin.positions, 0.6));
  const Positions moved = posedPiece(both[0], body);
  const Positions along = posedPiece(both[1], body);
  for (std::size_t v = 0; v < along.size(); ++v) {
    for (std::size_t w = 0; w < moved.size(); w += 97) {
      EXPECT_NEAR((along[v] - moved[w]).norm(), (pouch.positions[v] - plate.positions[w]).norm(), 1e-6);
    }
  }
}

TEST(PlateCarriage, IsLeftToTheSiteWhereNoSkinIsUnderThePlate) {
  TriangleMesh far = flatPlate();
  for (Vec3f& p : far.positions) {
    p.z() += 0.3F;
  }
  const PieceRig piece = carriedBySkin(far);
  EXPECT_TRUE(piece.under.empty());
  ASSERT_TRUE(piece.hasSite);
  parenting::PosedBody body = columnBody().pose(std::nullopt, {});
  body.sites.carry[piece.site].translation = Vec3d(0.0, 0.5, 0.0);
  EXPECT_NEAR(posedPiece(piece, body)[0].y(), far.positions[0].y() + 0.5F, 1e-6F);
}

TEST(PlateCarriage, IsLeftToTheSiteWhereTheSkinCollapsesToALine) {
  const PieceRig piece = carriedBySkin(flatPlate());
  Positions line = columnBody().body().skin.positions;
  for (Vec3f& p : line) {
    p.x() = p.z() = 0.0F;
  }
  parenting::PosedBody body = posedBody(line);
  body.sites.carry[piece.site].translation = Vec3d(0.0, 0.5, 0.0);
  EXPECT_NEAR(posedPiece(piece, body)[0].y(), piece.rest.positions[0].y() + 0.5F, 1e-6F);
}

}  // namespace
}  // namespace lorica::armor
