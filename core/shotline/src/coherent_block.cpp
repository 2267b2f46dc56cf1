#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "lorica/shotline/trace.h"

namespace lorica::shotline {

using geometry::Vec3f;
using raycast::Ray;

namespace {

/// Spreads the low 10 bits to every second place.
std::uint32_t spread(std::uint32_t v) {
  v = (v | (v << 8U)) & 0x00FF00FFU;
  v = (v | (v << 4U)) & 0x0F0F0F0FU;
  v = (v | (v << 2U)) & 0x33333333U;
  return (v | (v << 1U)) & 0x55555555U;
}

/// One stable pass of a radix sort: by 11 bits of the keys, from `shift` up.
void radixPass(const std::vector<std::uint32_t>& keys, const std::vector<std::uint32_t>& from,
               std::vector<std::uint32_t>& to, unsigned shift) {
  constexpr std::uint32_t buckets = 2048;
  std::array<std::uint32_t, buckets + 1> start{};
  for (const std::uint32_t i : from) {
    ++start[((keys[i] >> shift) & (buckets - 1)) + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) {
    start[b + 1] += start[b];
  }
  for (const std::uint32_t i : from) {
    to[start[(keys[i] >> shift) & (buckets - 1)]++] = i;
  }
}

/// Cells of the box around some vectors: few along its narrowest axis, many along the other two.
class Cells {
 public:
  template <class Vector>
  Cells(const std::vector<Ray>& rays, const Vector& vector) {
    low_ = Vec3f::Constant(std::numeric_limits<float>::infinity());
    Vec3f high = -low_;
    for (const Ray& ray : rays) {
      low_ = low_.cwiseMin(vector(ray));
      high = high.cwiseMax(vector(ray));
    }
    span_ = high - low_;
    span_.minCoeff(&narrow_);
  }
  bool single() const { return span_.maxCoeff() == 0.0F; }
  /// \param bits of each wide axis, at most 10
  void divide(unsigned bits) {
    Vec3f steps = Vec3f::Constant(static_cast<float>((1U << bits) - 1U));
    steps[narrow_] = 3.0F;
    scale_ = steps.cwiseQuotient(span_.cwiseMax(1e-30F));
    bits_ = bits;
  }
  /// Of what the narrow axis falls into, then in Morton order along the other two: 2 + 2 * bits bits.
  std::uint32_t key(const Vec3f& vector) const {
    const Vec3f cell = (vector - low_).cwiseProduct(scale_);
    return spread(static_cast<std::uint32_t>(cell[(narrow_ + 1) % 3])) |
           (spread(static_cast<std::uint32_t>(cell[(narrow_ + 2) % 3])) << 1U) |
           (static_cast<std::uint32_t>(cell[narrow_]) << (2U * bits_));
  }

 private:
  Vec3f low_;
  Vec3f span_;
  Vec3f scale_ = Vec3f::Zero();
  Eigen::Index narrow_ = 0;
  unsigned bits_ = 0;
};

/// 22 bits that neighbours have nearly in common.
void makeKeys(const std::vector<Ray>& rays, std::vector<std::uint32_t>& keys) {
  Cells directions(rays, [](const Ray& ray) { return ray.direction; });
  Cells origins(rays, [](const Ray& ray) { return ray.origin; });
  keys.resize(rays.size());
  const bool fromOnePlace = origins.single();
  if (fromOnePlace || directions.single()) {
    Cells& cells = fromOnePlace ? directions : origins;
    cells.divide(10);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      keys[i] = cells.key(fromOnePlace ? rays[i].direction : rays[i].origin);
    }
    return;
  }
  constexpr unsigned directionBits = 5;
  constexpr unsigned originBits = 4;
  directions.divide(directionBits);
  origins.divide(originBits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    keys[i] = directions.key(rays[i].direction) << (2U + 2U * originBits) | origins.key(rays[i].origin);
  }
}

}  // namespace

void CoherentBlock::load(const ShotGenerator& shots, const ShotRange& range) {
  LORICA_CHECK(range.count <= UINT32_MAX, "a block of fewer shots");
  first_ = range.first;
  const auto count = static_cast<std::size_t>(range.count);
  rays_.resize(count);
  shots.shots(range.first, rays_);
  makeKeys(rays_, keys_);
  order_.resize(count);
  scratch_.resize(count);
  std::iota(order_.begin(), order_.end(), 0U);
  radixPass(keys_, order_, scratch_, 0);
  radixPass(keys_, scratch_, order_, 11);
  sorted_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    sorted_[i] = rays_[order_[i]];
  }
}

std::uint64_t blockSize(std::uint64_t shots, base::Threads threads) {
  const auto crew = static_cast<std::uint64_t>(threads.count > 0 ? threads.count : base::machineThreads());
  return std::clamp<std::uint64_t>(shots / (8 * crew), 1024, 65536);
}

}  // namespace lorica::shotline
