#include "lorica/geometry/intersections.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "triangle_boxes.h"

namespace lorica::geometry {

namespace {

/// Differences of the floats of one scene have some 30 bits, so triple products of them are exact in this type.
__extension__ using Quad = __float128;

using Corners = std::array<Vec3d, 3>;

int signOf(double value) {
  return (value > 0.0 ? 1 : 0) - (value < 0.0 ? 1 : 0);
}

/// On which side of the plane through a, b and c the point lies: 1 where the three turn counter-clockwise seen from it.
int side(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& point) {
  const Vec3d u = b - a;
  const Vec3d v = c - a;
  const Vec3d w = point - a;
  const double volume = u.cross(v).dot(w);
  const double noise = 1e-14 * u.cwiseAbs().maxCoeff() * v.cwiseAbs().maxCoeff() * w.cwiseAbs().maxCoeff();
  if (std::abs(volume) > noise) {
    return signOf(volume);
  }
  std::array<Quad, 9> m{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    m[k] = Quad(b[axis]) - Quad(a[axis]);
    m[3 + k] = Quad(c[axis]) - Quad(a[axis]);
    m[6 + k] = Quad(point[axis]) - Quad(a[axis]);
  }
  const Quad exact =
      m[6] * (m[1] * m[5] - m[2] * m[4]) + m[7] * (m[2] * m[3] - m[0] * m[5]) + m[8] * (m[0] * m[4] - m[1] * m[3]);
  return (exact > 0 ? 1 : 0) - (exact < 0 ? 1 : 0);
}

/// The turn from a over b to c in the plane that is left when one axis is dropped.
int turn(const Vec3d& a, const Vec3d& b, const Vec3d& c, Eigen::Index dropped) {
  const Eigen::Index x = (dropped + 1) % 3;
  const Eigen::Index y = (dropped + 2) % 3;
  const double area = (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
  const double noise = 1e-15 * (std::abs((b[x] - a[x]) * (c[y] - a[y])) + std::abs((b[y] - a[y]) * (c[x] - a[x])));
  if (std::abs(area) > noise) {
    return signOf(area);
  }
  const Quad exact =
      (Quad(b[x]) - Quad(a[x])) * (Quad(c[y]) - Quad(a[y])) - (Quad(b[y]) - Quad(a[y])) * (Quad(c[x]) - Quad(a[x]));
  return (exact > 0 ? 1 : 0) - (exact < 0 ? 1 : 0);
}

bool hasArea(const Corners& t) {
  return turn(t[0], t[1], t[2], 0) != 0 || turn(t[0], t[1], t[2], 1) != 0 || turn(t[0], t[1], t[2], 2) != 0;
}

/// Whether c, known to be on the line through a and b, lies between them.
bool between(const Vec3d& a, const Vec3d& b, const Vec3d& c, Eigen::Index dropped) {
  for (const Eigen::Index axis : {(dropped + 1) % 3, (dropped + 2) % 3}) {
    if (c[axis] < std::min(a[axis], b[axis]) || c[axis] > std::max(a[axis], b[axis])) {
      return false;
    }
  }
  return true;
}

bool segmentsMeetInPlane(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b, Eigen::Index dropped) {
  const int sa = turn(p, q, a, dropped);
  const int sb = turn(p, q, b, dropped);
  const int sp = turn(a, b, p, dropped);
  const int sq = turn(a, b, q, dropped);
  if (sa * sb < 0 && sp * sq < 0) {
    return true;
  }
  return (sa == 0 && between(p, q, a, dropped)) || (sb == 0 && between(p, q, b, dropped)) ||
         (sp == 0 && between(a, b, p, dropped)) || (sq == 0 && between(a, b, q, dropped));
}

/// For a segment in the triangle's plane.
bool meetInPlane(const Vec3d& p, const Vec3d& q, const Corners& t) {
  Eigen::Index dropped = 0;
  (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs().maxCoeff(&dropped);
  while (turn(t[0], t[1], t[2], dropped) == 0) {
    dropped = (dropped + 1) % 3;  // a sliver whose area is below rounding
  }
  const int whole = turn(t[0], t[1], t[2], dropped);
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    inside = inside && turn(t[k], t[(k + 1) % 3], p, dropped) * whole >= 0;
    if (segmentsMeetInPlane(p, q, t[k], t[(k + 1) % 3], dropped)) {
      return true;
    }
  }
  return inside;
}

/// How the closed segment from p to q meets the closed triangle.
Meeting meetingOfSegment(const Vec3d& p, const Vec3d& q, const Corners& t) {
  const int sp = side(t[0], t[1], t[2], p);
  const int sq = side(t[0], t[1], t[2], q);
  if (sp * sq > 0) {
    return Meeting::none;
  }
  if (sp == 0 && sq == 0) {
    return meetInPlane(p, q, t) ? Meeting::touching : Meeting::none;
  }
  const std::array<int, 3> around{side(p, q, t[0], t[1]), side(p, q, t[1], t[2]), side(p, q, t[2], t[0])};
  const auto [low, high] = std::minmax({around[0], around[1], around[2]});
  if (low < 0 && high > 0) {
    return Meeting::none;
  }
  return sp != 0 && sq != 0 && low == high ? Meeting::crossing : Meeting::touching;
}

Meeting stronger(Meeting a, Meeting b) {
  return std::max(a, b);
}

Meeting meetingOf(const Corners& first, const Corners& second) {
  Meeting found = Meeting::none;
  for (std::size_t k = 0; k < 3 && found != Meeting::crossing; ++k) {
    found = stronger(found, meetingOfSegment(first[k], first[(k + 1) % 3], second));
    found = stronger(found, meetingOfSegment(second[k], second[(k + 1) % 3], first));
  }
  return found;
}

Corners cornersOf(const TriangleMesh& mesh, std::size_t triangle) {
  return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

/// Places in two triangles of their common vertices.
struct Common {
  std::size_t count = 0;
  std::array<std::size_t, 3> inFirst{};
  std::array<std::size_t, 3> inSecond{};
};

Common commonVertices(const Triangle& first, const Triangle& second) {
  Common common;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (first[i] == second[j] && common.count < 3) {
        common.inFirst[common.count] = i;
        common.inSecond[common.count] = j;
        ++common.count;
      }
    }
  }
  return common;
}

/// Whether the faces at a common edge enclose less than an angle.
bool folded(const Corners& first, const Corners& second, const Common& common, double angle) {
  const Vec3d& origin = first[common.inFirst[0]];
  const Vec3d edge = (first[common.inFirst[1]] - origin).normalized();
  const auto height = [&](const Vec3d& apex) {
    const Vec3d arm = apex - origin;
    return Vec3d(arm - edge.dot(arm) * edge);
  };
  const Vec3d u = height(first[3 - common.inFirst[0] - common.inFirst[1]]);
  const Vec3d v = height(second[3 - common.inSecond[0] - common.inSecond[1]]);
  return std::atan2(u.cross(v).norm(), u.dot(v)) < angle;
}

/// Triangles that meet at a vertex meet again only where the side across from it meets the other triangle: what they
/// share is convex, so it reaches from the vertex to one of these sides.
Meeting meetingBeyond(const Corners& first, const Corners& second, const Common& common) {
  const std::size_t i = common.inFirst[0];
  const std::size_t j = common.inSecond[0];
  return stronger(meetingOfSegment(first[(i + 1) % 3], first[(i + 2) % 3], second),
                  meetingOfSegment(second[(j + 1) % 3], second[(j + 2) % 3], first));
}

bool meetWithin(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second,
                const IntersectionOptions& options) {
  const Corners a = cornersOf(mesh, first);
  const Corners b = cornersOf(mesh, second);
  if (!hasArea(a) || !hasArea(b)) {
    return false;
  }
  const Meeting least = options.touching ? Meeting::touching : Meeting::crossing;
  const Common common = commonVertices(mesh.triangles[first], mesh.triangles[second]);
  switch (common.count) {
    case 0:
      return meetingOf(a, b) >= least;
    case 1:
      return meetingBeyond(a, b, common) >= least;
    case 2:
      return folded(a, b, common, options.foldedBelow);
    default:
      return true;
  }
}

/// Runs `find(triangle, pairs)` for every triangle and joins what it appends, in the order of the triangles.
template <class Find>
std::vector<TrianglePair> gathered(std::size_t triangles, base::Threads threads, const Find& find) {
  constexpr std::size_t blockSize = 256;
  std::vector<std::vector<TrianglePair>> blocks((triangles + blockSize - 1) / blockSize);
  base::parallelFor(blocks.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      std::vector<TrianglePair>& pairs = blocks[b];
      for (std::size_t t = b * blockSize; t < std::min((b + 1) * blockSize, triangles); ++t) {
        const std::size_t before = pairs.size();
        find(static_cast<std::uint32_t>(t), pairs);
        std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end());
      }
    }
  });
  std::vector<TrianglePair> all;
  for (const std::vector<TrianglePair>& block : blocks) {
    all.insert(all.end(), block.begin(), block.end());
  }
  return all;
}

}  // namespace

