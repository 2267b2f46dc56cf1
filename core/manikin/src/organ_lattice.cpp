#include "organ_lattice.h"

#include <algorithm>
#include <cmath>

#include "lorica/geometry/intersections.h"
#include "lorica/geometry/isosurface.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::manikin {

Lattice Lattice::over(const geometry::Box3d& box, double cell) {
  Lattice lattice;
  lattice.origin = box.min();
  lattice.cell = cell;
  std::size_t total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = static_cast<std::size_t>(std::ceil(box.sizes()[axis] / cell)) + 1;
    lattice.points[static_cast<std::size_t>(axis)] = count;
    total *= count;
  }
  lattice.values.resize(total);
  return lattice;
}

geometry::Box3d Lattice::box() const {
  return {origin, place(points[0] - 1, points[1] - 1, points[2] - 1)};
}

double Lattice::at(const Vec3d& p, double outside) const {
  const Vec3d q = (p - origin) / cell;
  std::array<std::size_t, 3> low{};
  Vec3d share;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (!(q[axis] >= 0.0 && q[axis] <= static_cast<double>(points[a] - 1))) {
      return outside;
    }
    low[a] = std::min(static_cast<std::size_t>(q[axis]), points[a] - 2);
    share[axis] = q[axis] - static_cast<double>(low[a]);
  }
  const double* corner = values.data() + index(low[0], low[1], low[2]);
  const std::size_t up = points[0];
  const std::size_t deep = points[0] * points[1];
  const auto alongX = [&](std::size_t offset) {
    return corner[offset] + share.x() * (corner[offset + 1] - corner[offset]);
  };
  const double near = alongX(0) + share.y() * (alongX(up) - alongX(0));
  const double far = alongX(deep) + share.y() * (alongX(deep + up) - alongX(deep));
  return near + share.z() * (far - near);
}

Vec3d Lattice::project(const Vec3d& p) const {
  Vec3d q = p;
  const double h = 0.5 * cell;
  for (int step = 0; step < 3; ++step) {
    const double value = at(q);
    if (!std::isfinite(value)) {
      return p;
    }
    Vec3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3d d = h * Vec3d::Unit(axis);
      const double after = at(q + d, value);
      const double before = at(q - d, value);
      gradient[axis] = (after - before) / (2.0 * h);
    }
    const double slope2 = std::max(gradient.squaredNorm(), 0.05);
    Vec3d move = -value / slope2 * gradient;
    const double length = move.norm();
    if (length > cell) {
      move *= cell / length;
    }
    q += move;
  }
  return q;
}

void sample(Lattice& lattice, const AnatomyFrame& frame, base::Threads threads,
            const std::function<double(const Level& level, const Vec3d& place)>& field) {
  std::vector<Level> levels(lattice.points[1]);
  for (std::size_t j = 0; j < levels.size(); ++j) {
    levels[j] = frame.level(lattice.place(0, j, 0).y());
  }
  base::parallelFor(lattice.points[2], 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      for (std::size_t j = 0; j < lattice.points[1]; ++j) {
        for (std::size_t i = 0; i < lattice.points[0]; ++i) {
          lattice.values[lattice.index(i, j, k)] = field(levels[j], lattice.place(i, j, k));
        }
      }
    }
  });
}

void stampTube(Lattice& lattice, std::span<const Station> tube, double reach) {
  for (std::size_t s = 0; s + 1 < tube.size(); ++s) {
    const Station& a = tube[s];
    const Station& b = tube[s + 1];
    const Vec3d margin = Vec3d::Constant(std::max(a.radius, b.radius) + reach);
    const Vec3d low = (a.place.cwiseMin(b.place) - margin - lattice.origin) / lattice.cell;
    const Vec3d high = (a.place.cwiseMax(b.place) + margin - lattice.origin) / lattice.cell;
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> last{};
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(axis);
      const double top = static_cast<double>(lattice.points[n] - 1);
      apart = apart || high[axis] < 0.0 || low[axis] > top;
      first[n] = static_cast<std::size_t>(std::clamp(std::ceil(low[axis]), 0.0, top));
      last[n] = static_cast<std::size_t>(std::clamp(std::floor(high[axis]), 0.0, top));
    }
    for (std::size_t k = first[2]; !apart && k <= last[2]; ++k) {
      for (std::size_t j = first[1]; j <= last[1]; ++j) {
        for (std::size_t i = first[0]; i <= last[0]; ++i) {
          double& value = lattice.values[lattice.index(i, j, k)];
          value = std::min(value, taperedCapsule(lattice.place(i, j, k), a.place, b.place, a.radius, b.radius));
        }
      }
    }
  }
}

