#include "armor_panel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::manikin {

namespace {

using geometry::ClosestPoint;
using geometry::Triangle;
using geometry::TriangleMesh;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// An open patch of cloth.
struct Patch {
  TriangleMesh mesh;
  std::vector<char> onOutline;  ///< per vertex
};

struct Snap {
  double move = 2.0;  ///< share of an edge
  Vec3d place = Vec3d::Zero();
};

/// Where the outline crosses an edge, as a share of the way.
double crossingShare(const std::function<double(const Vec3d&)>& inside, const Vec3d& a, const Vec3d& b, double fa,
                     double fb) {
  double low = 0.0;
  double high = 1.0;
  double t = fa / (fa - fb);
  for (int step = 0; step < 8; ++step) {
    const double f = inside(a + t * (b - a));
    ((f > 0.0) == (fa > 0.0) ? low : high) = t;
    t = 0.5 * (low + high);
  }
  return t;
}

/// Moves the vertices next to the outline onto it, so that it runs along edges; returns the values there.
std::vector<double> snapToOutline(std::vector<Vec3d>& points, const Cloth& cloth, const std::vector<char>& usable,
                                  const std::function<double(const Vec3d&)>& inside) {
  std::vector<double> value(points.size(), -1.0);
  for (std::size_t v = 0; v < points.size(); ++v) {
    value[v] = usable[v] != 0 ? inside(points[v]) : -1.0;
  }
  std::vector<Snap> snap(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    for (const std::uint32_t n : cloth.neighbors[v]) {
      if (n < v || usable[v] == 0 || usable[n] == 0 || (value[v] > 0.0) == (value[n] > 0.0)) {
        continue;
      }
      const double t = crossingShare(inside, points[v], points[n], value[v], value[n]);
      const std::uint32_t nearer = t <= 0.5 ? v : n;
      const double move = std::min(t, 1.0 - t);
      if (move < snap[nearer].move) {
        snap[nearer] = {move, points[v] + t * (points[n] - points[v])};
      }
    }
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (snap[v].move < 1.0) {
      points[v] = snap[v].place;
      value[v] = 0.0;
    }
  }
  return value;
}

/// Edges with one triangle only, in the direction of that triangle.
std::set<Edge> borderOf(const std::vector<Triangle>& triangles) {
  std::set<Edge> border;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge{t[k], t[(k + 1) % 3]};
      if (border.erase({edge.second, edge.first}) == 0) {
        border.insert(edge);
      }
    }
  }
  return border;
}

/// Keeps the largest part and takes triangles away until every vertex has one fan and no triangle hangs on by one edge.
void tidy(std::vector<Triangle>& triangles, const geometry::Positions& positions) {
  for (bool changed = true; changed;) {
    changed = false;
    const geometry::MeshAudit audit = geometry::audit({positions, triangles});
    std::size_t largest = 0;
    for (std::size_t c = 1; c < audit.components.size(); ++c) {
      largest = audit.components[c].triangles > audit.components[largest].triangles ? c : largest;
    }
    const std::set<Edge> border = borderOf(triangles);
    std::map<std::uint32_t, int> leaving;
    for (const Edge& edge : border) {
      ++leaving[edge.first];
    }
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Triangle& corner = triangles[t];
      int open = 0;
      bool pinched = false;
      for (std::size_t k = 0; k < 3; ++k) {
        open += border.contains({corner[k], corner[(k + 1) % 3]}) ? 1 : 0;
        const auto found = leaving.find(corner[k]);
        pinched = pinched || (found != leaving.end() && found->second > 1);
      }
      if (audit.componentOf[t] == largest && open < 2 && !(pinched && open > 0)) {
        kept.push_back(corner);
      }
    }
    changed = kept.size() != triangles.size();
    triangles = std::move(kept);
  }
}

