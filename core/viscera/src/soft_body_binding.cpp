#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body_grid.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/raycast/caster.h"
#include "soft_body_parts.h"

namespace lorica::viscera {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr std::uint32_t kNone = UINT32_MAX;
/// Cells of the box around all organs, before the empty ones are left out.
constexpr double kGridLimit = 3e5;

/// The samples of a cell that lie in something.
struct FilledCell {
  std::size_t cell = 0;
  std::uint64_t samples = 0;
};

/// The organs in a grid, before it is known whether that has few enough cells.
struct Filling {
  BodyGrid grid;
  std::vector<std::vector<FilledCell>> organs;  ///< inside each organ; none where nothing closes
  std::vector<float> filled;                    ///< per cell: by all organs, 0 to 1
  std::vector<char> taken;                      ///< per cell: part of the soft body
  std::vector<std::uint32_t> skinVertices;      ///< those that bound the flesh around the organs
};

/// The organs' own samples and cells.
Samples fillWithOrgans(Filling& filling, std::span<const SoftOrgan> organs, base::Threads threads,
                       const base::Progress& progress) {
  Samples taken(filling.grid.size(), 0);
  for (const SoftOrgan& organ : organs) {
    progress.check();
    const Samples inside =
        samplesInside(filling.grid, organ.mesh->positions, raycast::makeTopology(*organ.mesh), threads);
    std::vector<FilledCell>& cells = filling.organs.emplace_back();
    for (std::size_t c = 0; c < inside.size(); ++c) {
      if (inside[c] != 0) {
        cells.push_back({c, inside[c]});
        taken[c] |= inside[c];
        filling.filled[c] = std::min(1.0F, filling.filled[c] + share(inside[c]));
      }
    }
    for (const Vec3f& position : organ.mesh->positions) {
      const BodyGrid::Spot spot = *filling.grid.locate(position);
      taken[spot.cell] |= sampleAt(spot.fraction);
      // A cell that an organ reaches at all is as stiff as a full one: a sliver of it would turn inside out with flesh.
      filling.filled[spot.cell] = 1.0F;
    }
  }
  return taken;
}

/// The flesh that reaches the organs without leaving the skin, and the skin that bounds it: a forearm beside the trunk
/// is no part of it.
void fillWithFlesh(Filling& filling, Samples taken, const parenting::BodyRig& body, double reach,
                   base::Threads threads) {
  const BodyGrid& grid = filling.grid;
  const geometry::TriangleMesh& skin = body.body().skin;
  const double step = grid.cell / samplesPerEdge;
  flood(grid, samplesInside(grid, skin.positions, body.skinTopology(), threads),
        static_cast<int>(std::lround(reach / step)), taken);
  for (std::size_t c = 0; c < grid.size(); ++c) {
    filling.taken[c] = taken[c] != 0 ? 1 : 0;
  }
  const std::vector<Vec3f> normals = geometry::vertexNormals(skin.positions, skin.triangles);
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    const auto spot = grid.locate(skin.positions[v]);
    const auto below = grid.locate(skin.positions[v] - static_cast<float>(step) * normals[v]);
    if (spot && below && (taken[below->cell] & sampleAt(below->fraction)) != 0) {
      filling.skinVertices.push_back(static_cast<std::uint32_t>(v));
      filling.taken[spot->cell] = 1;
    }
  }
}

Filling fill(std::span<const SoftOrgan> organs, const parenting::BodyRig& body, double cell, double reach,
             base::Threads threads, const base::Progress& progress) {
  geometry::Box3d box;
  for (const SoftOrgan& organ : organs) {
    box.extend(geometry::bounds(organ.mesh->positions));
  }
  Filling filling;
  filling.grid = BodyGrid::over(box, cell, static_cast<int>(std::ceil(reach / cell)));
  filling.taken.assign(filling.grid.size(), 0);
  filling.filled.assign(filling.grid.size(), 0.0F);
  fillWithFlesh(filling, fillWithOrgans(filling, organs, threads, progress), body, reach, threads);
  return filling;
}