void blur(Lattice& lattice) {
  const std::array<std::size_t, 3> stride{1, lattice.points[0], lattice.points[0] * lattice.points[1]};
  std::vector<double> line;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t w = (axis + 2) % 3;
    const std::size_t n = lattice.points[axis];
    line.resize(n);
    for (std::size_t a = 0; a < lattice.points[u]; ++a) {
      for (std::size_t b = 0; b < lattice.points[w]; ++b) {
        double* first = lattice.values.data() + a * stride[u] + b * stride[w];
        for (std::size_t i = 0; i < n; ++i) {
          line[i] = first[i * stride[axis]];
        }
        for (std::size_t i = 1; i + 1 < n; ++i) {
          first[i * stride[axis]] = 0.25 * line[i - 1] + 0.5 * line[i] + 0.25 * line[i + 1];
        }
      }
    }
  }
}

bool untangle(geometry::TriangleMesh& mesh, base::Threads threads) {
  constexpr int rounds = 15;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<geometry::TrianglePair> pairs = geometry::selfIntersections(mesh, threads);
    if (pairs.empty()) {
      return true;
    }
    std::vector<bool> moving(mesh.positions.size());
    for (const geometry::TrianglePair& pair : pairs) {
      for (const std::uint32_t t : {pair.first, pair.second}) {
        for (const std::uint32_t vertex : mesh.triangles[t]) {
          moving[vertex] = true;
        }
      }
    }
    for (int ring = 0; ring <= round / 4; ++ring) {
      const std::vector<bool> core = moving;
      for (const geometry::Triangle& t : mesh.triangles) {
        if (core[t[0]] || core[t[1]] || core[t[2]]) {
          moving[t[0]] = moving[t[1]] = moving[t[2]] = true;
        }
      }
    }
    for (int pass = 0; pass < 3; ++pass) {
      std::vector<Vec3d> sums(mesh.positions.size(), Vec3d::Zero());
      std::vector<double> counts(mesh.positions.size(), 0.0);
      for (const geometry::Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          sums[t[k]] += mesh.positions[t[(k + 1) % 3]].cast<double>();
          counts[t[k]] += 1.0;
        }
      }
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (moving[v]) {
          const Vec3d moved = 0.5 * mesh.positions[v].cast<double>() + 0.5 * sums[v] / counts[v];
          mesh.positions[v] = moved.cast<float>();
        }
      }
    }
  }
  return geometry::selfIntersections(mesh, threads).empty();
}

double volumeBelowZero(const Lattice& lattice) {
  double cells = 0.0;
  for (const double value : lattice.values) {
    cells += std::clamp(0.5 - value / lattice.cell, 0.0, 1.0);
  }
  return cells * std::pow(lattice.cell, 3.0);
}

geometry::TriangleMesh surfaceOf(const Lattice& lattice, std::size_t pieces) {
  const auto atPoint = [&](const Vec3d& p) {
    const Vec3d q = (p - lattice.origin) / lattice.cell;
    const auto at = [&](int axis) {
      const auto n = static_cast<std::size_t>(std::lround(q[axis]));
      return std::min(n, lattice.points[static_cast<std::size_t>(axis)] - 1);
    };
    return lattice.values[lattice.index(at(0), at(1), at(2))];
  };
  // Half a cell less, so that rounding cannot add a row of points.
  geometry::Box3d box = lattice.box();
  box.max() -= Vec3d::Constant(0.5 * lattice.cell);
  const geometry::TriangleMesh whole = geometry::isosurface(atPoint, box, lattice.cell);
  const geometry::MeshAudit audit = geometry::audit(whole);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t c = 0; c < audit.components.size(); ++c) {
    order.emplace_back(-audit.components[c].signedVolume, c);
  }
  std::sort(order.begin(), order.end());
  std::vector<bool> kept(order.size());
  for (std::size_t i = 0; i < std::min(pieces, order.size()); ++i) {
    kept[order[i].second] = true;
  }
  geometry::TriangleMesh mesh;
  constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<std::uint32_t> renamed(whole.positions.size(), none);
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    if (!kept[audit.componentOf[t]]) {
      continue;
    }
    geometry::Triangle triangle = whole.triangles[t];
    for (std::uint32_t& vertex : triangle) {
      std::uint32_t& name = renamed[vertex];
      if (name == none) {
        name = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(whole.positions[vertex]);
      }
      vertex = name;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace lorica::manikin
