#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

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

constexpr unsigned bucketBits = 11;
constexpr std::uint32_t buckets = 1U << bucketBits;

/// How many of `shots` one thread takes at a time: within bounds, few enough for all threads to have some.
std::size_t shareOf(std::size_t shots, base::Threads threads, std::size_t least, std::size_t most) {
  const auto crew = static_cast<std::size_t>(threads.count > 0 ? threads.count : base::machineThreads());
  return std::clamp(shots / (4 * crew), least, most);
}

std::uint32_t upper(std::uint32_t key) {
  return key >> bucketBits;
}

/// One stable pass of a radix sort: by the bits of the keys from `shift` up.
void radixPass(const std::vector<std::uint32_t>& keys, const std::vector<std::uint32_t>& from,
               std::vector<std::uint32_t>& to, unsigned shift) {
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

/// The box around some vectors.
struct Bounds {
  Vec3f low = Vec3f::Constant(std::numeric_limits<float>::infinity());
  Vec3f high = Vec3f::Constant(-std::numeric_limits<float>::infinity());
  void extend(const Vec3f& vector) {
    low = low.cwiseMin(vector);
    high = high.cwiseMax(vector);
  }
  void extend(const Bounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

struct RayBounds {
  Bounds origins;
  Bounds directions;
};

/// Cells of a box: few along its narrowest axis, many along the other two.
class Cells {
 public:
  explicit Cells(const Bounds& bounds) : low_(bounds.low), span_(bounds.high - bounds.low) { span_.minCoeff(&narrow_); }
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

/// Gives rays keys of 22 bits that neighbours have nearly in common.
class KeyMaker {
 public:
  explicit KeyMaker(const RayBounds& bounds) : directions_(bounds.directions), origins_(bounds.origins) {
    byDirection_ = !directions_.single();
    byOrigin_ = !origins_.single() || !byDirection_;
    const bool both = byDirection_ && byOrigin_;
    directions_.divide(both ? 5 : 10);
    origins_.divide(both ? originBits : 10);
  }
  std::uint32_t operator()(const Ray& ray) const {
    if (!byOrigin_) {
      return directions_.key(ray.direction);
    }
    const std::uint32_t origin = origins_.key(ray.origin);
    return byDirection_ ? directions_.key(ray.direction) << (2U + 2U * originBits) | origin : origin;
  }

 private:
  static constexpr unsigned originBits = 4;
  Cells directions_;
  Cells origins_;
  bool byDirection_ = false;
  bool byOrigin_ = false;
};

/// Makes the shots of a block. Returns what bounds them.
RayBounds makeRays(const ShotGenerator& shots, std::uint64_t first, std::span<Ray> rays, std::size_t shotsPerPart,
                   base::Threads threads) {
  const std::size_t parts = (rays.size() + shotsPerPart - 1) / shotsPerPart;
  std::vector<RayBounds> bounds(parts);
  base::parallelFor(parts, 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const std::size_t start = p * shotsPerPart;
      const std::span<Ray> part = rays.subspan(start, std::min(shotsPerPart, rays.size() - start));
      shots.shots(first + start, part);
      for (const Ray& ray : part) {
        bounds[p].origins.extend(ray.origin);
        bounds[p].directions.extend(ray.direction);
      }
    }
  });
  for (std::size_t p = 1; p < parts; ++p) {
    bounds[0].origins.extend(bounds[p].origins);
    bounds[0].directions.extend(bounds[p].directions);
  }
  return bounds[0];
}

}  // namespace

void CoherentBlock::load(const ShotGenerator& shots, const ShotRange& range, base::Threads threads) {
  LORICA_CHECK(range.count > 0 && range.count <= mostShots, "a block has some shots, and not too many");
  first_ = range.first;
  const auto count = static_cast<std::size_t>(range.count);
  rays_.resize(count);
  keys_.resize(count);
  placed_.resize(count);
  shotsPerSlice_ = shareOf(count, threads, 512, 4096);
  const std::size_t shotsPerPart = shareOf(count, threads, 4096, 16384);
  const KeyMaker keyOf(makeRays(shots, first_, rays_, shotsPerPart, threads));
  const std::size_t parts = (count + shotsPerPart - 1) / shotsPerPart;
  starts_.assign(parts * buckets, 0);
  const auto overParts = [&](const auto& use) {
    base::parallelFor(parts, 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        use(&starts_[p * buckets], p * shotsPerPart, std::min((p + 1) * shotsPerPart, count));
      }
    });
  };
  overParts([&](std::uint32_t* sizes, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      keys_[i] = keyOf(rays_[i]);
      ++sizes[upper(keys_[i])];
    }
  });
  std::uint32_t next = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    for (std::size_t p = 0; p < parts; ++p) {
      next += std::exchange(starts_[p * buckets + b], next);
    }
  }
  overParts([&](std::uint32_t* starts, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      placed_[starts[upper(keys_[i])]++] = {rays_[i], keys_[i], static_cast<std::uint32_t>(i)};
    }
  });
}

void CoherentSlice::load(const CoherentBlock& block, std::size_t index) {
  const std::size_t begin = index * block.shotsPerSlice_;
  const std::size_t count = std::min(block.shotsPerSlice_, block.placed_.size() - begin);
  const std::span<const CoherentBlock::Placed> placed = std::span(block.placed_).subspan(begin, count);
  keys_.resize(count);
  order_.resize(count);
  scratch_.resize(count);
  rays_.resize(count);
  numbers_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    keys_[i] = placed[i].key;
  }
  std::iota(order_.begin(), order_.end(), 0U);
  radixPass(keys_, order_, scratch_, 0);
  radixPass(keys_, scratch_, order_, bucketBits);
  for (std::size_t i = 0; i < count; ++i) {
    const CoherentBlock::Placed& shot = placed[order_[i]];
    rays_[i] = shot.ray;
    numbers_[i] = block.first_ + shot.number;
  }
}

}  // namespace lorica::shotline
