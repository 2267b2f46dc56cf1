#include "lorica/manikin/organs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include "lorica/base/error.h"
#include "lorica/geometry/closest_point.h"
#include "lorica/geometry/intersections.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/remesh.h"
#include "organ_frame.h"
#include "organ_lattice.h"
#include "organ_recipes.h"
#include "vessel_routes.h"

namespace lorica::manikin {

namespace {

using geometry::Box3d;
using geometry::TriangleMesh;

/// Between the ribs' inner faces, m.
double innerChestBreadth(const AnatomyFrame& frame) {
  constexpr double wall = 0.018;  // skin, muscle and rib on each side
  return 2.0 * (frame.chestHalfBreadth() - wall);
}

/// Makes one organ after the other; each keeps clear of those before it.
class Builder {
 public:
  Builder(const Body& body, const OrganOptions& options) : frame_(body), skin_(body.skin), threads_(options.threads) {
    const Vec3d low = frame_.toBody({-0.22, 0.80, -0.20});
    const Vec3d high = frame_.toBody({0.22, kCanonicalStature, 0.16});
    depth_ = Lattice::over(Box3d(low, high), 0.011 * frame_.scale());
    sample(depth_, frame_, threads_, [&](const Level&, const Vec3d& p) { return skin_.signedDistance(p); });
  }

  const AnatomyFrame& frame() const { return frame_; }

  /// Forgets the organ made last.
  void takeBack() { placed_.pop_back(); }

  TriangleMesh make(const OrganRecipe& recipe, double volume) {
    Lattice lattice = Lattice::over(bodyBox(recipe), recipe.cell * frame_.scale());
    const double size = sizeInBody(recipe, volume);
    fillShape(lattice, recipe, size);
    const std::vector<double> limits = limitsOn(lattice, recipe);
    return finish(std::move(lattice), limits, recipe, volume, 1, size);
  }

  /// Eyeballs at their joints, or where they are in the canonical man, as far forward as the lids allow.
  TriangleMesh makeEyes(const human::Skeleton& skeleton, double volume) {
    const double radius = std::cbrt(0.5 * volume * 0.75 / std::numbers::pi);
    std::array<Vec3d, 2> centres;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto joint = skeleton.find(side == 0 ? "eye_L" : "eye_R");
      const double x = side == 0 ? 0.0319 : -0.0319;
      Vec3d centre = joint ? skeleton.restPosition(*joint) : frame_.toBody({x, 1.641, 0.066});
      constexpr double lids = 0.0035;
      for (int i = 0; i < 40 && skin_.signedDistance(centre) > -(radius + lids); ++i) {
        centre.z() -= 0.001;
      }
      centres[side] = centre;
    }
    Box3d box(centres[0]);
    box.extend(centres[1]);
    const Vec3d margin = Vec3d::Constant(radius + 0.006);
    Lattice lattice = Lattice::over(Box3d(box.min() - margin, box.max() + margin), 0.0016);
    sample(lattice, frame_, threads_, [&](const Level&, const Vec3d& p) {
      double field = 1.0;
      for (const Vec3d& centre : centres) {
        // The cornea stands out a little.
        const double ball = (p - centre).norm() - radius;
        const double cornea = (p - centre - Vec3d(0.0, 0.0, 0.45 * radius)).norm() - 0.62 * radius;
        field = std::min(field, smoothUnion(ball, cornea, 0.002));
      }
      return field;
    });
    const std::vector<double> limits(lattice.values.size(), -1.0);
    const OrganRecipe eyes{.name = "eyes", .edge = 0.0026, .fillet = 0.001, .blurs = 0};
    return finish(std::move(lattice), limits, eyes, volume, 2);
  }

