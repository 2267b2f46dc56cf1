#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "organ_shapes.h"
#include "vessel_routes.h"

namespace lorica::manikin {

namespace {

using std::numbers::pi;

/// Corners around a tube that is this wide.
std::size_t sidesFor(double radius) {
  return radius < 0.0024 ? 6 : radius < 0.0040 ? 8 : radius < 0.0055 ? 10 : radius < 0.0075 ? 12 : 16;
}

/// A closed round of vertices, counter-clockwise seen against the direction in which the tube runs.
using Loop = std::vector<std::uint32_t>;

struct Ring {
  Loop loop;
  Vec3d centre;
  Vec3d along;  ///< unit
  double radius = 0.0;
};

/// Rings of one vessel; the wall between ring i and i + 1 lacks what its branches took.
struct Tube {
  std::optional<Station> mouth;  ///< where it leaves its parent's wall
  std::vector<Ring> rings;
  std::vector<std::vector<bool>> open;  ///< per gap between rings and side
};

/// Sweeps tubes along the vessels and lets each branch grow out of a hole in its parent's wall.
class Sweeper {
 public:
  explicit Sweeper(const std::vector<Vessel>& vessels) : vessels_(vessels), tubes_(vessels.size()) {}

  VesselSurface run(bool arteries) {
    for (std::size_t v = 0; v < vessels_.size(); ++v) {
      if (vessels_[v].artery == arteries) {
        vessels_[v].parent ? growBranch(v) : growRoot(v);
      }
    }
    for (std::size_t v = 0; v < vessels_.size(); ++v) {
      if (vessels_[v].artery == arteries) {
        closeWalls(tubes_[v]);
      }
    }
    soften();
    // The corners inside the holes have gone.
    VesselSurface surface;
    geometry::TriangleMesh& mesh = surface.mesh;
    constexpr std::uint32_t none = 0xFFFFFFFF;
    std::vector<std::uint32_t> renamed(points_.size(), none);
    for (geometry::Triangle triangle : triangles_) {
      for (std::uint32_t& vertex : triangle) {
        std::uint32_t& name = renamed[vertex];
        if (name == none) {
          name = static_cast<std::uint32_t>(mesh.positions.size());
          mesh.positions.push_back(points_[vertex].cast<float>());
        }
        vertex = name;
      }
      mesh.triangles.push_back(triangle);
    }
    for (const Tube& tube : tubes_) {
      std::vector<Station> stations;
      if (tube.mouth) {
        stations.push_back(*tube.mouth);
      }
      for (const Ring& ring : tube.rings) {
        stations.push_back({ring.centre, ring.radius});
      }
      if (!stations.empty()) {
        surface.tubes.push_back(std::move(stations));
      }
    }
    return surface;
  }

