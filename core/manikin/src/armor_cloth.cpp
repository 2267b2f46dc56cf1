#include "armor_cloth.h"

#include <algorithm>
#include <cmath>

#include "lorica/geometry/measures.h"
#include "lorica/geometry/remesh.h"

namespace lorica::manikin {

namespace {

using geometry::ClosestPoint;
using geometry::ClosestPointTree;
using geometry::TriangleMesh;

constexpr std::size_t kGrain = 256;

double distanceToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// How far a point lies from where armor is worn: 0 on trunk, neck and upper arms.
double distanceFromWearer(const Vec3d& p, const ArmorLandmarks& marks) {
  Vec3d q = p - Vec3d(marks.midline, 0.0, 0.0);
  q.x() = std::abs(q.x());
  const double trunkHalf = std::max(marks.shoulder.x(), marks.flankHalf - 0.01) + 0.03;
  const double top = marks.chin + 0.05;
  const double below = std::max({0.0, marks.crotch - 0.02 - q.y(), q.y() - top, q.x() - trunkHalf});
  const Vec3d middle = marks.shoulder + 0.5 * (marks.elbow - marks.shoulder);
  return std::min(below, std::max(0.0, distanceToSegment(q, marks.shoulder, middle) - 0.1));
}

/// Of an element of the skin, by the weights of its nearest triangle.
double shareAt(const std::vector<double>& share, const Body& body, const ClosestPoint& place) {
  const geometry::Triangle& t = body.skin.triangles[place.triangle];
  return place.barycentric[0] * share[t[0]] + place.barycentric[1] * share[t[1]] + place.barycentric[2] * share[t[2]];
}

/// Moves points towards the mean of their neighbours, all at once.
void relax(std::vector<Vec3d>& points, const std::vector<std::vector<std::uint32_t>>& neighbors,
           const std::vector<char>& moves, double share, base::Threads threads) {
  std::vector<Vec3d> moved = points;
  base::parallelFor(points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (moves[v] == 0) {
        continue;
      }
      Vec3d mean = Vec3d::Zero();
      for (const std::uint32_t n : neighbors[v]) {
        mean += points[n];
      }
      mean /= static_cast<double>(neighbors[v].size());
      moved[v] = points[v] + share * (mean - points[v]);
    }
  });
  points = std::move(moved);
}

/// What the skin looks like from a point: its tangent plane at the nearest place.
struct Plane {
  Vec3d point = Vec3d::Zero();
  Vec3d normal = Vec3d::UnitY();

  double height(const Vec3d& p) const { return normal.dot(p - point); }
};

Plane planeBelow(const ClosestPointTree& skin, const Vec3d& p) {
  const auto place = skin.closest(p);
  const Vec3d towards = p - place->point;
  const Vec3d facing = place->pseudoNormal.normalized();
  // Well off the skin the way to it is the better normal; on it that way has no direction.
  const bool outside = towards.dot(facing) > 5e-4;
  return {place->point, outside ? Vec3d(towards.normalized()) : facing};
}

std::vector<Vec3d> smoothNormals(const TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& neighbors,
                                 base::Threads threads) {
  std::vector<Vec3d> normals;
  normals.reserve(mesh.positions.size());
  for (const geometry::Vec3f& normal : geometry::vertexNormals(mesh.positions, mesh.triangles)) {
    normals.emplace_back(normal.cast<double>());
  }
  const std::vector<char> all(normals.size(), 1);
  for (int round = 0; round < 4; ++round) {
    relax(normals, neighbors, all, 0.6, threads);
    for (Vec3d& normal : normals) {
      normal.normalize();
    }
  }
  return normals;
}

TriangleMesh evenSkin(const Body& body, const ArmorLandmarks& marks, const ClosestPointTree& skin, double edge,
                      base::Threads threads) {
  geometry::RemeshOptions options;
  options.edgeLength = [&](const Vec3d& p) { return edge + std::min(0.4 * distanceFromWearer(p, marks), 0.03); };
  options.project = [&](const Vec3d& p) { return skin.closest(p)->point; };
  options.threads = threads;
  options.rounds = 5;
  return geometry::remeshed(body.skin, options);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> vertexNeighbors(const TriangleMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> neighbors(mesh.positions.size());
  for (const geometry::Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      neighbors[t[k]].push_back(t[(k + 1) % 3]);
      neighbors[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  for (std::vector<std::uint32_t>& ring : neighbors) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  }
  return neighbors;
}

Cloth drapedCloth(const Body& body, const BodyShares& shares, const ArmorLandmarks& marks, const ClosestPointTree& skin,
                  const ClothOptions& options, base::Threads threads) {
  TriangleMesh mesh = evenSkin(body, marks, skin, options.edge, threads);
  const auto neighbors = vertexNeighbors(mesh);
  const std::size_t count = mesh.positions.size();
  std::vector<char> onTrunk(count, 0);
  std::vector<char> onShoulders(count, 0);
  std::vector<char> moves(count, 0);
  std::vector<Vec3d> points(count);
  std::vector<Plane> below(count);
  const auto look = [&](std::size_t v) { below[v] = planeBelow(skin, points[v]); };
  base::parallelFor(count, kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3d p = mesh.positions[v].cast<double>();
      const ClosestPoint place = *skin.closest(p);
      const bool fine = distanceFromWearer(p, marks) <= 0.0 && shareAt(shares.head, body, place) < 0.5;
      onShoulders[v] = fine ? 1 : 0;
      onTrunk[v] = fine && shareAt(shares.arms, body, place) < 0.5 ? 1 : 0;
      moves[v] = distanceFromWearer(p, marks) < 0.03 ? 1 : 0;
      points[v] = p + options.clearance * place.pseudoNormal.normalized();
      look(v);
    }
  });
  constexpr int rounds = 120;
  for (int round = 0; round < rounds; ++round) {
    relax(points, neighbors, moves, 0.5, threads);
    const bool lookAgain = round % 4 == 0 || round + 6 > rounds;
    base::parallelFor(count, kGrain, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        if (moves[v] == 0) {
          continue;
        }
        if (lookAgain) {
          look(v);
        }
        const double height = below[v].height(points[v]);
        points[v] += (std::clamp(height, options.clearance, options.bridge) - height) * below[v].normal;
      }
    });
  }
  for (std::size_t v = 0; v < count; ++v) {
    mesh.positions[v] = points[v].cast<float>();
  }
  std::vector<Vec3d> normals = smoothNormals(mesh, neighbors, threads);
  ClosestPointTree tree(mesh);
  return {std::move(mesh), std::move(normals), neighbors, std::move(tree), std::move(onTrunk), std::move(onShoulders)};
}

}  // namespace lorica::manikin
