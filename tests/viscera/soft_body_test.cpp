#include "lorica/viscera/soft_body.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"
#include "lorica/geometry/winding.h"
#include "lorica/viscera/lattice_quality.h"

namespace lorica::viscera {
namespace {

using geometry::Positions;
using geometry::Quatd;
using geometry::RigidTransform;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;

constexpr double radius = 0.12;
constexpr double length = 0.8;
/// For tests that settle many poses.
constexpr SoftBodyOptions coarse{.cellMetres = 0.04};

/// A closed cylinder about the y axis, y from 0 to `length`, of rings and rows about 20 mm apart.
TriangleMesh cylinder() {
  constexpr std::uint32_t around = 36;
  constexpr std::uint32_t rows = 40;
  constexpr std::uint32_t rings = 6;  // of each lid
  TriangleMesh mesh;
  std::vector<std::uint32_t> starts;
  const auto ring = [&](double y, double r) {
    starts.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.positions.push_back(Vec3d(r * std::sin(angle), y, r * std::cos(angle)).cast<float>());
    }
  };
  for (std::uint32_t k = 1; k < rings; ++k) {
    ring(0.0, radius * k / rings);
  }
  for (std::uint32_t k = 0; k <= rows; ++k) {
    ring(length * k / rows, radius);
  }
  for (std::uint32_t k = rings - 1; k > 0; --k) {
    ring(length, radius * k / rings);
  }
  for (std::size_t s = 0; s + 1 < starts.size(); ++s) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t j = (i + 1) % around;
      mesh.triangles.push_back({starts[s] + i, starts[s] + j, starts[s + 1] + j});
      mesh.triangles.push_back({starts[s] + i, starts[s + 1] + j, starts[s + 1] + i});
    }
  }
  const auto lid = [&](double y, std::uint32_t first, bool up) {
    const auto centre = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(Vec3d(0, y, 0).cast<float>());
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t j = (i + 1) % around;
      mesh.triangles.push_back(up ? geometry::Triangle{centre, first + i, first + j}
                                  : geometry::Triangle{centre, first + j, first + i});
    }
  };
  lid(0.0, starts.front(), false);
  lid(length, starts.back(), true);
  return mesh;
}

/// A cylinder of flesh with a chain of joints along its axis. Its skin can be moved by any map of space.
class Column : public testing::Test {
 protected:
  static constexpr std::size_t joints = 8;
  using Map = std::function<Vec3d(const Vec3d&)>;
  using Turn = std::function<Quatd(double y)>;

  Column() : rig_(body(), {0.05, false, human::Skinning::linear}, {}) {}

  static double jointHeight(std::size_t joint) { return length * static_cast<double>(joint) / (joints - 1); }
  static parenting::Body body() {
    parenting::Body made;
    made.skin = cylinder();
    std::vector<human::Joint> chain;
    for (std::size_t j = 0; j < joints; ++j) {
      human::Joint joint{"joint" + std::to_string(j), std::nullopt, {}};
      if (j > 0) {
        joint.parent = human::JointIndex{j - 1};
        joint.rest.translation = {0, length / (joints - 1), 0};
      }
      chain.push_back(joint);
    }
    made.skeleton = human::Skeleton(chain);
    std::vector<human::Influence> influences;
    for (const Vec3f& p : made.skin.positions) {
      const double at = std::clamp(static_cast<double>(p.y()) / length, 0.0, 1.0) * (joints - 1);
      const auto low = std::min(static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(joints - 2));
      influences.push_back({low, 1.0 - (at - low)});
      influences.push_back({low + 1, at - low});
    }
    made.weights = human::normaliseWeights(influences, 2).weights;
    made.regions = human::bodyRegions(made.skin, *made.weights, *made.skeleton);
    return made;
  }

  /// The body with its skin moved by `map`, the joints turned by `turn` where they stand.
  parenting::PosedBody posed(const Map& map, const Turn& turn) const {
    parenting::PosedBody pose;
    for (const Vec3f& p : rig_.body().skin.positions) {
      pose.skin.emplace_back(map(p.cast<double>()).cast<float>());
    }
    for (std::size_t j = 0; j < joints; ++j) {
      const Vec3d rest(0, jointHeight(j), 0);
      RigidTransform carry;
      carry.rotation = turn(jointHeight(j));
      carry.translation = map(rest) - carry.rotation * rest;
      pose.joints.push_back(carry);
    }
    return pose;
  }

