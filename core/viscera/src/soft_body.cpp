#include "lorica/viscera/soft_body.h"

#include <algorithm>
#include <cmath>

#include "cell_block.h"
#include "lorica/base/error.h"

namespace lorica::viscera {

using geometry::RigidTransform;
using geometry::Vec3d;
using geometry::Vec3f;
using Mat3f = Eigen::Matrix3f;

namespace {

/// Turns of the joints as quaternions x, y, z, w, each on the side of its parent's, less that of no turn: their blend
/// takes the turn that the joints between them made, and is exactly zero at rest.
std::vector<Vec4f> jointTurns(const std::vector<RigidTransform>& joints, const std::vector<std::int64_t>& parents) {
  std::vector<Eigen::Vector4d> sided(joints.size());
  std::vector<Vec4f> turns(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    sided[j] = joints[j].rotation.coeffs();
    const double side = parents[j] < 0 ? sided[j].w() : sided[j].dot(sided[static_cast<std::size_t>(parents[j])]);
    if (side < 0.0) {
      sided[j] = -sided[j];
    }
    turns[j] = (sided[j] - Eigen::Vector4d::UnitW()).cast<float>();
  }
  return turns;
}

constexpr int kTurnSteps = 3;

}  // namespace

/// The state of one pose while it settles.
struct SoftBody::Settling {
  const Parts& parts;
  base::Threads threads;
  std::vector<Vec4f> pulls;    ///< of skin and joints, per control point
  std::vector<Vec4f> turns;    ///< per cell
  std::vector<Edges> wanted;   ///< per cell: what its edges along x, y, z should do, times its stiffness
  std::vector<Vec4f> forces;   ///< right-hand side
  std::vector<Vec4f> offsets;  ///< the solution
  Eigen::VectorXd pressures;
  std::vector<Mat3f> wideness;  ///< per organ part: how its volume grows with its deformation
  std::vector<float> excess;    ///< per organ part: volume gained, m3

  void start(const parenting::PosedBody& pose);
  Vec3f offset(std::uint32_t point) const { return offsets[point].head<3>(); }
  void turnCells(int steps);
  void press();
  void gather();
};

void SoftBody::Settling::start(const parenting::PosedBody& pose) {
  const std::size_t points = parts.points.size();
  pulls.assign(points, Vec4f::Zero());
  offsets.assign(points, Vec4f::Zero());
  forces.resize(points);
  wanted.resize(parts.cells.size());
  wideness.resize(parts.organParts.size());
  excess.resize(parts.organParts.size());
  pressures = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parts.organs));
  std::vector<Vec4f> moved(parts.skin.size());
  base::parallelFor(moved.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SkinPull& pull = parts.skin[i];
      moved[i] << pull.strength * (pose.skin[pull.vertex] - pull.rest), 0.0F;
    }
  });
  base::parallelFor(points, 512, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      for (std::uint32_t i = parts.firstPull[p]; i < parts.firstPull[p + 1]; ++i) {
        pulls[p] += parts.pullsOfPoint[i].weight * moved[parts.pullsOfPoint[i].pull];
      }
      const JointBlend& blend = parts.pointJoints[p];
      for (std::size_t k = 0; k < JointBlend::limit; ++k) {
        const RigidTransform& carry = pose.joints[blend.joint[k]];
        if (blend.weight[k] > 0.0F && !carry.isIdentity()) {
          const Vec3d carried = carry * parts.points[p] - parts.points[p];
          pulls[p].head<3>() += kHold * blend.weight[k] * carried.cast<float>();
        }
      }
    }
  });
  const std::vector<Vec4f> joints = jointTurns(pose.joints, parts.parentJoint);
  turns.resize(parts.cells.size());
  for (std::size_t c = 0; c < turns.size(); ++c) {
    turns[c] = Vec4f::UnitW();
    for (std::size_t k = 0; k < JointBlend::limit; ++k) {
      turns[c] += parts.cellJoints[c].weight[k] * joints[parts.cellJoints[c].joint[k]];
    }
    turns[c].normalize();
  }
}

/// Local step: every cell's turn follows its deformation, and says what the cell wants of its corners.
void SoftBody::Settling::turnCells(int steps) {
  const auto cell = static_cast<float>(parts.cell);
  const std::size_t blocks = (parts.cells.size() + CellBlock::size - 1) / CellBlock::size;
  base::parallelFor(blocks, 16, threads, [&](std::size_t firstBlock, std::size_t endBlock) {
    CellBlock block;
    const std::size_t end = std::min(endBlock * CellBlock::size, parts.cells.size());
    for (std::size_t first = firstBlock * CellBlock::size; first < end; first += CellBlock::size) {
      const std::size_t count = std::min(CellBlock::size, end - first);
      for (std::size_t lane = 0; lane < CellBlock::size; ++lane) {
        // The last block is filled up with its last cell.
        const std::size_t c = first + std::min(lane, count - 1);
        block.setTurn(lane, turns[c]);
        std::array<Vec3f, 8> corners;
        for (std::size_t k = 0; k < 8 && steps > 0; ++k) {
          corners[k] = offset(parts.cells[c][k]);
        }
        if (steps > 0) {
          block.setDeformation(lane, corners, cell);
        }
      }
      block.rotate();
      for (int step = 0; step < steps; ++step) {
        block.follow();
      }
      for (std::size_t lane = 0; lane < count; ++lane) {
        turns[first + lane] = block.turnOf(lane);
        wanted[first + lane] = block.wanted(lane, parts.stiffness[first + lane] * cell / 4.0F);
      }
    }
  });
}