  /// Arteries and veins, laid between what is there; later organs keep clear of them.
  std::pair<TriangleMesh, TriangleMesh> layVessels(const Body& body) {
    std::vector<Vessel> vessels = vesselRoutes(body, frame_);
    Surroundings around = surroundings();
    VesselSurface arteries;
    VesselSurface veins;
    // Walls that still meet after the first laying are moved further apart.
    constexpr int attempts = 5;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      settle(vessels, around);
      arteries = vesselSurface(vessels, true);
      veins = vesselSurface(vessels, false);
      untangle(arteries.mesh, threads_);
      untangle(veins.mesh, threads_);
      if (geometry::intersections(arteries.mesh, veins.mesh, threads_).empty()) {
        break;
      }
      around.gap += 0.001;
    }
    tubes_ = std::move(arteries.tubes);
    tubes_.insert(tubes_.end(), veins.tubes.begin(), veins.tubes.end());
    return {std::move(arteries.mesh), std::move(veins.mesh)};
  }

 private:
  /// The surface of a shape that has grown or shrunk to its volume within its limits.
  TriangleMesh finish(Lattice lattice, const std::vector<double>& limits, const OrganRecipe& recipe, double volume,
                      std::size_t pieces, double size = 1.0) {
    const std::vector<double> shape = lattice.values;
    const double fillet = recipe.fillet * frame_.scale();
    std::vector<double> furrows;
    if (recipe.furrows != nullptr) {
      Lattice cut = lattice;
      sample(cut, frame_, threads_, [&](const Level& level, const Vec3d& p) {
        return frame_.scale() * size * recipe.furrows(sized(level.toCanonical(p.x(), p.z()), recipe, size));
      });
      furrows = std::move(cut.values);
    }
    const auto swell = [&](double by) {
      for (std::size_t i = 0; i < shape.size(); ++i) {
        lattice.values[i] = smoothIntersection(shape[i] - by, limits[i], fillet);
      }
    };
    // Rounded edges and nothing too thin for the triangles, still clear of the others.
    const auto swellSmoothly = [&](double by) {
      constexpr double slack = 0.0006;
      swell(by);
      for (int pass = 0; pass < recipe.blurs; ++pass) {
        if (pass + 1 == recipe.blurs && !furrows.empty()) {
          for (std::size_t i = 0; i < shape.size(); ++i) {
            lattice.values[i] += furrows[i];
          }
        }
        blur(lattice);
      }
      for (std::size_t i = 0; i < shape.size(); ++i) {
        lattice.values[i] = std::max(lattice.values[i], limits[i] - slack);
      }
      closeBox(lattice);
    };
    double by = 0.0;
    if (volume > 0.0) {
      by = swellingFor(volume, lattice, swell);
    }
    swellSmoothly(by);
    TriangleMesh mesh = surfaceOf(lattice, pieces);
    // Only a share of the surface has room to move.
    double share = 1.0;
    constexpr int rounds = 8;
    constexpr double close = 0.003;
    for (int i = 0; volume > 0.0 && i < rounds; ++i) {
      const double lacking = volume - geometry::signedVolume(mesh);
      if (i >= 2 && std::abs(lacking) < close * volume) {
        break;
      }
      const double step = lacking / (share * geometry::area(mesh));
      by += step;
      swellSmoothly(by);
      mesh = surfaceOf(lattice, pieces);
      const double gained = lacking - (volume - geometry::signedVolume(mesh));
      share = std::clamp(share * gained / lacking, 0.25, 1.0);
    }
    // Finer where the triangles were too long for a narrow place.
    const TriangleMesh surface = std::move(mesh);
    double edge = recipe.edge * frame_.scale();
    for (int attempt = 0; attempt < 4; ++attempt, edge *= 0.85) {
      mesh = evenTriangles(surface, lattice, edge);
      bool clean = untangle(mesh, threads_);
      if (volume > 0.0) {
        adjustVolume(mesh, volume);
        clean = untangle(mesh, threads_);
      }
      if (clean) {
        break;
      }
    }
    placed_.push_back(std::move(lattice));
    return mesh;
  }

  /// Outside at the lattice's own faces, so that every surface in it closes.
  static void closeBox(Lattice& lattice) {
    for (std::size_t k = 0; k < lattice.points[2]; ++k) {
      for (std::size_t j = 0; j < lattice.points[1]; ++j) {
        for (std::size_t i = 0; i < lattice.points[0]; ++i) {
          const bool face = i == 0 || j == 0 || k == 0 || i + 1 == lattice.points[0] || j + 1 == lattice.points[1] ||
                            k + 1 == lattice.points[2];
          if (face) {
            double& value = lattice.values[lattice.index(i, j, k)];
            value = std::max(value, lattice.cell);
          }
        }
      }
    }
  }

