#include "lorica/geometry/weld.h"

#include <bit>
#include <utility>

#include "lorica/base/error.h"

namespace lorica::geometry {

namespace {

std::uint64_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0F);  // + 0 turns -0 into 0
}

std::size_t hash(const Vec3f& p, std::uint32_t group) {
  std::uint64_t h = 0x9E3779B97F4A7C15ULL;
  for (const std::uint64_t words : {bits(p.x()) << 32U | bits(p.y()), bits(p.z()) << 32U | group}) {
    h = (h ^ words) * 0xD6E8FEB86659FD93ULL;
    h ^= h >> 32U;
  }
  return static_cast<std::size_t>(h);
}

}  // namespace

Welded weld(TriangleMesh mesh, std::span<const std::uint32_t> group) {
  LORICA_CHECK(group.empty() || group.size() == mesh.positions.size(), "one group per vertex");
  constexpr std::uint32_t empty = UINT32_MAX;
  const auto groupOf = [&](std::size_t v) { return group.empty() ? 0U : group[v]; };
  Welded result;
  std::vector<std::uint32_t>& sourceOf = result.sourceOf;
  sourceOf.reserve(mesh.positions.size());
  std::vector<std::uint32_t> keptAs(mesh.positions.size());
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * mesh.positions.size() + 1), empty);  // open addressing
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& p = mesh.positions[v];
    std::size_t at = hash(p, groupOf(v)) & (slots.size() - 1);
    while (slots[at] != empty &&
           (mesh.positions[sourceOf[slots[at]]] != p || groupOf(sourceOf[slots[at]]) != groupOf(v))) {
      at = (at + 1) & (slots.size() - 1);
    }
    if (slots[at] == empty) {
      slots[at] = static_cast<std::uint32_t>(sourceOf.size());
      sourceOf.push_back(static_cast<std::uint32_t>(v));
    }
    keptAs[v] = slots[at];
  }
  // Kept vertices and triangles move down within their arrays.
  for (std::size_t kept = 0; kept < sourceOf.size() && sourceOf.size() < mesh.positions.size(); ++kept) {
    mesh.positions[kept] = mesh.positions[sourceOf[kept]];
  }
  mesh.positions.resize(sourceOf.size(), Vec3f::Zero());
  std::size_t whole = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle welded{keptAs[triangle[0]], keptAs[triangle[1]], keptAs[triangle[2]]};
    if (welded[0] != welded[1] && welded[1] != welded[2] && welded[2] != welded[0]) {
      mesh.triangles[whole++] = welded;
    }
  }
  result.droppedTriangles = mesh.triangles.size() - whole;
  mesh.triangles.resize(whole);
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace lorica::geometry