Patch extract(const std::vector<Vec3d>& points, const std::vector<double>& value, const Cloth& cloth,
              const std::function<double(const Vec3d&)>& inside) {
  std::vector<Triangle> kept;
  for (const Triangle& t : cloth.mesh.triangles) {
    const double low = std::min({value[t[0]], value[t[1]], value[t[2]]});
    const double high = std::max({value[t[0]], value[t[1]], value[t[2]]});
    if (low >= 0.0 && (high > 0.0 || inside((points[t[0]] + points[t[1]] + points[t[2]]) / 3.0) > 0.0)) {
      kept.push_back(t);
    }
  }
  tidy(kept, cloth.mesh.positions);
  LORICA_CHECK(!kept.empty(), "an outline that encloses cloth");
  Patch patch;
  std::vector<std::uint32_t> index(points.size(), UINT32_MAX);
  for (Triangle t : kept) {
    for (std::uint32_t& v : t) {
      if (index[v] == UINT32_MAX) {
        index[v] = static_cast<std::uint32_t>(patch.mesh.positions.size());
        patch.mesh.positions.emplace_back(points[v].cast<float>());
      }
      v = index[v];
    }
    patch.mesh.triangles.push_back(t);
  }
  patch.onOutline.assign(patch.mesh.positions.size(), 0);
  for (const Edge& edge : borderOf(patch.mesh.triangles)) {
    patch.onOutline[edge.first] = 1;
  }
  return patch;
}

/// The nearest point of the outline, by its slope.
Vec3d ontoOutline(const std::function<double(const Vec3d&)>& inside, Vec3d p) {
  constexpr double h = 1e-4;
  for (int step = 0; step < 2; ++step) {
    Vec3d slope;
    for (int axis = 0; axis < 3; ++axis) {
      slope[axis] = (inside(p + h * Vec3d::Unit(axis)) - inside(p - h * Vec3d::Unit(axis))) / (2.0 * h);
    }
    const Vec3d move = -inside(p) * slope / std::max(slope.squaredNorm(), 0.05);
    p += move.norm() > 0.004 ? Vec3d(0.004 * move.normalized()) : move;
  }
  return p;
}

/// Evens the triangles: each vertex goes to the middle of its neighbours, back onto the cloth and the outline.
void even(Patch& patch, const Cloth& cloth, const std::function<double(const Vec3d&)>& inside, base::Threads threads) {
  const auto neighbors = vertexNeighbors(patch.mesh);
  const std::set<Edge> border = borderOf(patch.mesh.triangles);
  const auto isBorder = [&](std::uint32_t a, std::uint32_t b) {
    return border.contains({a, b}) || border.contains({b, a});
  };
  std::vector<std::vector<std::uint32_t>> along = neighbors;
  for (std::uint32_t v = 0; v < along.size(); ++v) {
    if (patch.onOutline[v] != 0) {
      std::erase_if(along[v], [&](std::uint32_t n) { return !isBorder(v, n); });
    }
  }
  std::vector<Vec3d> points;
  for (const geometry::Vec3f& position : patch.mesh.positions) {
    points.emplace_back(position.cast<double>());
  }
  for (int round = 0; round < 12; ++round) {
    std::vector<Vec3d> moved = points;
    base::parallelFor(points.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        Vec3d mean = Vec3d::Zero();
        for (const std::uint32_t n : along[v]) {
          mean += points[n];
        }
        mean /= static_cast<double>(along[v].size());
        Vec3d p = points[v] + 0.5 * (mean - points[v]);
        if (patch.onOutline[v] != 0) {
          p = ontoOutline(inside, p);
        }
        moved[v] = cloth.tree.closest(p)->point;
      }
    });
    points = std::move(moved);
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    patch.mesh.positions[v] = points[v].cast<float>();
  }
}

