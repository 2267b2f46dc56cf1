#include "lorica/human/skinning.h"

#include <Eigen/SVD>
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

namespace {

// Largest departure of a joint's map from a rotation that counts as rounding.
constexpr double noStretch = 1e-6;

/// The rotation nearest to a linear map (polar decomposition).
geometry::Mat3d nearestRotation(const geometry::Mat3d& map) {
  const Eigen::JacobiSVD<geometry::Mat3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
  geometry::Mat3d turned = svd.matrixU();
  if ((turned * svd.matrixV().transpose()).determinant() < 0.0) {
    turned.col(2) = -turned.col(2);
  }
  return turned * svd.matrixV().transpose();
}

bool isRotation(const geometry::Mat3d& map) {
  return (map.transpose() * map - geometry::Mat3d::Identity()).cwiseAbs().maxCoeff() < noStretch &&
         map.determinant() > 0.0;
}

/// How far the blended rotation takes `arm` from where it was. \param quaternion x, y, z, w of any length but zero
Vec3f turnOf(const Vec3f& arm, const Eigen::Vector4f& quaternion) {
  const Vec3f axis = quaternion.head<3>();
  const Vec3f across = axis.cross(arm);
  return (2.0F / quaternion.squaredNorm()) * (quaternion.w() * across + axis.cross(across));
}

}  // namespace

SkinningDeltas skinningDeltas(const Skeleton& skeleton, const Pose& pose) {
  const std::vector<geometry::Affine3d> carry = carryTransforms(skeleton, pose);
  SkinningDeltas deltas;
  deltas.joints.resize(skeleton.size());
  deltas.stretches.resize(skeleton.size(), Eigen::Matrix3f::Zero());
  std::vector<Eigen::Vector4d> turns(skeleton.size());
  bool stretched = false;
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    geometry::Mat3d rotation = carry[j].linear();
    if (!isRotation(rotation)) {
      rotation = nearestRotation(rotation);
      deltas.stretches[j] = (carry[j].linear() - rotation).cast<float>();
      stretched = true;
    }
    // q and -q are the same turn, but not when blended: neighbours along the skeleton stay on one side, so that a blend
    // takes the turn that the joints between them made.
    turns[j] = geometry::Quatd(rotation).normalized().coeffs();
    const auto parent = skeleton.joints()[j].parent;
    if ((parent ? turns[j].dot(turns[parent->value]) : turns[j].w()) < 0.0) {
      turns[j] = -turns[j];
    }
    Eigen::Matrix4d delta;
    delta.topRows<3>() = carry[j].matrix().topRows<3>();
    delta.topLeftCorner<3, 3>() -= geometry::Mat3d::Identity();
    delta.row(3) = turns[j].transpose();
    deltas.joints[j] = delta.cast<float>();
  }
  if (!stretched) {
    deltas.stretches.clear();
  }
  return deltas;
}

void skin(std::span<const Vec3f> rest, const SkinWeights& weights, std::span<const Vec3f> centres,
          const SkinningDeltas& deltas, std::span<Vec3f> posed, base::Threads threads) {
  LORICA_CHECK(rest.size() == posed.size() && rest.size() == weights.vertices(), "one weight set per vertex");
  LORICA_CHECK(centres.empty() || centres.size() == rest.size(), "one centre per vertex");
  // Turns that cancel each other out leave no rotation to blend.
  constexpr float cancelled = 1e-6F;
  constexpr std::size_t grain = 4096;
  base::parallelFor(rest.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t* joint = weights.joints.data() + v * weights.influences;
      const float* weight = weights.weights.data() + v * weights.influences;
      Eigen::Matrix4f blend = weight[0] * deltas.joints[joint[0]];
      std::size_t held = 1;
      for (; held < weights.influences && weight[held] > 0.0F; ++held) {
        blend += weight[held] * deltas.joints[joint[held]];
      }
      const bool turns = held > 1 && !centres.empty();
      const Vec3f centre = turns ? centres[v] : rest[v];
      const Eigen::Vector4f moved =
          blend.col(0) * centre.x() + blend.col(1) * centre.y() + blend.col(2) * centre.z() + blend.col(3);
      Vec3f change = moved.head<3>();
      if (turns) {
        const Vec3f arm = rest[v] - centre;
        const Eigen::Vector4f blended = blend.row(3).transpose();
        const bool usable = blended.squaredNorm() > cancelled;
        change += turnOf(arm, usable ? blended : Eigen::Vector4f(deltas.joints[joint[0]].row(3).transpose()));
        for (std::size_t k = 0; k < held && !deltas.stretches.empty(); ++k) {
          change += weight[k] * (deltas.stretches[joint[k]] * arm);
        }
      }
      posed[v] = rest[v] + change;
    }
  });
}

}  // namespace lorica::human
