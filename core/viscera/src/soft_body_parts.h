#pragma once

#include "lorica/viscera/soft_body.h"
#include "sparse_solver.h"

namespace lorica::viscera {

using Corners = std::array<std::uint32_t, 8>;

/// How stiff a cell of flesh is; one that organs fill is 1.
inline constexpr float kFlesh = 0.2F;
/// How hard a cell's share of skin pulls.
inline constexpr float kSkin = 15.0F;
/// How hard the joints hold each control point: enough to tell where the body goes that no skin holds.
inline constexpr float kHold = 1e-3F;
/// The strain of a filled cell that an organ's pressure may work against.
inline constexpr double kPressureLimit = 1.5;
/// Vertices that lie deeper than this at rest are not held back from the skin, metres.
inline constexpr double kGuarded = 0.02;
/// How deep below the skin vertices are held that were not nearer at rest, metres.
inline constexpr float kLeastDepth = 1e-3F;

/// Which joints carry a place of the body, and how much each.
struct JointBlend {
  static constexpr std::size_t limit = 4;
  std::array<std::uint32_t, limit> joint{};
  std::array<float, limit> weight{};  ///< sum 1
};

/// A vertex of the skin, embedded in the lattice.
struct SkinPull {
  std::uint32_t vertex = 0;
  std::uint32_t cell = 0;
  float strength = 0.0F;
  geometry::Vec3f fraction = geometry::Vec3f::Zero();
  geometry::Vec3f rest = geometry::Vec3f::Zero();
};

/// What a control point takes from a pull of the skin.
struct PointPull {
  std::uint32_t pull = 0;
  float weight = 0.0F;
};

/// The place on the skin under which an organ's vertex lies.
struct SkinGuard {
  std::uint32_t vertex = 0;      ///< of the organ
  geometry::Triangle corners{};  ///< of the skin
  geometry::Vec3f barycentric = geometry::Vec3f::Zero();
  float least = 0.0F;  ///< depth below the skin that the vertex keeps, metres
  float aside = 0.0F;  ///< how far it lies beside the place at rest, metres
};

/// Where a vertex lies below the place on the skin that guards it.
struct Depth {
  float metres = 0.0F;  ///< square to the skin there
  float aside = 0.0F;   ///< along it
  geometry::Vec3f outwards = geometry::Vec3f::Zero();
};
Depth depthUnder(const SkinGuard& guard, std::span<const geometry::Vec3f> skin, const geometry::Vec3f& vertex);

/// The part of a closed organ that lies in one cell: a sample of its volume.
struct OrganPart {
  std::uint32_t organ = 0;
  std::uint32_t cell = 0;
  float volume = 0.0F;                          ///< m3 at rest
  std::array<geometry::Vec3f, 8> cornerSlopes;  ///< of the corners' weights at its centroid, per metre
};

struct SoftBody::Parts {
  double cell = 0.0;  ///< edge length, metres
  std::vector<Corners> cells;
  std::vector<float> stiffness;         ///< per cell
  std::vector<JointBlend> cellJoints;   ///< per cell
  std::vector<geometry::Vec3d> points;  ///< control points at rest
  std::vector<Corners> cellsOfPoint;    ///< the cell in which a point is corner c; none: kNone
  std::vector<JointBlend> pointJoints;  ///< per control point
  std::vector<Embedding> embeddings;    ///< per organ
  std::vector<SkinPull> skin;
  std::vector<std::uint32_t> firstPull;  ///< of each control point in pullsOfPoint, and the end
  std::vector<PointPull> pullsOfPoint;
  std::vector<std::vector<SkinGuard>> guards;  ///< per organ
  std::vector<OrganPart> organParts;
  std::size_t organs = 0;
  Eigen::MatrixXd pressureFor;            ///< pressures per m3 of volume that organs lack, at rest
  std::vector<std::int64_t> parentJoint;  ///< -1 for a root
  int rounds = 0;
  SparseSolver solver;
  base::Issues issues;

  static constexpr std::uint32_t kNone = UINT32_MAX;
};

/// Trilinear weights of the corners at a place in a cell.
std::array<float, 8> cornerWeights(const geometry::Vec3f& fraction);
/// Their derivatives by the place at rest, per metre.
std::array<geometry::Vec3f, 8> cornerSlopes(const geometry::Vec3f& fraction, float cell);

}  // namespace lorica::viscera
