#include "lorica/human/rotation_centres.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/smoothing.h"

namespace lorica::human {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

// Length over which centres are smoothed, as a share of the square root of the skin's area. Shorter, and creases stay
// where the pairs of joints change; longer, and centres mix across the folds of groin and armpit.
constexpr double smoothingShare = 0.03;

/// A sum of places with what they count.
struct Mean {
  Vec3d sum = Vec3d::Zero();
  double share = 0.0;

  void add(const Vec3d& place, double weight) {
    sum += weight * place;
    share += weight;
  }
};

/// Calls `take(pair of joints, product of their weights)` for every two joints that hold the vertex.
template <class Take>
void forPairs(const SkinWeights& weights, std::size_t vertex, const Take& take) {
  const std::uint32_t* joint = weights.joints.data() + vertex * weights.influences;
  const float* weight = weights.weights.data() + vertex * weights.influences;
  for (std::size_t a = 0; a < weights.influences && weight[a] > 0.0F; ++a) {
    for (std::size_t b = a + 1; b < weights.influences && weight[b] > 0.0F; ++b) {
      take(std::minmax(joint[a], joint[b]), static_cast<double>(weight[a]) * static_cast<double>(weight[b]));
    }
  }
}

/// Centres of the vertices' pairs of joints, not smoothed.
std::vector<Vec3d> pairCentres(const geometry::TriangleMesh& rest, const SkinWeights& weights) {
  const std::vector<double> area = geometry::vertexAreas(rest);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Mean> common;
  for (std::size_t v = 0; v < rest.positions.size(); ++v) {
    forPairs(weights, v, [&](const std::pair<std::uint32_t, std::uint32_t>& joints, double product) {
      common[joints].add(rest.positions[v].cast<double>(), area[v] * product);
    });
  }
  std::vector<Vec3d> centres(rest.positions.size());
  for (std::size_t v = 0; v < centres.size(); ++v) {
    Mean mean;
    forPairs(weights, v, [&](const std::pair<std::uint32_t, std::uint32_t>& joints, double product) {
      const Mean& skin = common.at(joints);
      if (skin.share > 0.0) {
        mean.add(skin.sum / skin.share, product);
      }
    });
    centres[v] = mean.share > 0.0 ? Vec3d(mean.sum / mean.share) : rest.positions[v].cast<double>();
  }
  return centres;
}

void smooth(std::vector<Vec3d>& centres, const geometry::SurfaceNeighbours& neighbours, double length,
            base::Threads threads) {
  std::vector<Vec3d> next(centres.size());
  for (std::size_t step = 0; step < neighbours.stepsFor(length); ++step) {
    base::parallelFor(centres.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        next[v] = 0.5 * (centres[v] + neighbours.mean<Vec3d>(centres, v, centres[v]));
      }
    });
    centres.swap(next);
  }
}

}  // namespace

std::vector<Vec3f> rotationCentres(const geometry::TriangleMesh& rest, const SkinWeights& weights,
                                   base::Threads threads) {
  LORICA_CHECK(weights.vertices() == rest.positions.size(), "one weight set per vertex");
  std::vector<Vec3d> centres = pairCentres(rest, weights);
  // A vertex that one joint holds has no centre that says anything.
  const auto shared = [&](std::uint32_t vertex) { return weights.isShared(vertex); };
  smooth(centres, geometry::surfaceNeighbours(rest, shared), smoothingShare * std::sqrt(geometry::area(rest)), threads);
  std::vector<Vec3f> result(centres.size());
  for (std::size_t v = 0; v < centres.size(); ++v) {
    result[v] = weights.isShared(v) ? Vec3f(centres[v].cast<float>()) : rest.positions[v];
  }
  return result;
}

}  // namespace lorica::human
