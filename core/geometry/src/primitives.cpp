#include "lorica/geometry/primitives.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "lorica/base/error.h"

namespace lorica::geometry {

void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  for (const Triangle& triangle : part.triangles) {
    mesh.triangles.push_back({triangle[0] + shift, triangle[1] + shift, triangle[2] + shift});
  }
}

TriangleMesh ellipsoid(const Vec3d& centre, const Vec3d& semiAxes, int subdivisions) {
  LORICA_CHECK(subdivisions >= 0 && subdivisions <= 9, "0 to 9 subdivisions");
  const double golden = std::numbers::phi;
  std::vector<Vec3d> directions;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      directions.push_back(Vec3d(0, a, b).normalized());
      directions.push_back(Vec3d(a, b, 0).normalized());
      directions.push_back(Vec3d(b, 0, a).normalized());
    }
  }
  std::vector<Triangle> triangles;
  const double edge = 2.0 / std::sqrt(1.0 + golden * golden) * 1.01;
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if ((directions[i] - directions[j]).norm() < edge && (directions[j] - directions[k]).norm() < edge &&
            (directions[k] - directions[i]).norm() < edge) {
          const bool outward = directions[i].dot(directions[j].cross(directions[k])) > 0.0;
          triangles.push_back(outward ? Triangle{i, j, k} : Triangle{i, k, j});
        }
      }
    }
  }
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(directions.size()));
      if (isNew) {
        directions.push_back((directions[a] + directions[b]).normalized());
      }
      return place->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(triangles.size() * 4);
    for (const Triangle& t : triangles) {
      const std::uint32_t ab = middle(t[0], t[1]);
      const std::uint32_t bc = middle(t[1], t[2]);
      const std::uint32_t ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  TriangleMesh mesh;
  mesh.triangles = std::move(triangles);
  mesh.positions.reserve(directions.size());
  for (const Vec3d& direction : directions) {
    mesh.positions.emplace_back((centre + direction.cwiseProduct(semiAxes)).cast<float>());
  }
  return mesh;
}

TriangleMesh box(const Vec3d& low, const Vec3d& high) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions.emplace_back(Vec3d((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                                      (corner & 4) != 0 ? high.z() : low.z())
                                    .cast<float>());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace lorica::geometry
