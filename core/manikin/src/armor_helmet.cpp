#include "armor_helmet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "armor_cloth.h"
#include "fields.h"
#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/measures.h"

namespace lorica::manikin {

namespace {

using geometry::TriangleMesh;
using Point2 = std::pair<double, double>;

TriangleMesh headOf(const Body& body, const BodyShares& shares) {
  TriangleMesh head{body.skin.positions, {}};
  for (const geometry::Triangle& t : body.skin.triangles) {
    if (shares.head[t[0]] >= 0.3 && shares.head[t[1]] >= 0.3 && shares.head[t[2]] >= 0.3) {
      head.triangles.push_back(t);
    }
  }
  return head;
}

/// Where the head is and how it is cut.
struct HeadFrame {
  double top = 0.0;
  double eyes = 0.0;  ///< y
  Vec3d centre = Vec3d::Zero();
};

HeadFrame frameOf(const TriangleMesh& head) {
  geometry::Box3d box;
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    box.extend(head.corner(t, 0));
  }
  HeadFrame frame;
  frame.top = box.max().y();
  // A head is about 1.3 times as high from the chin to the top as the skull is long; the eyes lie at half its height.
  geometry::Box3d skull;
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    const Vec3d p = head.corner(t, 0);
    if (p.y() > frame.top - 0.09) {
      skull.extend(p);
    }
  }
  frame.eyes = frame.top - 0.56 * skull.sizes().z();
  frame.centre = {skull.center().x(), frame.eyes + 0.02, skull.center().z()};
  return frame;
}

double cross(const Point2& o, const Point2& a, const Point2& b) {
  return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

double hullPerimeter(std::vector<Point2> points) {
  std::sort(points.begin(), points.end());
  std::vector<Point2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= base + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  double length = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2& a = hull[i];
    const Point2& b = hull[(i + 1) % hull.size()];
    length += std::hypot(a.first - b.first, a.second - b.second);
  }
  return length;
}

/// Height of the rim by azimuth (0 in front): brow, temples, ears, nape.
double rimHeight(const HeadFrame& frame, double azimuth) {
  const double turned = std::abs(azimuth) / std::numbers::pi;  // 0 in front, 1 behind
  const double brow = frame.eyes + 0.030;
  const double ear = frame.eyes - 0.032;
  const double nape = frame.eyes - 0.042;
  const double toEar = smoothStep(0.22, 0.42, turned);
  const double toNape = smoothStep(0.60, 0.80, turned);
  return brow + toEar * (ear - brow) + toNape * (nape - ear);
}

/// How far along a ray from the centre the distance to the head is first `off`, coming from outside.
double radiusAt(const geometry::ClosestPointTree& head, const Vec3d& centre, const Vec3d& direction, double off) {
  double radius = 0.25;
  for (int step = 0; step < 40; ++step) {
    const double excess = head.signedDistance(centre + radius * direction) - off;
    if (std::abs(excess) < 1e-5) {
      break;
    }
    radius -= excess;
  }
  return radius;
}

/// A disc of rings, the k-th of 6 k vertices, and which way each vertex looks from the centre of the head.
struct Dome {
  std::vector<Vec3d> directions;
  std::vector<geometry::Triangle> triangles;
  std::vector<std::uint32_t> rim;
};

constexpr std::uint32_t kRings = 23;

std::uint32_t ringStart(std::uint32_t ring) {
  return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1);
}

Dome domeOver(const HeadFrame& frame, const geometry::ClosestPointTree& head, double standoff) {
  Dome dome;
  const auto polarOfRim = [&](double azimuth) {
    double polar = 0.5 * std::numbers::pi;
    for (int step = 0; step < 3; ++step) {
      const Vec3d way(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
      const double radius = radiusAt(head, frame.centre, way, standoff);
      polar = std::acos(std::clamp((rimHeight(frame, azimuth) - frame.centre.y()) / radius, -0.8, 0.8));
    }
    return polar;
  };
  std::vector<double> rimPolar;
  for (std::uint32_t j = 0; j < 6 * kRings; ++j) {
    const double azimuth = 2.0 * std::numbers::pi * j / (6.0 * kRings);
    rimPolar.push_back(polarOfRim(azimuth > std::numbers::pi ? azimuth - 2.0 * std::numbers::pi : azimuth));
  }
  for (int round = 0; round < 6; ++round) {
    std::vector<double> smooth = rimPolar;
    for (std::size_t j = 0; j < smooth.size(); ++j) {
      const std::size_t n = smooth.size();
      smooth[j] = 0.5 * rimPolar[j] + 0.25 * (rimPolar[(j + 1) % n] + rimPolar[(j + n - 1) % n]);
    }
    rimPolar = smooth;
  }
  dome.directions.emplace_back(Vec3d::UnitY());
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    for (std::uint32_t j = 0; j < 6 * ring; ++j) {
      const double turn = static_cast<double>(j) / (6.0 * ring);
      const double place = turn * static_cast<double>(rimPolar.size());
      const auto before = static_cast<std::size_t>(place) % rimPolar.size();
      const double share = place - std::floor(place);
      const double rim = rimPolar[before] + share * (rimPolar[(before + 1) % rimPolar.size()] - rimPolar[before]);
      const double polar = rim * ring / kRings;
      const double azimuth = 2.0 * std::numbers::pi * turn;
      dome.directions.emplace_back(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                   std::sin(polar) * std::cos(azimuth));
    }
  }
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    for (std::uint32_t side = 0; side < 6; ++side) {
      const auto outer = [&](std::uint32_t k) { return ringStart(ring) + (side * ring + k) % (6 * ring); };
      const auto inner = [&](std::uint32_t k) {
        return ring == 1 ? 0U : ringStart(ring - 1) + (side * (ring - 1) + k) % (6 * (ring - 1));
      };
      for (std::uint32_t k = 0; k < ring; ++k) {
        dome.triangles.push_back({inner(k), outer(k), outer(k + 1)});
        if (k + 1 < ring) {
          dome.triangles.push_back({inner(k), outer(k + 1), inner(k + 1)});
        }
      }
    }
  }
  for (std::uint32_t j = 0; j < 6 * kRings; ++j) {
    dome.rim.push_back(ringStart(kRings) + j);
  }
  return dome;
}