  Box3d bodyBox(const OrganRecipe& recipe) const {
    Box3d box;
    constexpr int steps = 4;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        for (int k = 0; k <= steps; ++k) {
          const Vec3d share(i / 4.0, j / 4.0, k / 4.0);
          box.extend(frame_.toBody(recipe.low + share.cwiseProduct(recipe.high - recipe.low)));
        }
      }
    }
    return box;
  }

  Surroundings surroundings() const {
    Surroundings around;
    around.solids.reserve(placed_.size() + 1);
    for (const Lattice& solid : placed_) {
      around.solids.push_back(&solid);
    }
    around.bone = [this](const Vec3d& p) { return frame_.scale() * boneShape(frame_.toCanonical(p)); };
    around.skin = &skin_;
    return around;
  }

  /// Size of a recipe's shape as a share of what the body's would be: below 1 where the organ does not grow with it.
  double sizeInBody(const OrganRecipe& recipe, double volume) const {
    return recipe.canonicalVolume > 0.0 ? std::min(1.0, std::cbrt(volume / recipe.canonicalVolume) / frame_.scale())
                                        : 1.0;
  }

  /// The place in the recipe's shape that comes to lie at a canonical place.
  static Vec3d sized(const Vec3d& canonical, const OrganRecipe& recipe, double size) {
    return recipe.middle + (canonical - recipe.middle) / size;
  }

  void fillShape(Lattice& lattice, const OrganRecipe& recipe, double size) const {
    constexpr double far = 0.02;
    const double scale = frame_.scale();
    sample(lattice, frame_, threads_, [&](const Level& level, const Vec3d& p) {
      return recipe.shape == nullptr
                 ? far
                 : scale * size * recipe.shape(sized(level.toCanonical(p.x(), p.z()), recipe, size));
    });
    if (recipe.tubes != nullptr) {
      for (const std::vector<Station>& tube : recipe.tubes()) {
        Vessel there;
        there.stations.reserve(tube.size());
        for (const Station& station : tube) {
          there.stations.push_back({frame_.toBody(station.place), station.radius * scale});
        }
        if (recipe.yielding) {
          std::vector<Vessel> alone{std::move(there)};
          Surroundings around = surroundings();
          around.gap = recipe.gap;
          around.skinDepth = recipe.depth;
          Lattice vessels = Lattice::over(lattice.box(), 0.004);
          std::fill(vessels.values.begin(), vessels.values.end(), 0.03);
          for (const std::vector<Station>& vessel : tubes_) {
            stampTube(vessels, vessel, 0.03);
          }
          around.solids.push_back(&vessels);
          settle(alone, around);
          there = std::move(alone.front());
        }
        stampTube(lattice, there.stations, far);
      }
    }
  }

  /// Positive where the organ may not be.
  std::vector<double> limitsOn(const Lattice& lattice, const OrganRecipe& recipe) const {
    Lattice limits = lattice;
    const double scale = frame_.scale();
    std::vector<const Lattice*> near;
    for (const Lattice& other : placed_) {
      if (!other.box().intersection(lattice.box()).isEmpty()) {
        near.push_back(&other);
      }
    }
    constexpr double boneReach = 0.045;
    // Long edges cut the corner in the furrow around a thin tube.
    const double besideVessels = recipe.gap + 0.3 * recipe.edge;
    Lattice vessels = lattice;
    std::fill(vessels.values.begin(), vessels.values.end(), 1.0);
    for (const std::vector<Station>& tube : tubes_) {
      stampTube(vessels, tube, 0.012);
    }
    sample(limits, frame_, threads_, [&](const Level& level, const Vec3d& p) {
      double limit = depth_.at(p, 1.0) + recipe.depth;
      const Vec3d canonical = level.toCanonical(p.x(), p.z());
      if (recipe.besideBone && std::abs(canonical.x()) < boneReach) {
        limit = std::max(limit, recipe.gap - scale * boneShape(canonical));
      }
      for (const Lattice* other : near) {
        limit = std::max(limit, recipe.gap - other->at(p));
      }
      return limit;
    });
    for (std::size_t i = 0; i < limits.values.size(); ++i) {
      limits.values[i] = std::max(limits.values[i], besideVessels - vessels.values[i]);
    }
    return std::move(limits.values);
  }

  /// How far the shape has to grow or to shrink to hold a volume, by bisection.
  template <class Swell>
  static double swellingFor(double volume, const Lattice& lattice, const Swell& swell) {
    double low = -0.035;
    double high = 0.035;
    for (int i = 0; i < 15; ++i) {
      const double middle = 0.5 * (low + high);
      swell(middle);
      (volumeBelowZero(lattice) < volume ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  TriangleMesh evenTriangles(const TriangleMesh& mesh, const Lattice& lattice, double edge) const {
    geometry::RemeshOptions options;
    options.edgeLength = [edge](const Vec3d&) { return edge; };
    options.project = [&lattice](const Vec3d& p) { return lattice.project(p); };
    options.rounds = 4;
    options.threads = threads_;
    return geometry::remeshed(mesh, options);
  }

  /// Moves the surface along its normals by the last tenths of a millimetre; never so far that it meets a neighbour,
  /// where the body has no room for more.
  static void adjustVolume(TriangleMesh& mesh, double volume) {
    double left = 0.0004;
    for (int i = 0; i < 3; ++i) {
      const double wanted = (volume - geometry::signedVolume(mesh)) / geometry::area(mesh);
      const double by = std::clamp(wanted, -left, left);
      left -= std::abs(by);
      const std::vector<geometry::Vec3f> normals = geometry::vertexNormals(mesh.positions, mesh.triangles);
      for (std::size_t v = 0; v < normals.size(); ++v) {
        mesh.positions[v] += static_cast<float>(by) * normals[v];
      }
    }
  }

  AnatomyFrame frame_;
  geometry::ClosestPointTree skin_;
  base::Threads threads_;
  Lattice depth_;  ///< signed distance to the skin
  std::deque<Lattice> placed_;
  std::vector<std::vector<Station>> tubes_;  ///< of the vessels
};

}  // namespace

std::vector<Organ> organsOf(const Body& body, const OrganOptions& options, const base::Progress& progress) {
  Builder builder(body, options);
  const double innerBreadth = innerChestBreadth(builder.frame());
  std::map<std::string, TriangleMesh> made;
  const std::vector<OrganTarget> targets = organTargets(body.person, options, innerBreadth);
  const auto volumeOf = [&](std::string_view name) {
    return std::find_if(targets.begin(), targets.end(), [&](const OrganTarget& t) { return t.name == name; })->volume;
  };
  made["eyes"] = builder.makeEyes(body.skeleton, volumeOf("eyes"));
  for (std::size_t i = 0; i < organRecipes().size(); ++i) {
    progress.check();
    const OrganRecipe& recipe = organRecipes()[i];
    made[recipe.name] = builder.make(recipe, volumeOf(recipe.name));
    if (std::string_view(recipe.name) == "heart") {
      std::tie(made["arteries"], made["veins"]) = builder.layVessels(body);
      // Once more, now that the vessels have their places.
      builder.takeBack();
      made[recipe.name] = builder.make(recipe, volumeOf(recipe.name));
    }
    progress.report(static_cast<double>(i + 1) / static_cast<double>(organRecipes().size()));
  }
  std::vector<Organ> organs;
  for (const OrganTarget& target : targets) {
    organs.push_back({target.name, std::move(made[target.name]), target.volume, target.density, target.source});
  }
  return organs;
}

double cardiothoracicRatio(const Body& body, const std::vector<Organ>& organs) {
  const auto heart = std::find_if(organs.begin(), organs.end(), [](const Organ& o) { return o.name == "heart"; });
  LORICA_CHECK(heart != organs.end(), "the organs have a heart");
  return geometry::bounds(heart->mesh.positions).sizes().x() / innerChestBreadth(AnatomyFrame(body));
}

}  // namespace lorica::manikin
