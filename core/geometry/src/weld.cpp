#include "lorica/geometry/weld.h"

#include <algorithm>
#include <bit>
#include <numeric>
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

/// Bits by number.
class Bits {
 public:
  explicit Bits(std::size_t count) : words_(count / 64 + 1, 0) {}
  std::uint64_t at(std::size_t bit) const { return words_[bit / 64] >> (bit % 64) & 1U; }
  void set(std::size_t bit, std::uint64_t value) { words_[bit / 64] |= value << (bit % 64); }

 private:
  std::vector<std::uint64_t> words_;
};

/// The vertices, in their order, whose hash another one has too: all others are unlike any other vertex. In a surface
/// without seams few remain.
template <class HashOf>
std::vector<std::uint32_t> suspects(std::size_t vertices, const HashOf& hashOf) {
  // No more than placeOf can number.
  const std::size_t places = std::min(std::bit_ceil(16 * vertices + 1), std::size_t{1} << 32U);
  Bits seen(places);
  Bits seenTwice(places);
  std::vector<std::uint32_t> placeOf(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::size_t place = hashOf(v) & (places - 1);
    placeOf[v] = static_cast<std::uint32_t>(place);
    seenTwice.set(place, seen.at(place));
    seen.set(place, 1);
  }
  std::vector<std::uint32_t> found;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (seenTwice.at(placeOf[v]) != 0) {
      found.push_back(static_cast<std::uint32_t>(v));
    }
  }
  return found;
}

}  // namespace

Welded weld(TriangleMesh mesh, std::span<const std::uint32_t> group) {
  LORICA_CHECK(group.empty() || group.size() == mesh.positions.size(), "one group per vertex");
  const Positions& positions = mesh.positions;
  const auto groupOf = [&](std::size_t v) { return group.empty() ? 0U : group[v]; };
  const auto hashOf = [&](std::size_t v) { return hash(positions[v], groupOf(v)); };
  const std::vector<std::uint32_t> alike = suspects(positions.size(), hashOf);
  constexpr std::uint32_t empty = UINT32_MAX;
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * alike.size() + 1), empty);  // open addressing
  std::vector<std::uint32_t> firstOf(positions.size());  // the first vertex that equals each; later, what it is kept as
  std::iota(firstOf.begin(), firstOf.end(), 0U);
  std::size_t doubles = 0;
  for (const std::uint32_t v : alike) {
    std::size_t at = (hashOf(v) >> 32U) & (slots.size() - 1);  // the low bits of suspects are alike
    while (slots[at] != empty && (positions[slots[at]] != positions[v] || groupOf(slots[at]) != groupOf(v))) {
      at = (at + 1) & (slots.size() - 1);
    }
    slots[at] = std::min(slots[at], v);
    firstOf[v] = slots[at];
    doubles += firstOf[v] == v ? 0 : 1;
  }
  Welded result;
  result.sourceOf.resize(positions.size() - doubles);
  if (doubles == 0) {
    std::iota(result.sourceOf.begin(), result.sourceOf.end(), 0U);
  } else {
    // Kept vertices move down within their array.
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < firstOf.size(); ++v) {
      if (firstOf[v] == v) {
        result.sourceOf[kept] = v;
        mesh.positions[kept] = mesh.positions[v];
        firstOf[v] = kept++;
      } else {
        firstOf[v] = firstOf[firstOf[v]];
      }
    }
    mesh.positions.resize(kept, Vec3f::Zero());
  }
  std::size_t whole = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle welded{firstOf[triangle[0]], firstOf[triangle[1]], firstOf[triangle[2]]};
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