 private:
  std::uint32_t addPoint(const Vec3d& p) {
    points_.push_back(p);
    soft_.push_back(false);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  /// A ring whose polygon has the circle's area; its first corner lies as near to `up` as it can.
  Ring ring(const Vec3d& centre, const Vec3d& along, const Vec3d& up, double radius, std::size_t sides) {
    const Vec3d u = (up - up.dot(along) * along).normalized();
    const Vec3d w = along.cross(u);
    const double step = 2.0 * pi / static_cast<double>(sides);
    const double corner = radius * std::sqrt(step / std::sin(step));
    Ring made{{}, centre, along, radius};
    for (std::size_t k = 0; k < sides; ++k) {
      const double angle = step * static_cast<double>(k);
      made.loop.push_back(addPoint(centre + corner * (std::cos(angle) * u + std::sin(angle) * w)));
    }
    return made;
  }

  /// Rings along a course from its arc length `begin` to its end.
  void sweep(std::size_t v, const std::vector<Station>& course, double begin, Vec3d up) {
    Tube& tube = tubes_[v];
    std::vector<double> arc(course.size(), 0.0);
    for (std::size_t i = 1; i < course.size(); ++i) {
      arc[i] = arc[i - 1] + (course[i].place - course[i - 1].place).norm();
    }
    const auto at = [&](double s) -> Station {
      const auto i = std::clamp<std::size_t>(
          static_cast<std::size_t>(std::upper_bound(arc.begin(), arc.end(), s) - arc.begin()), 1, arc.size() - 1);
      const double share = std::clamp((s - arc[i - 1]) / std::max(arc[i] - arc[i - 1], 1e-12), 0.0, 1.0);
      return {course[i - 1].place + share * (course[i].place - course[i - 1].place),
              course[i - 1].radius + share * (course[i].radius - course[i - 1].radius)};
    };
    double s = begin;
    std::size_t sides = sidesFor(at(s).radius);
    while (true) {
      const Station here = at(s);
      const double reach = std::max(0.6 * here.radius, 0.0015);
      const Vec3d along = (at(s + reach).place - at(s - reach).place).normalized();
      // Fewer corners only where the tube is clearly thinner, so that the rings of one stretch match.
      while (sides > 6 && sidesFor(1.1 * here.radius) < sides) {
        sides -= sides == 16 ? 4 : 2;
      }
      tube.rings.push_back(ring(here.place, along, up, here.radius, sides));
      up = points_[tube.rings.back().loop[0]] - here.place;
      if (s >= arc.back()) {
        break;
      }
      const double side = 2.0 * pi * here.radius / static_cast<double>(sides);
      const double stretch = here.radius > 0.006 ? 1.2 : here.radius > 0.003 ? 1.8 : 2.4;
      const double rest = arc.back() - s;
      const double step = stretch * side;
      s = rest < 1.5 * step ? arc.back() : s + step;
    }
    for (std::size_t i = 0; i + 1 < tube.rings.size(); ++i) {
      tube.open.emplace_back(tube.rings[i].loop.size(), false);
    }
  }

  static Vec3d anyAcross(const Vec3d& along) {
    const Vec3d axis = std::abs(along.x()) < 0.8 ? Vec3d(Vec3d::UnitX()) : Vec3d(Vec3d::UnitZ());
    return axis - axis.dot(along) * along;
  }

  void growRoot(std::size_t v) {
    const std::vector<Station>& course = vessels_[v].stations;
    sweep(v, course, 0.0, anyAcross((course[1].place - course[0].place).normalized()));
    cap(tubes_[v].rings.front(), false);
    cap(tubes_[v].rings.back(), true);
  }

  /// A dome over an end: a narrower ring, then a point.
  void cap(const Ring& end, bool ahead) {
    const Vec3d out = ahead ? end.along : Vec3d(-end.along);
    Loop inner;
    for (const std::uint32_t vertex : end.loop) {
      inner.push_back(addPoint(end.centre + 0.45 * end.radius * out + 0.66 * (points_[vertex] - end.centre)));
    }
    const std::uint32_t tip = addPoint(end.centre + 0.70 * end.radius * out);
    if (ahead) {
      zip(end.loop, inner);
    } else {
      zip(inner, end.loop);
    }
    for (std::size_t k = 0; k < inner.size(); ++k) {
      const std::uint32_t a = inner[k];
      const std::uint32_t b = inner[(k + 1) % inner.size()];
      triangles_.push_back(ahead ? geometry::Triangle{a, b, tip} : geometry::Triangle{b, a, tip});
    }
  }

  /// Triangles between two rounds, `next` lying further along; whatever their numbers of corners.
  void zip(const Loop& loop, const Loop& next) {
    const std::size_t n = loop.size();
    const std::size_t m = next.size();
    // Of all ways to begin, the one with the shortest rungs.
    std::size_t best = 0;
    double shortest = 1e30;
    for (std::size_t start = 0; start < m; ++start) {
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t other = (start + (k * m + n / 2) / n) % m;
        sum += (points_[loop[k]] - points_[next[other]]).squaredNorm();
      }
      if (sum < shortest) {
        shortest = sum;
        best = start;
      }
    }
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < n || j < m) {
      const std::uint32_t a = loop[i % n];
      const std::uint32_t b = next[(best + j) % m];
      const std::uint32_t aNext = loop[(i + 1) % n];
      const std::uint32_t bNext = next[(best + j + 1) % m];
      const double forward = (points_[aNext] - points_[b]).squaredNorm();
      const double upward = (points_[bNext] - points_[a]).squaredNorm();
      // Neither round runs ahead of the other by a whole side; within that the shorter rung wins.
      const double lead = (static_cast<double>(i) + 0.5) / static_cast<double>(n) -
                          (static_cast<double>(j) + 0.5) / static_cast<double>(m);
      const double most = 0.75 / static_cast<double>(std::min(n, m));
      const bool preferred = lead > most ? false : lead < -most || forward <= upward;
      const bool stepLoop = j >= m || (i < n && preferred);
      if (stepLoop) {
        triangles_.push_back({a, aNext, b});
        ++i;
      } else {
        triangles_.push_back({a, bNext, b});
        ++j;
      }
    }
  }