/// Sets the pressures that make up for the volume the organs lack.
void SoftBody::Settling::press() {
  base::parallelFor(parts.organParts.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const OrganPart& part = parts.organParts[i];
      Mat3f f = Mat3f::Identity();
      for (std::size_t c = 0; c < 8; ++c) {
        f += offset(parts.cells[part.cell][c]) * part.cornerSlopes[c].transpose();
      }
      wideness[i] << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
      excess[i] = part.volume * (f.col(0).dot(wideness[i].col(0)) - 1.0F);
    }
  });
  Eigen::VectorXd lacking = Eigen::VectorXd::Zero(pressures.size());
  for (std::size_t i = 0; i < excess.size(); ++i) {
    lacking[parts.organParts[i].organ] -= static_cast<double>(excess[i]);
  }
  const double limit = kPressureLimit / parts.cell;
  pressures = (pressures + parts.pressureFor * lacking).cwiseMax(-limit).cwiseMin(limit);
}

/// Everything that acts on the control points.
void SoftBody::Settling::gather() {
  base::parallelFor(forces.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      Vec4f sum = pulls[p];
      for (std::size_t c = 0; c < 8; ++c) {
        if (parts.cellsOfPoint[p][c] != Parts::kNone) {
          const Edges& edges = wanted[parts.cellsOfPoint[p][c]];
          for (std::size_t axis = 0; axis < 3; ++axis) {
            sum += (cornerDigits[c][axis] != 0 ? 1.0F : -1.0F) * edges.col(static_cast<Eigen::Index>(axis));
          }
        }
      }
      forces[p] = sum;
    }
  });
  for (std::size_t i = 0; i < parts.organParts.size(); ++i) {
    const OrganPart& part = parts.organParts[i];
    const auto pressure = static_cast<float>(pressures[part.organ]);
    if (pressure == 0.0F) {
      continue;
    }
    const Mat3f push = pressure * part.volume * wideness[i];
    for (std::size_t c = 0; c < 8; ++c) {
      forces[parts.cells[part.cell][c]].head<3>() += push * part.cornerSlopes[c];
    }
  }
}

SoftBody::~SoftBody() = default;
SoftBody::SoftBody(SoftBody&&) noexcept = default;
SoftBody& SoftBody::operator=(SoftBody&&) noexcept = default;

std::vector<Vec3f> SoftBody::settle(const parenting::PosedBody& pose, base::Threads threads) const {
  const Parts& parts = *parts_;
  LORICA_CHECK(pose.joints.size() == parts.parentJoint.size(), "a pose of the body the organs were bound to");
  Settling settling{parts, threads, {}, {}, {}, {}, {}, {}, {}, {}};
  settling.start(pose);
  settling.turnCells(0);
  settling.gather();
  parts.solver.solve(settling.forces, settling.offsets);
  for (int round = 0; round < parts.rounds; ++round) {
    settling.turnCells(kTurnSteps);
    settling.press();
    settling.gather();
    parts.solver.solve(settling.forces, settling.offsets);
  }
  std::vector<Vec3f> offsets(parts.points.size());
  for (std::size_t p = 0; p < offsets.size(); ++p) {
    offsets[p] = settling.offset(static_cast<std::uint32_t>(p));
  }
  return offsets;
}

Depth depthUnder(const SkinGuard& guard, std::span<const Vec3f> skin, const Vec3f& vertex) {
  const Vec3f& a = skin[guard.corners[0]];
  const Vec3f& b = skin[guard.corners[1]];
  const Vec3f& c = skin[guard.corners[2]];
  const Vec3f outwards = (b - a).cross(c - a).normalized();
  const Vec3f over = guard.barycentric[0] * a + guard.barycentric[1] * b + guard.barycentric[2] * c;
  const float depth = outwards.dot(over - vertex);
  return {depth, (over - vertex - depth * outwards).norm(), outwards};
}

void SoftBody::place(std::size_t organ, std::span<const Vec3f> rest, std::span<const Vec3f> offsets,
                     const parenting::PosedBody& pose, std::span<Vec3f> posed, base::Threads threads) const {
  const Embedding& embedding = parts_->embeddings.at(organ);
  LORICA_CHECK(offsets.size() == parts_->points.size(), "the offsets of settle()");
  deform(rest, embedding, offsets, posed, threads);
  const std::vector<SkinGuard>& guards = parts_->guards[organ];
  base::parallelFor(guards.size(), 2048, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      Vec3f& vertex = posed[guards[g].vertex];
      const Depth depth = depthUnder(guards[g], pose.skin, vertex);
      // The farther the vertex slid along the skin, the less that place tells of the skin over it.
      const float least = guards[g].least - std::max(0.0F, depth.aside - guards[g].aside);
      if (depth.metres < least) {
        vertex -= (least - depth.metres) * depth.outwards;
      }
    }
  });
}

const Embedding& SoftBody::embedding(std::size_t organ) const {
  return parts_->embeddings.at(organ);
}

double SoftBody::cell() const {
  return parts_->cell;
}

std::size_t SoftBody::cells() const {
  return parts_->cells.size();
}

std::size_t SoftBody::controlPoints() const {
  return parts_->points.size();
}

const base::Issues& SoftBody::issues() const {
  return parts_->issues;
}

}  // namespace lorica::viscera