/// The strongest of many weights, made to sum to 1.
JointBlend strongest(std::vector<std::pair<float, std::uint32_t>> weights) {
  std::sort(weights.begin(), weights.end(), [](const auto& a, const auto& b) {
    return a.first > b.first || (a.first == b.first && a.second < b.second);
  });
  JointBlend blend;
  float sum = 0.0F;
  for (std::size_t k = 0; k < std::min(weights.size(), JointBlend::limit); ++k) {
    blend.weight[k] = std::max(0.0F, weights[k].first);
    blend.joint[k] = weights[k].second;
    sum += blend.weight[k];
  }
  for (float& weight : blend.weight) {
    weight /= sum;
  }
  return blend;
}

}  // namespace

std::array<float, 8> cornerWeights(const Vec3f& fraction) {
  std::array<float, 8> weights{};
  for (std::size_t c = 0; c < 8; ++c) {
    weights[c] = 1.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float along = fraction[static_cast<Eigen::Index>(axis)];
      weights[c] *= cornerDigits[c][axis] != 0 ? along : 1.0F - along;
    }
  }
  return weights;
}

std::array<Vec3f, 8> cornerSlopes(const Vec3f& fraction, float cell) {
  const Vec3f low = Vec3f::Ones() - fraction;
  std::array<Vec3f, 8> slopes;
  for (std::size_t c = 0; c < 8; ++c) {
    const auto& digit = cornerDigits[c];
    const Vec3f side(digit[0] != 0 ? fraction.x() : low.x(), digit[1] != 0 ? fraction.y() : low.y(),
                     digit[2] != 0 ? fraction.z() : low.z());
    const Vec3f sign(digit[0] != 0 ? 1.0F : -1.0F, digit[1] != 0 ? 1.0F : -1.0F, digit[2] != 0 ? 1.0F : -1.0F);
    slopes[c] = sign.cwiseProduct(Vec3f(side.y() * side.z(), side.x() * side.z(), side.x() * side.y())) / cell;
  }
  return slopes;
}

/// Makes the parts of a soft body one after the other.
struct SoftBody::Binding {
  std::span<const SoftOrgan> organs;
  const parenting::BodyRig& body;
  base::Threads threads;
  Filling filling;
  std::vector<std::uint32_t> cellNumber;  ///< per cell of the grid
  Parts parts;

  void fillGrid(const SoftBodyOptions& options, const base::Progress& progress);
  void numberCells();
  void embedOrgans();
  void tieToSkin();
  void guardOrgans();
  void factor();
  void spreadJoints();
  void measurePressures();
  std::vector<Vec4f> volumeSlopes(std::size_t organ) const;
};

void SoftBody::Binding::fillGrid(const SoftBodyOptions& options, const base::Progress& progress) {
  LORICA_CHECK(options.cellMetres > 0.0 && options.reachMetres >= 0.0 && options.cellLimit > 0, "sizes in metres");
  geometry::Box3d box;
  for (const SoftOrgan& organ : organs) {
    box.extend(geometry::bounds(organ.mesh->positions));
  }
  const double around = 2.0 * options.reachMetres;
  double cell = options.cellMetres;
  while ((box.sizes().array() + around + 4.0 * cell).prod() > kGridLimit * cell * cell * cell) {
    cell *= 1.25;
  }
  const auto taken = [&] {
    return static_cast<std::size_t>(std::count(filling.taken.begin(), filling.taken.end(), 1));
  };
  filling = fill(organs, body, cell, options.reachMetres, threads, progress);
  while (taken() > options.cellLimit) {
    cell *= 1.25;
    filling = fill(organs, body, cell, options.reachMetres, threads, progress);
  }
  if (cell > options.cellMetres) {
    parts.issues.push_back({base::Severity::note, "", "organs",
                            fmt::format("fill so much room that the soft body they are part of has cells of {:.0f} mm "
                                        "instead of {:.0f} mm",
                                        1e3 * cell, 1e3 * options.cellMetres)});
  }
}

