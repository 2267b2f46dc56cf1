#include "lorica/geometry/weld.h"

#include <bit>
#include <unordered_map>

#include "lorica/base/error.h"

namespace lorica::geometry {

namespace {

struct Key {
  std::uint32_t x, y, z, group;
  bool operator==(const Key&) const = default;
};

struct KeyHash {
  std::size_t operator()(const Key& key) const noexcept {
    std::uint64_t h = 0x9E3779B97F4A7C15ULL;
    for (const std::uint32_t word : {key.x, key.y, key.z, key.group}) {
      h = (h ^ word) * 0xD6E8FEB86659FD93ULL;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
};

std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0F);
}  // + 0 turns -0 into 0

}  // namespace

Welded weld(const TriangleMesh& mesh, std::span<const std::uint32_t> group) {
  LORICA_CHECK(group.empty() || group.size() == mesh.positions.size(), "one group per vertex");
  Welded result;
  std::vector<std::uint32_t> keptAs(mesh.positions.size());
  std::unordered_map<Key, std::uint32_t, KeyHash> seen;
  seen.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& p = mesh.positions[v];
    const Key key{bits(p.x()), bits(p.y()), bits(p.z()), group.empty() ? 0U : group[v]};
    const auto [place, isNew] = seen.try_emplace(key, static_cast<std::uint32_t>(result.sourceOf.size()));
    if (isNew) {
      result.sourceOf.push_back(static_cast<std::uint32_t>(v));
      result.mesh.positions.push_back(p);
    }
    keptAs[v] = place->second;
  }
  result.mesh.triangles.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle kept{keptAs[triangle[0]], keptAs[triangle[1]], keptAs[triangle[2]]};
    if (kept[0] == kept[1] || kept[1] == kept[2] || kept[2] == kept[0]) {
      ++result.droppedTriangles;
    } else {
      result.mesh.triangles.push_back(kept);
    }
  }
  return result;
}

}  // namespace lorica::geometry
