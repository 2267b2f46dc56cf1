#pragma once

/// \file
/// An armor piece made ready to follow the body. Armor lies outside the skin, so three rays from it are no use: a rigid
/// piece is carried by the interior site nearest to it, a soft one follows the skin.

#include <optional>
#include <string>

#include "lorica/parenting/body_rig.h"

namespace lorica::armor {

enum class Carriage {
  rigid,   ///< plates, helmets: by the nearest interior site, the offset turning with its frame
  skinned  ///< soft armor: by skin weights, its own or those of the nearest skin
};

/// Immutable.
struct PieceRig {
  geometry::TriangleMesh rest;  ///< protecting parts only
  Carriage carriage = Carriage::rigid;
  std::size_t site = 0;                       ///< index into BodyRig::sites(), for rigid pieces
  bool hasSite = false;                       ///< false when the body has no site: the piece stays
  std::optional<human::SkinWeights> weights;  ///< for skinned pieces
  std::vector<geometry::Vec3f> centres;       ///< of human::skin(), those of the nearest skin; none when it has none
  base::Issues issues;
};

/// Binds a piece.
/// \param ownWeights weights that came with the mesh, on `ownSkeleton`; used when every joint they name is a joint of
///        the body (matched by name), else the nearest skin's weights are taken and an issue says so
/// \pre rest is not empty
PieceRig bindPiece(geometry::TriangleMesh rest, const std::string& name, Carriage carriage,
                   const parenting::BodyRig& body, const human::SkinWeights* ownWeights,
                   const human::Skeleton* ownSkeleton, base::Threads threads);

/// What a pose gives soft pieces; the same for all of them.
human::SkinningDeltas pieceDeltas(const parenting::BodyRig& body, const std::optional<human::Pose>& pose);

/// The piece's vertices in a pose; at rest every vertex keeps its bits.
/// \param deltas of pieceDeltas() for the same pose
void posePiece(const PieceRig& piece, const parenting::PosedBody& pose, const human::SkinningDeltas& deltas,
               std::span<geometry::Vec3f> posed, base::Threads threads);

}  // namespace lorica::armor