void SoftBody::Binding::numberCells() {
  const BodyGrid& grid = filling.grid;
  const BodyGrid corners{grid.origin, grid.cell, {grid.cells[0] + 1, grid.cells[1] + 1, grid.cells[2] + 1}};
  std::vector<std::uint32_t> pointNumber(corners.size(), kNone);
  cellNumber.assign(grid.size(), kNone);
  parts.cell = grid.cell;
  for (std::size_t c = 0; c < grid.size(); ++c) {
    if (filling.taken[c] == 0) {
      continue;
    }
    cellNumber[c] = static_cast<std::uint32_t>(parts.cells.size());
    const std::array<int, 3> at = grid.place(c);
    Corners& cell = parts.cells.emplace_back();
    for (std::size_t k = 0; k < 8; ++k) {
      const auto& digit = cornerDigits[k];
      std::uint32_t& point = pointNumber[corners.index(at[0] + digit[0], at[1] + digit[1], at[2] + digit[2])];
      if (point == kNone) {
        point = static_cast<std::uint32_t>(parts.points.size());
        parts.points.emplace_back(grid.origin +
                                  grid.cell * Vec3d(at[0] + digit[0], at[1] + digit[1], at[2] + digit[2]));
        parts.cellsOfPoint.emplace_back().fill(kNone);
      }
      cell[k] = point;
      parts.cellsOfPoint[point][k] = cellNumber[c];
    }
    parts.stiffness.push_back(kFlesh + (1.0F - kFlesh) * filling.filled[c]);
  }
}

void SoftBody::Binding::embedOrgans() {
  const auto volume = static_cast<float>(std::pow(parts.cell, 3));
  parts.organs = organs.size();
  for (std::size_t o = 0; o < organs.size(); ++o) {
    Embedding& embedding = parts.embeddings.emplace_back();
    embedding.cell = Vec3d::Constant(parts.cell);
    std::vector<std::uint32_t> own(parts.cells.size(), kNone);
    for (const Vec3f& position : organs[o].mesh->positions) {
      const BodyGrid::Spot spot = *filling.grid.locate(position);
      const std::uint32_t cell = cellNumber[spot.cell];
      if (own[cell] == kNone) {
        own[cell] = static_cast<std::uint32_t>(embedding.cellCorners.size());
        embedding.cellCorners.push_back(parts.cells[cell]);
      }
      embedding.cellOf.push_back(own[cell]);
      embedding.fraction.push_back(spot.fraction);
    }
    for (const FilledCell& inside : filling.organs[o]) {
      parts.organParts.push_back({static_cast<std::uint32_t>(o), cellNumber[inside.cell],
                                  volume * share(inside.samples),
                                  cornerSlopes(centroid(inside.samples), static_cast<float>(parts.cell))});
    }
  }
}

void SoftBody::Binding::tieToSkin() {
  const geometry::TriangleMesh& skin = body.body().skin;
  const std::vector<double> areas = geometry::vertexAreas(skin);
  for (const std::uint32_t v : filling.skinVertices) {
    const BodyGrid::Spot spot = *filling.grid.locate(skin.positions[v]);
    parts.skin.push_back({v, cellNumber[spot.cell], kSkin * static_cast<float>(areas[v] / (parts.cell * parts.cell)),
                          spot.fraction, skin.positions[v]});
  }
  std::vector<std::vector<PointPull>> pullsOf(parts.points.size());
  for (std::uint32_t p = 0; p < parts.skin.size(); ++p) {
    const std::array<float, 8> weight = cornerWeights(parts.skin[p].fraction);
    for (std::size_t c = 0; c < 8; ++c) {
      pullsOf[parts.cells[parts.skin[p].cell][c]].push_back({p, weight[c]});
    }
  }
  for (const std::vector<PointPull>& pulls : pullsOf) {
    parts.firstPull.push_back(static_cast<std::uint32_t>(parts.pullsOfPoint.size()));
    parts.pullsOfPoint.insert(parts.pullsOfPoint.end(), pulls.begin(), pulls.end());
  }
  parts.firstPull.push_back(static_cast<std::uint32_t>(parts.pullsOfPoint.size()));
}

