#pragma once

/// \file
/// An armor piece made ready to follow the body. Armor lies outside the skin, so three rays from it are no use: a rigid
/// piece is carried by the interior site nearest to it or by all the skin under it, a soft one follows the skin.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lorica/geometry/smoothing.h"
#include "lorica/parenting/body_rig.h"

namespace lorica::armor {

enum class Carriage {
  rigid,   ///< plates, helmets: as one, by what RigidCarrier says
  skinned  ///< soft armor: by skin weights, its own or those of the nearest skin
};

/// Where soft armor with weights of its own lies in a pose.
enum class SoftFit {
  asWeighted,  ///< where its weights take it
  heldOff      ///< held off the skin under it too, as posePiece() says
};

/// The triangle of the skin that a vertex of a soft piece lies over at rest, and those about it.
struct SkinFoot {
  geometry::Triangle corners{};   ///< vertices of the skin
  float least = 0.0F;             ///< m, over the triangle's plane in a pose
  std::uint32_t aboutFirst = 0;   ///< of PieceRig::about
  std::uint32_t aboutBehind = 0;  ///< behind the last of them
  std::uint32_t feltFirst = 0;    ///< of PieceRig::felt
  std::uint32_t feltBehind = 0;   ///< behind the last of them
};

/// A place of the skin under a plate.
struct SkinUnder {
  geometry::Triangle corners{};    ///< vertices of the skin
  std::array<double, 3> shares{};  ///< of them, barycentric
  geometry::Vec3d rest = geometry::Vec3d::Zero();
  double weight = 0.0;  ///< share of the skin that carries the plate
  double play = 0.0;    ///< m, by which the plate is further off here at rest than where it is nearest
};

enum class CarriedBy {
  site,  ///< the interior site nearest to it, its offset turning with the site's frame
  skin   ///< all the skin under it, as posePiece() says; the site where less than three places of the skin are
};

/// What carries a rigid piece.
struct RigidCarrier {
  CarriedBy by = CarriedBy::site;
  /// The site is that nearest to this point, the same for pieces that move as one; to the piece's centroid where none
  /// is given.
  std::optional<geometry::Vec3d> at;
  /// The skin is that under this mesh, outside the skin at rest, which the piece is fixed to; under the piece itself
  /// where none is given.
  const geometry::TriangleMesh* plate = nullptr;
};

/// Immutable.
struct PieceRig {
  geometry::TriangleMesh rest;  ///< protecting parts only
  Carriage carriage = Carriage::rigid;
  std::size_t site = 0;                                ///< index into BodyRig::sites(), for rigid pieces
  bool hasSite = false;                                ///< false when the body has no site: the piece stays
  std::vector<SkinUnder> under;                        ///< what carries a rigid piece instead of its site; else none
  geometry::Vec3d outwards = geometry::Vec3d::Zero();  ///< off that skin, unit
  std::optional<human::SkinWeights> weights;           ///< for skinned pieces
  std::vector<geometry::Vec3f> centres;   ///< of human::skin(), those of the nearest skin; none when it has none
  std::vector<SkinFoot> feet;             ///< one per vertex of a piece that is held off the skin; else none
  std::vector<geometry::Triangle> about;  ///< the skin about the feet that are near to it
  std::vector<std::uint32_t> felt;        ///< vertices of the skin among those, by which is known where it rises
  geometry::SurfaceNeighbours around;     ///< of the vertices of such a piece
  base::Issues issues;
};

/// Binds a piece.
/// \param ownWeights weights that came with the mesh, on `ownSkeleton`; used when every joint they name is a joint of
///        the body (matched by name), else the nearest skin's weights are taken and an issue says so
/// \param carrier of a rigid piece
/// \param fit of a piece with weights of its own; one that takes the skin's is held off
/// \pre rest is not empty
PieceRig bindPiece(geometry::TriangleMesh rest, const std::string& name, Carriage carriage,
                   const parenting::BodyRig& body, const human::SkinWeights* ownWeights,
                   const human::Skeleton* ownSkeleton, base::Threads threads, const RigidCarrier& carrier = {},
                   SoftFit fit = SoftFit::asWeighted);

/// The piece's vertices in a pose; at rest every vertex keeps its bits. A soft piece goes where its weights take it.
/// Where that is nearer to the skin than its fabric lets itself be pressed, by three tenths of its height at rest or
/// 2 mm, it is lifted off the triangle of the skin it lies over at rest; where the skin about that triangle has come
/// nearer than 1.8 mm, off that. Its surroundings are lifted along with it. Skin of elsewhere, a lowered arm, does not
/// push it.
/// A rigid piece carried by the skin takes the motion that fits the places of the skin under it best (least squares,
/// Kabsch 1976), and then moves along the plate's axis until none of them is nearer to it than the nearest was at rest.
void posePiece(const PieceRig& piece, const parenting::PosedBody& pose, std::span<geometry::Vec3f> posed,
               base::Threads threads);

}  // namespace lorica::armor