  static SoftBody bind(const parenting::BodyRig& rig, const std::vector<const TriangleMesh*>& organs,
                       const SoftBodyOptions& options = {}) {
    std::vector<SoftOrgan> named;
    for (const TriangleMesh* organ : organs) {
      named.push_back({"organ" + std::to_string(named.size()), organ});
    }
    return SoftBody(named, rig, options, {});
  }
  static TriangleMesh moved(const SoftBody& soft, std::size_t organ, const TriangleMesh& rest,
                            const parenting::PosedBody& pose) {
    TriangleMesh result = rest;
    soft.place(organ, rest.positions, soft.settle(pose, {}), pose, result.positions, {});
    return result;
  }

  parenting::BodyRig rig_;
};

/// Turned about the axis, the farther up the more.
Vec3d twisted(const Vec3d& p, double radiansPerMetre) {
  return Eigen::AngleAxisd(radiansPerMetre * (p.y() - length / 2), Vec3d::UnitY()) * p;
}

/// The axis bent to an arc in the y-z plane, cross-sections kept.
Vec3d bent(const Vec3d& p, double radiansPerMetre) {
  const double r = 1.0 / radiansPerMetre;
  const double angle = (p.y() - length / 2) * radiansPerMetre;
  return {p.x(), (r - p.z()) * std::sin(angle), r - (r - p.z()) * std::cos(angle)};
}

Quatd bentTurn(double y, double radiansPerMetre) {
  return Quatd(Eigen::AngleAxisd((y - length / 2) * radiansPerMetre, Vec3d::UnitX()));
}

double change(const TriangleMesh& now, const TriangleMesh& rest) {
  return geometry::signedVolume(now) / geometry::signedVolume(rest) - 1.0;
}

/// Depth of the farthest vertex outside a skin, metres.
double protrusion(const TriangleMesh& organ, const TriangleMesh& skin) {
  const geometry::ClosestPointTree tree(skin);
  double farthest = 0.0;
  for (const Vec3f& p : organ.positions) {
    const double outside = tree.signedDistance(p.cast<double>());
    if (outside > farthest && geometry::windingNumber(skin, p.cast<double>()) < 0.5) {
      farthest = outside;
    }
  }
  return farthest;
}

TEST_F(Column, AtRestEveryOrganKeepsItsBits) {
  TriangleMesh ball = geometry::ellipsoid({0, length / 2, 0}, {0.05, 0.06, 0.05}, 3);
  ball.positions[0].x() = -0.0F;
  const SoftBody soft = bind(rig_, {&ball});
  const std::vector<Vec3f> offsets = soft.settle(rig_.pose(std::nullopt, {}), {});
  EXPECT_EQ(offsets.size(), soft.controlPoints());
  for (const Vec3f& offset : offsets) {
    EXPECT_EQ(offset, Vec3f::Zero());
  }
  const TriangleMesh now = moved(soft, 0, ball, rig_.pose(std::nullopt, {}));
  EXPECT_EQ(std::memcmp(now.positions.data(), ball.positions.data(), ball.positions.size() * sizeof(Vec3f)), 0);
}

TEST_F(Column, RigidMotionMovesTheOrganRigidly) {
  const TriangleMesh ball = geometry::ellipsoid({0.03, 0.3, 0}, {0.05, 0.06, 0.05}, 3);
  const SoftBody soft = bind(rig_, {&ball});
  const Quatd turn(Eigen::AngleAxisd(2.5, Vec3d(1, 2, 3).normalized()));
  const Vec3d offset(1.0, -0.5, 2.0);
  const auto map = [&](const Vec3d& p) -> Vec3d { return turn * p + offset; };
  const TriangleMesh now = moved(soft, 0, ball, posed(map, [&](double) { return turn; }));
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    EXPECT_LT((now.positions[v].cast<double>() - map(ball.positions[v].cast<double>())).norm(), 2e-5);
  }
}