  void closeWalls(const Tube& tube) {
    for (std::size_t i = 0; i + 1 < tube.rings.size(); ++i) {
      const Loop& loop = tube.rings[i].loop;
      const Loop& next = tube.rings[i + 1].loop;
      if (loop.size() != next.size()) {
        zip(loop, next);
        continue;
      }
      const std::size_t n = loop.size();
      for (std::size_t k = 0; k < n; ++k) {
        if (tube.open[i][k]) {
          continue;
        }
        const std::uint32_t a = loop[k];
        const std::uint32_t b = loop[(k + 1) % n];
        const std::uint32_t c = next[(k + 1) % n];
        const std::uint32_t d = next[k];
        if ((points_[a] - points_[c]).squaredNorm() <= (points_[b] - points_[d]).squaredNorm()) {
          triangles_.push_back({a, b, c});
          triangles_.push_back({a, c, d});
        } else {
          triangles_.push_back({a, b, d});
          triangles_.push_back({b, c, d});
        }
      }
    }
  }

  struct Hole {
    std::size_t firstRing = 0, rings = 0;
    std::size_t firstSide = 0, sides = 0;
  };

  bool fits(const Tube& tube, const Hole& hole) const {
    if (hole.firstRing + hole.rings + 1 > tube.rings.size()) {
      return false;
    }
    const std::size_t n = tube.rings[hole.firstRing].loop.size();
    // One untouched ring of wall around the hole on every side.
    const std::size_t low = hole.firstRing == 0 ? 0 : hole.firstRing - 1;
    const std::size_t high = std::min(hole.firstRing + hole.rings + 1, tube.open.size());
    for (std::size_t i = hole.firstRing; i <= hole.firstRing + hole.rings; ++i) {
      if (tube.rings[i].loop.size() != n) {
        return false;
      }
    }
    for (std::size_t i = low; i < high; ++i) {
      for (std::size_t k = 0; k < hole.sides + 2 && tube.open[i].size() == n; ++k) {
        if (tube.open[i][(hole.firstSide + n - 1 + k) % n]) {
          return false;
        }
      }
    }
    return true;
  }

