#include "lorica/human/skinning.h"

#include <algorithm>

#include "lorica/base/error.h"

namespace lorica::human {

using geometry::Vec3f;

namespace {

/// Merges repeated joints, drops zeros, sorts by weight. Returns how many remain at the front of `influences`.
std::size_t putInOrder(std::vector<Influence>& influences) {
  std::sort(influences.begin(), influences.end(),
            [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
  std::size_t kept = 0;
  for (const Influence& influence : influences) {
    if (influence.weight <= 0.0) {
      continue;
    }
    if (kept > 0 && influences[kept - 1].joint == influence.joint) {
      influences[kept - 1].weight += influence.weight;
    } else {
      influences[kept++] = influence;
    }
  }
  std::stable_sort(influences.begin(), influences.begin() + static_cast<std::ptrdiff_t>(kept),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  return kept;
}

}  // namespace

NormalisedWeights normaliseWeights(std::span<const Influence> perVertex, std::size_t stride, std::size_t limit) {
  LORICA_CHECK(stride > 0 && perVertex.size() % stride == 0 && limit > 0, "whole vertices");
  const std::size_t vertices = perVertex.size() / stride;
  NormalisedWeights result;
  std::vector<Influence> ordered(perVertex.begin(), perVertex.end());
  std::vector<std::size_t> counts(vertices);
  std::vector<Influence> scratch;
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto begin = ordered.begin() + static_cast<std::ptrdiff_t>(v * stride);
    scratch.assign(begin, begin + static_cast<std::ptrdiff_t>(stride));
    double sum = 0.0;
    for (const Influence& influence : scratch) {
      sum += influence.weight;
    }
    counts[v] = putInOrder(scratch);
    if (counts[v] == 0) {
      result.firstUnweighted = result.unweightedVertices == 0 ? v : result.firstUnweighted;
      ++result.unweightedVertices;
      scratch[0] = {0, 1.0};
      counts[v] = 1;
    } else if (std::abs(sum - 1.0) > 1e-3) {
      ++result.unnormalisedVertices;
    }
    result.truncatedVertices += counts[v] > limit ? 1 : 0;
    counts[v] = std::min(counts[v], limit);
    std::copy(scratch.begin(), scratch.end(), begin);
    result.weights.influences = std::max(result.weights.influences, counts[v]);
  }
  SkinWeights& weights = result.weights;
  weights.joints.assign(vertices * weights.influences, 0);
  weights.weights.assign(vertices * weights.influences, 0.0F);
  for (std::size_t v = 0; v < vertices; ++v) {
    double sum = 0.0;
    for (std::size_t k = 0; k < counts[v]; ++k) {
      sum += ordered[v * stride + k].weight;
    }
    for (std::size_t k = 0; k < counts[v]; ++k) {
      weights.joints[v * weights.influences + k] = ordered[v * stride + k].joint;
      weights.weights[v * weights.influences + k] = static_cast<float>(ordered[v * stride + k].weight / sum);
    }
  }
  return result;
}

std::vector<SkinningDelta> skinningDeltas(const Skeleton& skeleton, const Pose& pose) {
  std::vector<SkinningDelta> deltas;
  deltas.reserve(skeleton.size());
  for (const geometry::Affine3d& carry : carryTransforms(skeleton, pose)) {
    Eigen::Matrix<double, 3, 4> delta = carry.matrix().topRows<3>();
    delta.leftCols<3>() -= geometry::Mat3d::Identity();
    deltas.emplace_back(delta.cast<float>());
  }
  return deltas;
}

void skin(std::span<const Vec3f> rest, const SkinWeights& weights, std::span<const SkinningDelta> deltas,
          std::span<Vec3f> posed, base::Threads threads) {
  LORICA_CHECK(rest.size() == posed.size() && rest.size() == weights.vertices(), "one weight set per vertex");
  constexpr std::size_t grain = 4096;
  base::parallelFor(rest.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t* joint = weights.joints.data() + v * weights.influences;
      const float* weight = weights.weights.data() + v * weights.influences;
      SkinningDelta blend = weight[0] * deltas[joint[0]];
      for (std::size_t k = 1; k < weights.influences && weight[k] > 0.0F; ++k) {
        blend += weight[k] * deltas[joint[k]];
      }
      posed[v] = rest[v] + (blend.leftCols<3>() * rest[v] + blend.col(3));
    }
  });
}

}  // namespace lorica::human
