#include "lorica/human/rotation_centres.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::human {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

// Length over which centres are smoothed, as a share of the square root of the skin's area. Shorter, and creases stay
// where the pairs of joints change; longer, and centres mix across the folds of groin and armpit.
constexpr double smoothingShare = 0.03;
constexpr std::size_t mostSmoothingSteps = 1000;

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

std::vector<double> areaAround(const geometry::TriangleMesh& mesh) {
  std::vector<double> area(mesh.positions.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.corner(t, 0);
    const double share = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm() / 6.0;
    for (const std::uint32_t corner : mesh.triangles[t]) {
      area[corner] += share;
    }
  }
  return area;
}

/// Centres of the vertices' pairs of joints, not smoothed.
std::vector<Vec3d> pairCentres(const geometry::TriangleMesh& rest, const SkinWeights& weights) {
  const std::vector<double> area = areaAround(rest);
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

/// What a vertex takes from its neighbours in one step of smoothing; the same vertices' neighbours stand together.
struct Neighbours {
  std::vector<std::size_t> first;  ///< of each vertex, and the end
  std::vector<std::uint32_t> vertex;
  std::vector<double> share;   ///< sums to 1 over the neighbours of a vertex
  double squaredLength = 0.0;  ///< mean square of the edges, m2
};

/// Neighbours along edges whose ends are both shared by joints. Near ones count more, as in the flow of heat.
Neighbours neighboursOfShared(const geometry::TriangleMesh& rest, const SkinWeights& weights) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(6 * rest.triangles.size());
  for (const geometry::Triangle& corner : rest.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[k];
      const std::uint32_t b = corner[(k + 1) % 3];
      if (a != b && weights.isShared(a) && weights.isShared(b)) {
        edges.emplace_back(a, b);
        edges.emplace_back(b, a);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  Neighbours result;
  result.first.assign(rest.positions.size() + 1, 0);
  const auto length = [&](const auto& edge) {
    return (rest.positions[edge.first].template cast<double>() - rest.positions[edge.second].template cast<double>())
        .norm();
  };
  for (const auto& edge : edges) {
    ++result.first[edge.first + 1];
    result.squaredLength += length(edge) * length(edge) / static_cast<double>(edges.size());
  }
  for (std::size_t v = 0; v < rest.positions.size(); ++v) {
    result.first[v + 1] += result.first[v];
  }
  const double shortest = 1e-6 * std::sqrt(result.squaredLength);
  for (const auto& edge : edges) {
    result.vertex.push_back(edge.second);
    result.share.push_back(1.0 / std::max(length(edge), shortest));
  }
  for (std::size_t v = 0; v < rest.positions.size(); ++v) {
    double sum = 0.0;
    for (std::size_t e = result.first[v]; e < result.first[v + 1]; ++e) {
      sum += result.share[e];
    }
    for (std::size_t e = result.first[v]; e < result.first[v + 1]; ++e) {
      result.share[e] /= sum;
    }
  }
  return result;
}

/// Each step moves every centre half way to the mean of its neighbours, which spreads by half an edge squared.
void smooth(std::vector<Vec3d>& centres, const Neighbours& neighbours, double length, base::Threads threads) {
  const double steps = std::ceil(2.0 * length * length / neighbours.squaredLength);
  std::vector<Vec3d> next(centres.size());
  for (std::size_t step = 0; step < std::min(static_cast<std::size_t>(steps), mostSmoothingSteps); ++step) {
    base::parallelFor(centres.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        Vec3d mean = Vec3d::Zero();
        for (std::size_t e = neighbours.first[v]; e < neighbours.first[v + 1]; ++e) {
          mean += neighbours.share[e] * centres[neighbours.vertex[e]];
        }
        const bool alone = neighbours.first[v] == neighbours.first[v + 1];
        next[v] = alone ? centres[v] : Vec3d(0.5 * (centres[v] + mean));
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
  const Neighbours neighbours = neighboursOfShared(rest, weights);
  if (neighbours.squaredLength > 0.0) {
    smooth(centres, neighbours, smoothingShare * std::sqrt(geometry::area(rest)), threads);
  }
  std::vector<Vec3f> result(centres.size());
  for (std::size_t v = 0; v < centres.size(); ++v) {
    result[v] = weights.isShared(v) ? Vec3f(centres[v].cast<float>()) : rest.positions[v];
  }
  return result;
}

}  // namespace lorica::human