void SoftBody::Binding::guardOrgans() {
  const geometry::TriangleMesh& skin = body.body().skin;
  for (const SoftOrgan& organ : organs) {
    const geometry::Positions& positions = organ.mesh->positions;
    std::vector<std::optional<raycast::SurfacePoint>> nearest(positions.size());
    base::parallelFor(positions.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        nearest[v] = raycast::closestPoint(body.restScene(), positions[v].cast<double>(), kGuarded);
      }
    });
    std::vector<SkinGuard>& guards = parts.guards.emplace_back();
    for (std::size_t v = 0; v < positions.size(); ++v) {
      if (nearest[v]) {
        SkinGuard guard{static_cast<std::uint32_t>(v), skin.triangles[nearest[v]->triangle],
                        nearest[v]->barycentric.cast<float>(), kLeastDepth, 0.0F};
        const Depth rest = depthUnder(guard, skin.positions, positions[v]);
        guard.least = std::min(guard.least, rest.metres);
        guard.aside = rest.aside;
        guards.push_back(guard);
      }
    }
  }
}

/// The energy's second derivative, for one coordinate: over the twelve edges of every cell
/// stiffness / 4 |(u_j - u_i) - h (R - 1) e|^2 / 2, plus the pulls of skin and joints.
void SoftBody::Binding::factor() {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < parts.cells.size(); ++c) {
    const double quarter = static_cast<double>(parts.stiffness[c]) / 4.0;
    for (std::size_t a = 0; a < 8; ++a) {
      entries.emplace_back(parts.cells[c][a], parts.cells[c][a], 3.0 * quarter);
      for (std::size_t b = 0; b < 8; ++b) {
        int steps = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          steps += std::abs(cornerDigits[a][axis] - cornerDigits[b][axis]);
        }
        if (steps == 1) {
          entries.emplace_back(parts.cells[c][a], parts.cells[c][b], -quarter);
        }
      }
    }
  }
  std::vector<Eigen::Matrix<double, 8, 8>> pulls(parts.cells.size(), Eigen::Matrix<double, 8, 8>::Zero());
  std::vector<char> pulled(parts.cells.size(), 0);
  for (const SkinPull& pull : parts.skin) {
    const std::array<float, 8> corner = cornerWeights(pull.fraction);
    const auto weights = Eigen::Map<const Eigen::Matrix<float, 8, 1>>(corner.data()).cast<double>();
    pulls[pull.cell] += static_cast<double>(pull.strength) * weights * weights.transpose();
    pulled[pull.cell] = 1;
  }
  for (std::size_t c = 0; c < parts.cells.size(); ++c) {
    for (std::size_t a = 0; pulled[c] != 0 && a < 8; ++a) {
      for (std::size_t b = 0; b < 8; ++b) {
        entries.emplace_back(parts.cells[c][a], parts.cells[c][b],
                             pulls[c](static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
      }
    }
  }
  const auto points = static_cast<Eigen::Index>(parts.points.size());
  for (Eigen::Index p = 0; p < points; ++p) {
    entries.emplace_back(p, p, kHold);
  }
  Eigen::SparseMatrix<double> matrix(points, points);
  matrix.setFromTriplets(entries.begin(), entries.end());
  parts.solver = SparseSolver(matrix);
}

/// Each joint's weight at every control point: the smoothest that meets the skin's own.
void SoftBody::Binding::spreadJoints() {
  const human::SkinWeights& weights = *body.body().weights;
  const human::Skeleton& skeleton = *body.body().skeleton;
  for (const human::Joint& joint : skeleton.joints()) {
    parts.parentJoint.push_back(joint.parent ? static_cast<std::int64_t>(joint.parent->value) : -1);
  }
  std::vector<std::uint32_t> nearest(parts.points.size());
  base::parallelFor(nearest.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const auto place = raycast::closestPoint(body.restScene(), parts.points[p]);
      Eigen::Index corner = 0;
      place->barycentric.maxCoeff(&corner);
      nearest[p] = body.body().skin.triangles[place->triangle][static_cast<std::size_t>(corner)];
    }
  });
  std::vector<std::vector<std::pair<float, std::uint32_t>>> found(parts.points.size());
  for (std::size_t first = 0; first < skeleton.size(); first += 4) {
    std::vector<Vec4f> right(parts.points.size(), Vec4f::Zero());
    const auto add = [&](std::uint32_t point, std::uint32_t vertex, float strength) {
      for (std::size_t k = vertex * weights.influences; k < (vertex + 1) * weights.influences; ++k) {
        if (weights.joints[k] >= first && weights.joints[k] < first + 4) {
          right[point][static_cast<Eigen::Index>(weights.joints[k] - first)] += strength * weights.weights[k];
        }
      }
    };
    for (const SkinPull& pull : parts.skin) {
      const std::array<float, 8> corner = cornerWeights(pull.fraction);
      for (std::size_t c = 0; c < 8; ++c) {
        add(parts.cells[pull.cell][c], pull.vertex, pull.strength * corner[c]);
      }
    }
    for (std::size_t p = 0; p < nearest.size(); ++p) {
      add(static_cast<std::uint32_t>(p), nearest[p], kHold);
    }
    std::vector<Vec4f> spread;
    parts.solver.solve(right, spread);
    for (std::size_t p = 0; p < spread.size(); ++p) {
      for (Eigen::Index k = 0; k < 4; ++k) {
        if (spread[p][k] > 1e-3F) {
          found[p].emplace_back(spread[p][k], static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(k));
        }
      }
    }
  }
  for (const auto& weightsHere : found) {
    parts.pointJoints.push_back(strongest(weightsHere));
  }
  for (const Corners& cell : parts.cells) {
    std::vector<float> sum(skeleton.size(), 0.0F);
    std::vector<std::pair<float, std::uint32_t>> mean;
    for (const std::uint32_t point : cell) {
      for (const auto& [weight, joint] : found[point]) {
        sum[joint] += weight / 8.0F;
      }
    }
    for (std::size_t j = 0; j < sum.size(); ++j) {
      if (sum[j] > 0.0F) {
        mean.emplace_back(sum[j], static_cast<std::uint32_t>(j));
      }
    }
    parts.cellJoints.push_back(strongest(std::move(mean)));
  }
}