TEST_F(Column, ATwistedColumnTurnsTheBallInsideByTheTwistWhereItIs) {
  const TriangleMesh ball = geometry::ellipsoid({0, 0.45, 0}, {0.06, 0.06, 0.06}, 3);
  const SoftBody soft = bind(rig_, {&ball});
  const double perMetre = std::numbers::pi / 2 / length;
  const auto map = [&](const Vec3d& p) { return twisted(p, perMetre); };
  const auto turn = [&](double y) { return Quatd(Eigen::AngleAxisd(perMetre * (y - length / 2), Vec3d::UnitY())); };
  const TriangleMesh now = moved(soft, 0, ball, posed(map, turn));
  // Torsion leaves every cross-section as it is, so the volume and, about the axis, the centre stay.
  EXPECT_LT((geometry::centroid(now) - geometry::centroid(ball)).norm(), 5e-4);
  EXPECT_LT(std::abs(change(now, ball)), 0.005);
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    // Stiffer than the flesh around it, the ball is twisted a little less than a column of flesh alone.
    EXPECT_LT((now.positions[v].cast<double>() - map(ball.positions[v].cast<double>())).norm(), 3e-3);
  }
}

TEST_F(Column, ABentColumnCarriesTheBallInsideToItsPlaceOnTheArc) {
  const TriangleMesh ball = geometry::ellipsoid({0, 0.5, 0}, {0.05, 0.05, 0.05}, 3);
  const SoftBody soft = bind(rig_, {&ball});
  for (const double degrees : {30.0, 60.0, 90.0, 120.0}) {
    const double perMetre = degrees * std::numbers::pi / 180.0 / length;
    const auto map = [&](const Vec3d& p) { return bent(p, perMetre); };
    const auto turn = [&](double y) { return bentTurn(y, perMetre); };
    const parenting::PosedBody pose = posed(map, turn);
    const TriangleMesh now = moved(soft, 0, ball, pose);
    // Stiffer than the flesh around it, the ball gives way a little to the outer side, where there is more room.
    EXPECT_LT((geometry::centroid(now) - map({0, 0.5, 0})).norm(), 1e-4 * degrees) << degrees;
    EXPECT_LT(std::abs(change(now, ball)), 0.01) << degrees;
    EXPECT_EQ(latticeQuality(soft.embedding(0), soft.settle(pose, {})).inverted, 0U) << degrees;
  }
}

TEST_F(Column, TheFleshGivesWayWhereTheSkinIsSqueezedNotTheOrgan) {
  const TriangleMesh ball = geometry::ellipsoid({0, 0.4, 0}, {0.05, 0.06, 0.05}, 3);
  const SoftBody soft = bind(rig_, {&ball});
  const auto map = [](const Vec3d& p) -> Vec3d { return {0.85 * p.x(), p.y(), 0.9 * p.z()}; };
  const parenting::PosedBody pose = posed(map, [](double) { return Quatd::Identity(); });
  const TriangleMesh now = moved(soft, 0, ball, pose);
  EXPECT_LT(std::abs(change(now, ball)), 0.02);
}

TEST_F(Column, WhereTheSkinLeavesNoRoomTheOrganShrinksInsteadOfComingOut) {
  TriangleMesh filling = rig_.body().skin;
  for (Vec3f& p : filling.positions) {
    p = 0.97F * (p - Vec3f(0, 0.4F, 0)) + Vec3f(0, 0.4F, 0);
  }
  const SoftBody soft = bind(rig_, {&filling});
  const auto map = [](const Vec3d& p) -> Vec3d { return {0.85 * p.x(), p.y(), 0.85 * p.z()}; };
  const parenting::PosedBody pose = posed(map, [](double) { return Quatd::Identity(); });
  const TriangleMesh now = moved(soft, 0, filling, pose);
  EXPECT_LT(protrusion(now, {pose.skin, rig_.body().skin.triangles}), 1e-3);
  EXPECT_LT(change(now, filling), -0.05);
}

/// Any bend and twist of a column with a ball anywhere inside it, down to 3 mm under the skin.
struct AnyColumn {
  Vec3d centre;
  Vec3d size;
  double bend;   // radians a metre
  double twist;  // radians a metre
  double side;   // radians: direction of the bend

