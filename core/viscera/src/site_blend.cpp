#include "lorica/viscera/site_blend.h"

#include <algorithm>
#include <utility>

#include "lorica/base/error.h"

namespace lorica::viscera {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

SiteBlend blendOf(const Vec3d& point, const std::vector<parenting::SkinSite>& sites, SiteBinding binding,
                  std::vector<std::pair<double, std::uint32_t>>& byDistance) {
  byDistance.clear();
  for (std::size_t s = 0; s < sites.size(); ++s) {
    byDistance.emplace_back((sites[s].rest - point).squaredNorm(), static_cast<std::uint32_t>(s));
  }
  const std::size_t wanted = binding == SiteBinding::nearest ? 1 : SiteBlend::limit;
  const std::size_t listed = std::min(wanted + 1, byDistance.size());
  std::partial_sort(byDistance.begin(), byDistance.begin() + static_cast<std::ptrdiff_t>(listed), byDistance.end());
  SiteBlend blend;
  blend.count = std::min(wanted, byDistance.size());
  // Wendland-like weights with the distance of the first site left out as their radius; when none is left out, all
  // count and the farthest still gets a share.
  const double radius2 = listed > blend.count ? byDistance[blend.count].first : 2.0 * byDistance[listed - 1].first;
  std::array<double, SiteBlend::limit> weight{};
  double sum = 0.0;
  for (std::size_t k = 0; k < blend.count; ++k) {
    const double u = radius2 > 0.0 ? 1.0 - byDistance[k].first / radius2 : 0.0;
    weight[k] = std::max(u * u, 1e-12);
    sum += weight[k];
  }
  for (std::size_t k = 0; k < blend.count; ++k) {
    blend.site[k] = byDistance[k].second;
    blend.weight[k] = static_cast<float>(weight[k] / sum);
  }
  return blend;
}

}  // namespace

std::vector<SiteBlend> bindToSites(std::span<const Vec3d> points, const std::vector<parenting::SkinSite>& sites,
                                   SiteBinding binding, base::Threads threads) {
  LORICA_CHECK(!sites.empty(), "there is a site");
  std::vector<SiteBlend> blends(points.size());
  base::parallelFor(points.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<double, std::uint32_t>> byDistance;
    for (std::size_t p = begin; p < end; ++p) {
      blends[p] = blendOf(points[p], sites, binding, byDistance);
    }
  });
  return blends;
}

std::vector<Vec3f> offsets(std::span<const Vec3d> points, std::span<const SiteBlend> blends,
                           std::span<const geometry::RigidTransform> siteCarry, base::Threads threads) {
  LORICA_CHECK(points.size() == blends.size(), "one blend per point");
  std::vector<Vec3f> result(points.size());
  const auto offsetOf = [&](std::size_t p) -> Vec3f {
    Vec3d offset = Vec3d::Zero();
    for (std::size_t k = 0; k < blends[p].count; ++k) {
      const geometry::RigidTransform& carry = siteCarry[blends[p].site[k]];
      if (!carry.isIdentity()) {
        offset += static_cast<double>(blends[p].weight[k]) * (carry * points[p] - points[p]);
      }
    }
    return offset.cast<float>();
  };
  base::parallelFor(points.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      result[p] = offsetOf(p);
    }
  });
  return result;
}

}  // namespace lorica::viscera