Meeting meeting(const std::array<Vec3f, 3>& first, const std::array<Vec3f, 3>& second) {
  const auto wide = [](const std::array<Vec3f, 3>& t) {
    return Corners{t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
  };
  const Corners a = wide(first);
  const Corners b = wide(second);
  return hasArea(a) && hasArea(b) ? meetingOf(a, b) : Meeting::none;
}

std::vector<TrianglePair> selfIntersections(const TriangleMesh& mesh, base::Threads threads,
                                            const IntersectionOptions& options) {
  const TriangleBoxes boxes(mesh);
  return gathered(mesh.triangles.size(), threads, [&](std::uint32_t t, std::vector<TrianglePair>& pairs) {
    boxes.forEachOverlap(TriangleBoxes::boxOf(mesh, t), [&](std::uint32_t other) {
      if (other > t && meetWithin(mesh, t, other, options)) {
        pairs.push_back({t, other});
      }
    });
  });
}

std::vector<TrianglePair> intersections(const TriangleMesh& a, const TriangleMesh& b, base::Threads threads,
                                        const IntersectionOptions& options) {
  const Meeting least = options.touching ? Meeting::touching : Meeting::crossing;
  const TriangleBoxes boxes(b);
  return gathered(a.triangles.size(), threads, [&](std::uint32_t t, std::vector<TrianglePair>& pairs) {
    const Corners first = cornersOf(a, t);
    if (!hasArea(first)) {
      return;
    }
    boxes.forEachOverlap(TriangleBoxes::boxOf(a, t), [&](std::uint32_t other) {
      const Corners second = cornersOf(b, other);
      if (hasArea(second) && meetingOf(first, second) >= least) {
        pairs.push_back({t, other});
      }
    });
  });
}

}  // namespace lorica::geometry
