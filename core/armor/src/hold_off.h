#pragma once

/// \file
/// Soft pieces held off the skin under them.

#include <functional>
#include <span>

#include "lorica/armor/piece_rig.h"

namespace lorica::armor {

/// Nothing is lower: a vertex with this least height is never lifted.
inline constexpr float kAnyHeight = -1e6F;

/// Of a point over the plane of a triangle, m.
float heightOver(const geometry::Triangle& corners, const geometry::Vec3f& p, std::span<const geometry::Vec3f> skin);

/// Puts the vertices on their triangles of the skin.
/// \param triangles under each vertex, of `skin`
/// \param least height of each vertex over the skin
/// \param carries whether a triangle of the skin moves with a vertex
void setFeet(PieceRig& piece, std::span<const std::uint32_t> triangles, std::span<const float> least,
             const geometry::TriangleMesh& skin,
             const std::function<bool(std::size_t vertex, std::uint32_t triangle)>& carries);

/// Lifts what lies too near to the skin under it.
void holdOff(const PieceRig& piece, std::span<const geometry::Vec3f> skin, std::span<geometry::Vec3f> posed,
             base::Threads threads);

}  // namespace lorica::armor