  /// The free patch of the parent's wall that is nearest to where the branch wants to leave.
  Hole findHole(const Tube& parent, const Vec3d& from, const Vec3d& towards, double radius) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < parent.rings.size(); ++i) {
      if ((parent.rings[i].centre - from).squaredNorm() < (parent.rings[nearest].centre - from).squaredNorm()) {
        nearest = i;
      }
    }
    std::optional<Hole> best;
    double bestCost = 1e30;
    const std::size_t low = nearest > 14 ? nearest - 14 : 0;
    for (std::size_t first = low; first < std::min(nearest + 14, parent.open.size()); ++first) {
      const Ring& ring = parent.rings[first];
      const std::size_t n = ring.loop.size();
      const double side = 2.0 * pi * ring.radius / static_cast<double>(n);
      const double length = (parent.rings[first + 1].centre - ring.centre).norm();
      Hole hole;
      hole.firstRing = first;
      hole.sides = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(2.1 * radius / side)), 1, n / 2 - 1);
      hole.rings = std::max<std::size_t>(static_cast<std::size_t>(std::lround(2.3 * radius / length)), 1);
      if (hole.sides + hole.rings < 3) {
        hole.sides = 2;
      }
      for (hole.firstSide = 0; hole.firstSide < n; ++hole.firstSide) {
        if (!fits(parent, hole)) {
          continue;
        }
        const Vec3d centre = centreOf(rim(parent, hole));
        const Vec3d middle = 0.5 * (ring.centre + parent.rings[first + hole.rings].centre);
        const Vec3d out = (centre - middle).normalized();
        const Vec3d wanted = (towards - middle).normalized();
        const double slip = (middle - from).norm();
        const double cost = slip / ring.radius + 1.6 * (1.0 - out.dot(wanted));
        if (cost < bestCost) {
          bestCost = cost;
          best = hole;
        }
      }
    }
    LORICA_CHECK(best.has_value(), "a vessel's wall has room for its branches");
    return *best;
  }

  Vec3d centreOf(const Loop& loop) const {
    Vec3d sum = Vec3d::Zero();
    for (const std::uint32_t vertex : loop) {
      sum += points_[vertex];
    }
    return sum / static_cast<double>(loop.size());
  }

  /// The vertices around a hole, counter-clockwise seen from outside.
  static Loop rim(const Tube& tube, const Hole& hole) {
    const std::size_t n = tube.rings[hole.firstRing].loop.size();
    const auto vertex = [&](std::size_t i, std::size_t k) {
      return tube.rings[hole.firstRing + i].loop[(hole.firstSide + k) % n];
    };
    Loop loop;
    for (std::size_t k = 0; k < hole.sides; ++k) {
      loop.push_back(vertex(0, k));
    }
    for (std::size_t i = 0; i < hole.rings; ++i) {
      loop.push_back(vertex(i, hole.sides));
    }
    for (std::size_t k = hole.sides; k > 0; --k) {
      loop.push_back(vertex(hole.rings, k));
    }
    for (std::size_t i = hole.rings; i > 0; --i) {
      loop.push_back(vertex(i, 0));
    }
    return loop;
  }

  void growBranch(std::size_t v) {
    const Vessel& vessel = vessels_[v];
    Tube& parent = tubes_[*vessel.parent];
    const Station& root = vessels_[*vessel.parent].stations[vessel.leaves];
    const double radius = vessel.stations.front().radius;
    // The course joins where it has left the parent's wall behind.
    std::size_t join = 1;
    const double clear = root.radius + 2.2 * radius;
    while (join + 1 < vessel.stations.size() && (vessel.stations[join].place - root.place).norm() < clear) {
      ++join;
    }
    const Vec3d target = vessel.stations[join].place;
    const Hole hole = findHole(parent, root.place, target, radius);
    for (std::size_t i = 0; i < hole.rings; ++i) {
      for (std::size_t k = 0; k < hole.sides; ++k) {
        const std::size_t n = parent.rings[hole.firstRing].loop.size();
        parent.open[hole.firstRing + i][(hole.firstSide + k) % n] = true;
      }
    }
    const Loop edge = rim(parent, hole);
    const Vec3d mouth = centreOf(edge);
    Vec3d normal = Vec3d::Zero();
    for (std::size_t k = 0; k < edge.size(); ++k) {
      normal += (points_[edge[k]] - mouth).cross(points_[edge[(k + 1) % edge.size()]] - mouth);
    }
    normal.normalize();
    double rim = 0.0;
    for (const std::uint32_t vertex : edge) {
      rim = std::max(rim, (points_[vertex] - mouth).norm());
    }
    tubes_[v].mouth = Station{mouth, std::min(rim, root.radius)};
    // Out of the wall at an angle of 40 degrees at least, far enough for the first ring to clear the wall.
    constexpr double leastRise = 0.64;
    Vec3d out = (target - mouth).normalized();
    if (out.dot(normal) < leastRise) {
      const Vec3d level = out - out.dot(normal) * normal;
      out = leastRise * normal + std::sqrt(1.0 - leastRise * leastRise) * level.normalized();
    }
    const double rise = out.dot(normal);
    const double tilt = std::sqrt(std::max(1.0 - rise * rise, 0.0));
    const double first = std::max((0.3 + tilt) * radius / rise, 0.7 * radius);
    std::vector<Station> course{{mouth, radius}, {mouth + first * out, radius}, {mouth + 1.6 * first * out, radius}};
    course.insert(course.end(), vessel.stations.begin() + static_cast<std::ptrdiff_t>(join), vessel.stations.end());
    const std::vector<Station> smooth = smoothTube(course, 0.3 * radius);
    const Vec3d up = points_[edge.front()] - mouth;
    sweep(v, smooth, first, up);
    zip(edge, tubes_[v].rings.front().loop);
    cap(tubes_[v].rings.back(), true);
    for (const std::uint32_t vertex : edge) {
      soft_[vertex] = true;
    }
    for (const std::uint32_t vertex : tubes_[v].rings.front().loop) {
      soft_[vertex] = true;
    }
  }

  /// Rounds the forks off: their vertices move towards the middle of their neighbours.
  void soften() {
    std::vector<std::vector<std::uint32_t>> neighbours(points_.size());
    for (const geometry::Triangle& t : triangles_) {
      for (std::size_t k = 0; k < 3; ++k) {
        neighbours[t[k]].push_back(t[(k + 1) % 3]);
      }
    }
    for (int round = 0; round < 4; ++round) {
      std::vector<Vec3d> moved = points_;
      for (std::size_t v = 0; v < points_.size(); ++v) {
        if (!soft_[v] || neighbours[v].empty()) {
          continue;
        }
        Vec3d sum = Vec3d::Zero();
        for (const std::uint32_t other : neighbours[v]) {
          sum += points_[other];
        }
        moved[v] = 0.5 * points_[v] + 0.5 * sum / static_cast<double>(neighbours[v].size());
      }
      points_ = std::move(moved);
    }
  }

  const std::vector<Vessel>& vessels_;
  std::vector<Tube> tubes_;
  std::vector<Vec3d> points_;
  std::vector<bool> soft_;
  std::vector<geometry::Triangle> triangles_;
};

}  // namespace

VesselSurface vesselSurface(const std::vector<Vessel>& vessels, bool arteries) {
  return Sweeper(vessels).run(arteries);
}

}  // namespace lorica::manikin