/// How an organ's volume at rest grows with the control points.
std::vector<Vec4f> SoftBody::Binding::volumeSlopes(std::size_t organ) const {
  std::vector<Vec4f> slopes(parts.points.size(), Vec4f::Zero());
  for (const OrganPart& part : parts.organParts) {
    if (part.organ == organ) {
      for (std::size_t c = 0; c < 8; ++c) {
        slopes[parts.cells[part.cell][c]].head<3>() += part.volume * part.cornerSlopes[c];
      }
    }
  }
  return slopes;
}

void SoftBody::Binding::measurePressures() {
  const auto count = static_cast<Eigen::Index>(organs.size());
  Eigen::MatrixXd gained = Eigen::MatrixXd::Zero(count, count);  // m3 of the row's organ by the column's pressure
  for (std::size_t pressed = 0; pressed < organs.size(); ++pressed) {
    std::vector<Vec4f> moved;
    parts.solver.solve(volumeSlopes(pressed), moved);
    for (const OrganPart& part : parts.organParts) {
      for (std::size_t c = 0; c < 8; ++c) {
        gained(part.organ, static_cast<Eigen::Index>(pressed)) +=
            static_cast<double>(part.volume * part.cornerSlopes[c].dot(moved[parts.cells[part.cell][c]].head<3>()));
      }
    }
  }
  // An organ without volume has no pressure; organs that lie in each other tell theirs apart only so far.
  const double least = 1e-6 * std::max(1e-30, gained.diagonal().maxCoeff());
  parts.pressureFor = (0.5 * (gained + gained.transpose()) + least * Eigen::MatrixXd::Identity(count, count)).inverse();
}

SoftBody::SoftBody(std::span<const SoftOrgan> organs, const parenting::BodyRig& body, const SoftBodyOptions& options,
                   base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(!organs.empty() && body.body().skeleton, "organs, and a body with a skeleton");
  Binding binding{organs, body, threads, {}, {}, {}};
  binding.fillGrid(options, progress.part(0.0, 0.5));
  progress.report(0.5);
  binding.numberCells();
  binding.embedOrgans();
  binding.tieToSkin();
  binding.guardOrgans();
  progress.check();
  binding.factor();
  progress.report(0.8);
  binding.spreadJoints();
  progress.check();
  binding.measurePressures();
  progress.report(1.0);
  binding.parts.rounds = options.rounds;
  parts_ = std::make_unique<const Parts>(std::move(binding.parts));
}

}  // namespace lorica::viscera