/// Weights of the nearest skin, smoothed over the patch.
std::vector<std::vector<double>> smoothWeights(const Patch& patch, const Body& body,
                                               const geometry::ClosestPointTree& skin, base::Threads threads) {
  const std::size_t joints = body.skeleton.size();
  const auto neighbors = vertexNeighbors(patch.mesh);
  std::vector<std::vector<double>> weights(patch.mesh.positions.size(), std::vector<double>(joints, 0.0));
  base::parallelFor(weights.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const ClosestPoint place = *skin.closest(patch.mesh.positions[v].cast<double>());
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t corner = body.skin.triangles[place.triangle][c] * body.weights.influences;
        for (std::size_t k = 0; k < body.weights.influences; ++k) {
          weights[v][body.weights.joints[corner + k]] +=
              place.barycentric[static_cast<Eigen::Index>(c)] * static_cast<double>(body.weights.weights[corner + k]);
        }
      }
    }
  });
  // Once: where the cloth bridges a hollow its nearest skin changes at once; more would make it lag behind the skin.
  std::vector<std::vector<double>> smooth = weights;
  base::parallelFor(weights.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      for (std::size_t j = 0; j < joints; ++j) {
        double mean = 0.0;
        for (const std::uint32_t n : neighbors[v]) {
          mean += weights[n][j];
        }
        smooth[v][j] = 0.5 * (weights[v][j] + mean / static_cast<double>(neighbors[v].size()));
      }
    }
  });
  return smooth;
}

human::SkinWeights packed(const std::vector<std::vector<double>>& weights) {
  const std::size_t joints = weights.front().size();
  std::vector<human::Influence> influences;
  influences.reserve(2 * weights.size() * joints);
  for (int face = 0; face < 2; ++face) {
    for (const std::vector<double>& row : weights) {
      for (std::uint32_t j = 0; j < joints; ++j) {
        influences.push_back({j, row[j]});
      }
    }
  }
  return human::normaliseWeights(influences, joints, 4).weights;
}

/// The patch between two heights over the cloth.
Panel shell(const Patch& patch, const Cloth& cloth, const PanelCut& cut) {
  Panel panel;
  const std::size_t count = patch.mesh.positions.size();
  std::vector<Vec3d> normals(count);
  TriangleMesh middle = patch.mesh;
  panel.mesh.positions.resize(2 * count);
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3d p = patch.mesh.positions[v].cast<double>();
    const ClosestPoint place = *cloth.tree.closest(p);
    const Triangle& t = cloth.mesh.triangles[place.triangle];
    const Vec3d normal = (place.barycentric[0] * cloth.normals[t[0]] + place.barycentric[1] * cloth.normals[t[1]] +
                          place.barycentric[2] * cloth.normals[t[2]])
                             .normalized();
    const double height = cut.height(p);
    panel.mesh.positions[v] = (p + height * normal).cast<float>();
    panel.mesh.positions[count + v] = (p + (height + cut.thickness) * normal).cast<float>();
    middle.positions[v] = (p + (height + 0.5 * cut.thickness) * normal).cast<float>();
  }
  const auto outer = static_cast<std::uint32_t>(count);
  for (const Triangle& t : patch.mesh.triangles) {
    panel.mesh.triangles.push_back({t[0], t[2], t[1]});
    panel.mesh.triangles.push_back({t[0] + outer, t[1] + outer, t[2] + outer});
  }
  for (const Edge& edge : borderOf(patch.mesh.triangles)) {
    panel.mesh.triangles.push_back({edge.first, edge.second, edge.second + outer});
    panel.mesh.triangles.push_back({edge.first, edge.second + outer, edge.first + outer});
  }
  panel.middleArea = geometry::area(middle);
  return panel;
}

}  // namespace

Panel cutPanel(const Cloth& cloth, const PanelCut& cut, const Body& body, const geometry::ClosestPointTree& skin,
               base::Threads threads) {
  std::vector<Vec3d> points;
  points.reserve(cloth.mesh.positions.size());
  for (const geometry::Vec3f& position : cloth.mesh.positions) {
    points.emplace_back(position.cast<double>());
  }
  const std::vector<double> value =
      snapToOutline(points, cloth, cut.onArms ? cloth.shoulders : cloth.trunk, cut.inside);
  Patch patch = extract(points, value, cloth, cut.inside);
  even(patch, cloth, cut.inside, threads);
  Panel panel = shell(patch, cloth, cut);
  panel.weights = packed(smoothWeights(patch, body, skin, threads));
  return panel;
}

}  // namespace lorica::manikin