  static AnyColumn draw(double largestBend) {
    const auto within = [](double low, double high) {
      return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
    };
    AnyColumn any{};
    any.size = {within(0.02, 0.06), within(0.02, 0.1), within(0.02, 0.06)};
    const double room = radius * std::cos(std::numbers::pi / 36) - 0.003 - any.size.head<3>().maxCoeff();
    const double from = std::max(0.0, room) * within(0.0, 1.0);
    const double around = within(0.0, 2.0 * std::numbers::pi);
    any.centre = {from * std::sin(around), within(0.2, 0.6), from * std::cos(around)};
    any.bend = within(0.05, largestBend);
    any.twist = within(-2.5, 2.5);
    any.side = within(0.0, 2.0 * std::numbers::pi);
    return any;
  }
  Vec3d map(const Vec3d& p) const {
    const Eigen::AngleAxisd turn(side, Vec3d::UnitY());
    return turn * bent(turn.inverse() * twisted(p, twist), bend);
  }
  Quatd turn(double y) const {
    const Quatd round(Eigen::AngleAxisd(side, Vec3d::UnitY()));
    return round * bentTurn(y, bend) * round.conjugate() *
           Quatd(Eigen::AngleAxisd(twist * (y - length / 2), Vec3d::UnitY()));
  }
};

RC_GTEST_FIXTURE_PROP(Column, InAnySmoothBendABallStaysInsideAndKeepsItsVolume, ()) {
  const AnyColumn any = AnyColumn::draw(3.0);
  const TriangleMesh ball = geometry::ellipsoid(any.centre, any.size, 2);
  const SoftBody soft = bind(rig_, {&ball}, coarse);
  const auto pose = posed([&](const Vec3d& p) { return any.map(p); }, [&](double y) { return any.turn(y); });
  const TriangleMesh now = moved(soft, 0, ball, pose);
  RC_LOG() << "centre " << any.centre.transpose() << " size " << any.size.transpose() << " bend " << any.bend
           << " twist " << any.twist << " volume " << change(now, ball) << " out "
           << protrusion(now, {pose.skin, rig_.body().skin.triangles});
  RC_ASSERT(protrusion(now, {pose.skin, rig_.body().skin.triangles}) < 1e-3);
  RC_ASSERT(std::abs(change(now, ball)) < 0.02);
  RC_ASSERT(latticeQuality(soft.embedding(0), soft.settle(pose, {})).inverted == 0U);
}

/// Up to a full circle, where the column's ends pass through each other. Sharper than 1 / radius, the map itself would
/// turn the flesh on the inner side inside out.
RC_GTEST_FIXTURE_PROP(Column, InAnyFoldABallStaysInsideAndInOnePiece, ()) {
  const AnyColumn any = AnyColumn::draw(8.0);
  const TriangleMesh ball = geometry::ellipsoid(any.centre, any.size, 2);
  const SoftBody soft = bind(rig_, {&ball}, coarse);
  const auto pose = posed([&](const Vec3d& p) { return any.map(p); }, [&](double y) { return any.turn(y); });
  const TriangleMesh now = moved(soft, 0, ball, pose);
  RC_LOG() << "centre " << any.centre.transpose() << " size " << any.size.transpose() << " bend " << any.bend
           << " twist " << any.twist << " volume " << change(now, ball) << " out "
           << protrusion(now, {pose.skin, rig_.body().skin.triangles});
  RC_ASSERT(protrusion(now, {pose.skin, rig_.body().skin.triangles}) < 1e-3);
  RC_ASSERT(std::abs(change(now, ball)) < 0.2);
}

TEST_F(Column, OrgansThatTouchMoveAlikeWhereTheyTouch) {
  // Two balls that share half their vertices' places: whatever happens, those places stay common.
  const TriangleMesh left = geometry::ellipsoid({0, 0.4, 0}, {0.06, 0.06, 0.06}, 3);
  TriangleMesh right = left;
  for (Vec3f& p : right.positions) {
    p.x() = p.x() > 0.0F ? 0.5F * p.x() : p.x();
  }
  const SoftBody soft = bind(rig_, {&left, &right});
  const parenting::PosedBody pose =
      posed([](const Vec3d& p) { return bent(twisted(p, 1.5), 1.8); }, [](double y) { return bentTurn(y, 1.8); });
  const TriangleMesh nowLeft = moved(soft, 0, left, pose);
  const TriangleMesh nowRight = moved(soft, 1, right, pose);
  for (std::size_t v = 0; v < left.positions.size(); ++v) {
    if (left.positions[v] == right.positions[v]) {
      EXPECT_EQ(nowLeft.positions[v], nowRight.positions[v]);
    }
  }
}

