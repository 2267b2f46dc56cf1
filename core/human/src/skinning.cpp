#include "lorica/human/skinning.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <limits>

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

/// Vertices on their way through skin(): a component of all of them stands together, so that the compiler turns several
/// at once: more than twice as fast as one by one.
struct Block {
  static constexpr std::size_t size = 64;
  using Lane = std::array<float, size>;
  std::array<Lane, 3> change;  ///< posed - rest, metres
  std::array<Lane, 3> arm;     ///< rest - centre
  std::array<Lane, 4> turn;    ///< blended quaternion x, y, z, w, not of unit length

  /// Blends the joints that hold a vertex: how far its centre moves, how far its arm is stretched, how it turns.
  void blend(std::size_t i, const Vec3f& rest, const SkinWeights& weights, std::size_t vertex, const Vec3f& centre,
             const SkinningDeltas& deltas) {
    const std::uint32_t* joint = weights.joints.data() + vertex * weights.influences;
    const float* weight = weights.weights.data() + vertex * weights.influences;
    const SkinningDeltas::Joint& strongest = deltas.joints[joint[0]];
    // One register each.
    Eigen::Vector4f x = weight[0] * strongest.col(0);
    Eigen::Vector4f y = weight[0] * strongest.col(1);
    Eigen::Vector4f z = weight[0] * strongest.col(2);
    Eigen::Vector4f shift = weight[0] * strongest.col(3);
    Eigen::Vector4f quaternion = weight[0] * strongest.col(4);
    std::size_t held = 1;
    for (; held < weights.influences && weight[held] > 0.0F; ++held) {
      const SkinningDeltas::Joint& next = deltas.joints[joint[held]];
      x += weight[held] * next.col(0);
      y += weight[held] * next.col(1);
      z += weight[held] * next.col(2);
      shift += weight[held] * next.col(3);
      quaternion += weight[held] * next.col(4);
    }
    // What one joint holds moves with it, to the bit as in linear skinning.
    const Vec3f& about = held > 1 ? centre : rest;
    Eigen::Vector4f moved = x * about.x() + y * about.y() + z * about.z() + shift;
    for (std::size_t k = 0; k < held && !deltas.stretches.empty(); ++k) {
      moved.head<3>() += weight[k] * (deltas.stretches[joint[k]] * (rest - about));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const auto component = static_cast<Eigen::Index>(c);
      change[c][i] = moved[component];
      arm[c][i] = rest[component] - about[component];
    }
    for (std::size_t c = 0; c < 4; ++c) {
      turn[c][i] = quaternion[static_cast<Eigen::Index>(c)];
    }
  }

  /// Adds how far the turns take the arms from where they were. Turns that cancel each other out do not turn.
  void addTurns() {
    for (std::size_t i = 0; i < size; ++i) {
      const float qx = turn[0][i];
      const float qy = turn[1][i];
      const float qz = turn[2][i];
      const float qw = turn[3][i];
      // The least float changes no sum but nought, where turns cancel each other out.
      const float squaredNorm = qx * qx + qy * qy + qz * qz + qw * qw + std::numeric_limits<float>::min();
      const float scale = 2.0F / squaredNorm;
      const float ux = qy * arm[2][i] - qz * arm[1][i];
      const float uy = qz * arm[0][i] - qx * arm[2][i];
      const float uz = qx * arm[1][i] - qy * arm[0][i];
      change[0][i] += scale * (qw * ux + (qy * uz - qz * uy));
      change[1][i] += scale * (qw * uy + (qz * ux - qx * uz));
      change[2][i] += scale * (qw * uz + (qx * uy - qy * ux));
    }
  }
};

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
    Eigen::Matrix4d delta = carry[j].matrix() - Eigen::Matrix4d::Identity();
    deltas.joints[j] << delta.cast<float>(), turns[j].cast<float>();
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
  constexpr std::size_t blocksPerRange = 64;
  const std::size_t blocks = (rest.size() + Block::size - 1) / Block::size;
  base::parallelFor(blocks, blocksPerRange, threads, [&](std::size_t firstBlock, std::size_t endBlock) {
    Block block{};
    const std::size_t end = std::min(endBlock * Block::size, rest.size());
    for (std::size_t first = firstBlock * Block::size; first < end; first += Block::size) {
      const std::size_t count = std::min(Block::size, end - first);
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = first + i;
        block.blend(i, rest[v], weights, v, centres.empty() ? rest[v] : centres[v], deltas);
      }
      block.addTurns();
      for (std::size_t i = 0; i < count; ++i) {
        posed[first + i] = rest[first + i] + Vec3f(block.change[0][i], block.change[1][i], block.change[2][i]);
      }
    }
  });
}

}  // namespace lorica::human