/// Distances from the centre, smoothed so that ears make no bumps, and at least `least` off the head.
std::vector<double> smoothRadii(const Dome& dome, const geometry::ClosestPointTree& head, const Vec3d& centre,
                                double standoff, double least, base::Threads threads) {
  const std::size_t count = dome.directions.size();
  std::vector<double> radius(count);
  std::vector<double> floor(count);
  base::parallelFor(count, 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      radius[v] = radiusAt(head, centre, dome.directions[v], standoff);
      floor[v] = radiusAt(head, centre, dome.directions[v], least);
    }
  });
  TriangleMesh disc;
  disc.positions.resize(count);
  disc.triangles = dome.triangles;
  const auto neighbors = vertexNeighbors(disc);
  const std::size_t rimStart = ringStart(kRings);
  for (int round = 0; round < 60; ++round) {
    std::vector<double> next = radius;
    for (std::size_t v = 0; v < count; ++v) {
      double mean = 0.0;
      if (v >= rimStart) {  // along the rim, lest it shrink
        const std::size_t n = count - rimStart;
        mean = 0.5 * (radius[rimStart + (v - rimStart + 1) % n] + radius[rimStart + (v - rimStart + n - 1) % n]);
      } else {
        for (const std::uint32_t n : neighbors[v]) {
          mean += radius[n];
        }
        mean /= static_cast<double>(neighbors[v].size());
      }
      next[v] = std::max(radius[v] + 0.5 * (mean - radius[v]), floor[v]);
    }
    radius = std::move(next);
  }
  return radius;
}

}  // namespace

double headCircumference(const Body& body, const BodyShares& shares) {
  const TriangleMesh head = headOf(body, shares);
  const double height = frameOf(head).eyes + 0.035;
  std::vector<Point2> points;
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = head.corner(t, k);
      const Vec3d b = head.corner(t, (k + 1) % 3);
      if ((a.y() > height) != (b.y() > height)) {
        const Vec3d p = a + (height - a.y()) / (b.y() - a.y()) * (b - a);
        points.emplace_back(p.x(), p.z());
      }
    }
  }
  return hullPerimeter(std::move(points));
}

Helmet helmetOn(const Body& body, const BodyShares& shares, double standoff, double thickness, base::Threads threads) {
  const TriangleMesh head = headOf(body, shares);
  const HeadFrame frame = frameOf(head);
  const geometry::ClosestPointTree tree(head);
  const Dome dome = domeOver(frame, tree, standoff);
  const std::vector<double> radius = smoothRadii(dome, tree, frame.centre, standoff, 0.007, threads);
  const std::size_t count = dome.directions.size();
  TriangleMesh inner;
  inner.triangles = dome.triangles;
  for (std::size_t v = 0; v < count; ++v) {
    inner.positions.emplace_back((frame.centre + radius[v] * dome.directions[v]).cast<float>());
  }
  const auto normals = geometry::vertexNormals(inner.positions, inner.triangles);
  Helmet helmet;
  TriangleMesh middle = inner;
  helmet.mesh.positions = inner.positions;
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3d p = inner.positions[v].cast<double>();
    const Vec3d normal = normals[v].cast<double>();
    helmet.mesh.positions.emplace_back((p + thickness * normal).cast<float>());
    middle.positions[v] = (p + 0.5 * thickness * normal).cast<float>();
  }
  const auto outer = static_cast<std::uint32_t>(count);
  for (const geometry::Triangle& t : dome.triangles) {
    helmet.mesh.triangles.push_back({t[0], t[2], t[1]});
    helmet.mesh.triangles.push_back({t[0] + outer, t[1] + outer, t[2] + outer});
  }
  for (std::size_t j = 0; j < dome.rim.size(); ++j) {
    const std::uint32_t a = dome.rim[j];
    const std::uint32_t b = dome.rim[(j + 1) % dome.rim.size()];
    helmet.mesh.triangles.push_back({a, b, b + outer});
    helmet.mesh.triangles.push_back({a, b + outer, a + outer});
  }
  helmet.middleArea = geometry::area(middle);
  return helmet;
}

}  // namespace lorica::manikin