TEST_F(Column, APoseHasOneAnswerAtAnyNumberOfThreadsAndInAnyOrder) {
  const TriangleMesh ball = geometry::ellipsoid({0.02, 0.4, 0}, {0.06, 0.1, 0.05}, 3);
  const SoftBody one = SoftBody(std::vector<SoftOrgan>{{"ball", &ball}}, rig_, {}, {1});
  const SoftBody many = SoftBody(std::vector<SoftOrgan>{{"ball", &ball}}, rig_, {}, {7});
  const auto pose = posed([](const Vec3d& p) { return bent(p, 1.5); }, [](double y) { return bentTurn(y, 1.5); });
  const auto other = posed([](const Vec3d& p) { return twisted(p, 2.0); }, [](double) { return Quatd::Identity(); });
  const std::vector<Vec3f> expected = one.settle(pose, {1});
  EXPECT_EQ(many.settle(pose, {5}), expected);
  EXPECT_NE(many.settle(other, {2}), expected);
  EXPECT_EQ(many.settle(pose, {2}), expected);
}

TEST_F(Column, TheOrganFollowsThePoseWithoutJumps) {
  const TriangleMesh ball = geometry::ellipsoid({0.02, 0.4, 0}, {0.06, 0.1, 0.05}, 2);
  const SoftBody soft = bind(rig_, {&ball}, coarse);
  const auto at = [&](double degrees) {
    const double perMetre = degrees * std::numbers::pi / 180.0 / length;
    return moved(
        soft, 0, ball,
        posed([&](const Vec3d& p) { return bent(p, perMetre); }, [&](double y) { return bentTurn(y, perMetre); }));
  };
  TriangleMesh before = at(0.5);
  for (double degrees = 1.5; degrees <= 150.0; degrees += 1.0) {
    const TriangleMesh now = at(degrees);
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
      // Half the column's length times a degree, and as much again.
      EXPECT_LT((now.positions[v] - before.positions[v]).norm(), 0.014F) << degrees;
    }
    before = now;
  }
}

TEST_F(Column, WhatIsNoOrganInABodyStillComesOutUsable) {
  const TriangleMesh ball = geometry::ellipsoid({0, 0.4, 0}, {0.05, 0.06, 0.05}, 2);
  const TriangleMesh outside = geometry::ellipsoid({0.5, 0.4, 0}, {0.05, 0.05, 0.05}, 2);
  const TriangleMesh huge = geometry::ellipsoid({0, 0.4, 0}, {0.4, 0.6, 0.4}, 3);
  TriangleMesh triangle;
  triangle.positions = {{0, 0.3F, 0}, {0.01F, 0.3F, 0}, {0, 0.31F, 0}};
  triangle.triangles = {{0, 1, 2}};
  TriangleMesh open = ball;
  open.triangles.resize(open.triangles.size() / 2);
  const auto pose = posed([](const Vec3d& p) { return bent(p, 1.5); }, [](double y) { return bentTurn(y, 1.5); });
  const std::vector<const TriangleMesh*> organs{&ball, &outside, &huge, &triangle, &open};
  const SoftBody soft = bind(rig_, organs, {0.04, 0.08, 20000, 5});
  for (std::size_t o = 0; o < organs.size(); ++o) {
    const TriangleMesh now = moved(soft, o, *organs[o], pose);
    for (const Vec3f& p : now.positions) {
      ASSERT_TRUE(p.allFinite() && p.norm() < 3.0F) << o;
    }
  }
  EXPECT_LT((geometry::centroid(moved(soft, 0, ball, pose)) - bent({0, 0.4, 0}, 1.5)).norm(), 0.02);
}

TEST_F(Column, OrgansThatTakeTooMuchRoomGetLargerCellsAndANoteSaysSo) {
  const TriangleMesh huge = geometry::ellipsoid({0, 0.4, 0}, {0.4, 0.6, 0.4}, 2);
  const SoftBody soft = bind(rig_, {&huge}, {0.03, 0.05, 500, 1});
  EXPECT_LE(soft.cells(), 500U);
  ASSERT_EQ(soft.issues().size(), 1U);
  EXPECT_NE(soft.issues()[0].text.find("instead of 30 mm"), std::string::npos);
  EXPECT_TRUE(bind(rig_, {&huge}, {0.2, 0.05, 500, 1}).issues().empty());
}

}  // namespace
}  // namespace lorica::viscera
