#include "lorica/viscera/deformation_audit.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>

#include "audit_columns.h"
#include "audit_contacts.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::viscera {

using geometry::Positions;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3f;
using raycast::MeshTopology;

const char* name(AuditBasis basis) {
  switch (basis) {
    case AuditBasis::closed:
      return "closed";
    case AuditBasis::closedParts:
      return "closed_parts";
    case AuditBasis::surface:
      return "surface";
  }
  return "surface";
}

namespace {

/// Vertices or contact points that one task looks at.
constexpr std::size_t taskSize = 512;

/// Volume of the closed components, m3.
double closedVolume(std::span<const Vec3f> positions, const MeshTopology& topology) {
  const Vec3d centre = geometry::bounds(positions).center();
  double sixfold = 0.0;
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    if (topology.closed[topology.componentOf[t]]) {
      const Triangle& corner = topology.triangles[t];
      const Vec3d a = positions[corner[0]].cast<double>() - centre;
      const Vec3d b = positions[corner[1]].cast<double>() - centre;
      const Vec3d c = positions[corner[2]].cast<double>() - centre;
      sixfold += a.dot(b.cross(c));
    }
  }
  return sixfold / 6.0;
}

/// Edges shorter than this say more about the rounding of float positions than about strain, metres.
constexpr double shortestEdge = 1e-4;

double largestStretch(const TriangleMesh& rest, std::span<const Vec3f> posed) {
  double largest = 0.0;
  for (const Triangle& t : rest.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      const double before = (rest.positions[a].cast<double>() - rest.positions[b].cast<double>()).norm();
      if (before >= shortestEdge) {
        largest = std::max(largest, (posed[a].cast<double>() - posed[b].cast<double>()).norm() / before);
      }
    }
  }
  return largest > 0.0 ? largest : 1.0;
}

/// A number in [0, 1) that looks random, the same on every machine (splitmix64).
double shiftOf(std::uint64_t index) {
  std::uint64_t z = (index + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

/// Mean of the grids and its standard error.
Estimate meanOf(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  Estimate estimate;
  for (const double v : values) {
    estimate.value += v / n;
  }
  double squares = 0.0;
  for (const double v : values) {
    squares += (v - estimate.value) * (v - estimate.value);
  }
  estimate.error = std::sqrt(squares / (n * (n - 1.0)));
  return estimate;
}

/// A share: sum of parts over sum of wholes, with the error of a ratio.
Estimate ratioOf(const std::vector<double>& parts, const std::vector<double>& wholes) {
  const Estimate part = meanOf(parts);
  const Estimate whole = meanOf(wholes);
  if (!(whole.value > 0.0)) {
    return {};
  }
  Estimate ratio{part.value / whole.value, 0.0};
  std::vector<double> residuals;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    residuals.push_back(parts[k] - ratio.value * wholes[k]);
  }
  ratio.error = meanOf(residuals).error / whole.value;
  return ratio;
}

/// What the vertices of an organ say about the skin.
struct OutsideSums {
  double area = 0.0;
  double outside = 0.0;
  double deepest = 0.0;

  void add(const OutsideSums& other) {
    area += other.area;
    outside += other.outside;
    deepest = std::max(deepest, other.deepest);
  }
};

OutsideSums outsideSums(const AuditMesh& skin, const AuditMesh& organ, const std::vector<double>& areas,
                        std::size_t begin, std::size_t end) {
  // A direction without symmetry, so that it runs along no edge of a regular mesh.
  const Vec3f probe(0.1367F, 0.0519F, 0.9893F);
  std::vector<raycast::Ray> rays;
  std::vector<std::size_t> vertices;
  OutsideSums sums;
  for (std::size_t v = begin; v < end; ++v) {
    sums.area += areas[v];
    if (areas[v] > 0.0) {
      rays.push_back({organ.positions[v], probe});
      vertices.push_back(v);
    }
  }
  raycast::Caster caster(skin.scene);
  caster.castMany(rays, [&](std::size_t ray, std::span<const raycast::Hit> hits) {
    int winding = 0;
    for (const raycast::Hit& hit : hits) {
      winding -= hit.sign();
    }
    if (winding < 1) {
      const std::size_t v = vertices[ray];
      sums.outside += areas[v];
      sums.deepest =
          std::max(sums.deepest, raycast::closestPoint(skin.scene, organ.positions[v].cast<double>())->distance);
    }
  });
  return sums;
}

AuditBasis basisOf(const AuditedMesh& organ) {
  double all = 0.0;
  double closed = 0.0;
  for (std::size_t t = 0; t < organ.rest->triangles.size(); ++t) {
    const Vec3d a = organ.rest->corner(t, 0);
    const double area = (organ.rest->corner(t, 1) - a).cross(organ.rest->corner(t, 2) - a).norm();
    all += area;
    closed += organ.topology->closed[organ.topology->componentOf[t]] ? area : 0.0;
  }
  const bool allClosed = !organ.topology->hasOpenEdges && !organ.topology->closed.empty();
  const double volume = closedVolume(organ.rest->positions, *organ.topology);
  if (!(volume > 0.0) || closed < 0.9 * all) {
    return AuditBasis::surface;
  }
  return allClosed ? AuditBasis::closed : AuditBasis::closedParts;
}

/// Runs tasks of several kinds one after the other in one parallel loop, so that no kind waits for another.
class TaskList {
 public:
  void add(std::function<void()> task) { tasks_.push_back(std::move(task)); }
  void run(base::Threads threads, const base::Progress& progress) const {
    std::atomic<std::size_t> done{0};
    base::parallelFor(tasks_.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        progress.check();
        tasks_[t]();
        progress.report(static_cast<double>(done.fetch_add(1) + 1) / static_cast<double>(tasks_.size()));
      }
    });
  }

 private:
  std::vector<std::function<void()>> tasks_;
};

}  // namespace

namespace {

struct Measuring;
using Pair = std::pair<std::size_t, std::size_t>;

}  // namespace

struct DeformationAudit::Impl {
  AuditedMesh skin;
  std::vector<AuditedMesh> organs;
  AuditOptions options;
  bool skinCloses = false;
  std::vector<AuditBasis> basis;
  std::vector<double> restVolume;
  std::vector<std::vector<double>> areas;  ///< of the vertices of every organ
  std::vector<ContactSide> contacts;
  std::map<Pair, double> restOverlap;  ///< m3, of pairs that overlap at rest
  PoseAudit rest;
  base::Issues issues;

  void lookAtMeshes();
  bool isRest(const Positions& skinNow, const std::vector<const Positions*>& organsNow) const;
  PoseAudit measure(const Positions& skinNow, const std::vector<const Positions*>& organsNow, base::Threads threads,
                    const base::Progress& progress) const;
  /// Without what concerns other organs.
  OrganAudit organAudit(const Measuring& m, std::size_t o, const Positions& now) const;
  void addContacts(const Measuring& m, PoseAudit& audit) const;
};

namespace {

/// Everything measured of one pose, before it is put together.
struct Measuring {
  std::vector<AuditMesh> organs;
  std::optional<AuditMesh> skin;
  std::vector<std::vector<std::size_t>> partners;  ///< per organ, organs whose boxes meet its own
  std::vector<ColumnPlan> plans;                   ///< per organ
  std::vector<std::vector<ColumnSums>> columns;    ///< per organ and grid
  std::vector<std::vector<OutsideSums>> outside;   ///< per organ and task
  std::vector<std::vector<GapSums>> gaps;          ///< per side and task
};

std::size_t tasksFor(std::size_t count) {
  return (count + taskSize - 1) / taskSize;
}

/// The overlap of two organs, from the columns that stand closer.
Estimate pairOverlap(const Measuring& m, std::size_t first, std::size_t second) {
  const bool fromSecond = m.plans[first].spacing == 0.0 ||
                          (m.plans[second].spacing > 0.0 && m.plans[second].spacing < m.plans[first].spacing);
  const std::size_t from = fromSecond ? second : first;
  const std::size_t onto = fromSecond ? first : second;
  const auto& partners = m.partners[from];
  const auto found = std::find(partners.begin(), partners.end(), onto);
  if (found == partners.end()) {
    return {};
  }
  std::vector<double> values;
  for (const ColumnSums& grid : m.columns[from]) {
    values.push_back(grid.overlapped[static_cast<std::size_t>(found - partners.begin())]);
  }
  return meanOf(values);
}

std::optional<Gap> gapOf(const GapSums& sums) {
  return sums.area > 0.0 ? std::optional(Gap{sums.weighted / sums.area, sums.largest, sums.area}) : std::nullopt;
}

}  // namespace

void DeformationAudit::Impl::lookAtMeshes() {
  skinCloses = !skin.topology->hasOpenEdges && !skin.topology->closed.empty();
  if (!skinCloses) {
    issues.push_back({base::Severity::note, "", skin.name,
                      "does not close, so nothing can be said about what leaves it; shares outside the skin and "
                      "protrusions are left blank"});
  }
  for (const AuditedMesh& organ : organs) {
    basis.push_back(basisOf(organ));
    areas.push_back(geometry::vertexAreas(*organ.rest));
    const bool hasVolume = basis.back() != AuditBasis::surface;
    restVolume.push_back(hasVolume ? closedVolume(organ.rest->positions, *organ.topology) : 0.0);
    if (basis.back() == AuditBasis::surface) {
      issues.push_back({base::Severity::note, "", organ.name,
                        organ.topology->hasOpenEdges
                            ? "does not close, so its deformation is judged by its surface only: no volume, share "
                              "outside the skin or overlap"
                            : "encloses no volume, so its deformation is judged by its surface only"});
    } else if (basis.back() == AuditBasis::closedParts) {
      issues.push_back({base::Severity::note, "", organ.name,
                        "has parts that do not close; the volumes of its deformation are those of the parts that do"});
    }
  }
}

bool DeformationAudit::Impl::isRest(const Positions& skinNow, const std::vector<const Positions*>& organsNow) const {
  bool same = skinNow == skin.rest->positions && organsNow.size() == organs.size();
  for (std::size_t o = 0; same && o < organs.size(); ++o) {
    same = *organsNow[o] == organs[o].rest->positions;
  }
  return same;
}

namespace {

using Organs = std::vector<const Positions*>;

void addColumnTasks(TaskList& tasks, Measuring& m, const std::vector<AuditBasis>& basis, const AuditOptions& options) {
  for (std::size_t o = 0; o < m.organs.size(); ++o) {
    if (basis[o] == AuditBasis::surface) {
      continue;
    }
    m.plans[o] = planColumns(m.organs[o], std::max<std::size_t>(1, options.columns / options.grids));
    std::vector<const AuditMesh*> partners;
    for (std::size_t other = 0; other < m.organs.size(); ++other) {
      if (other != o && basis[other] != AuditBasis::surface && m.organs[other].box.intersects(m.organs[o].box)) {
        m.partners[o].push_back(other);
        partners.push_back(&m.organs[other]);
      }
    }
    m.columns[o].resize(options.grids);
    for (std::size_t grid = 0; grid < options.grids; ++grid) {
      tasks.add([&m, o, grid, partners] {
        m.columns[o][grid] = sumColumns(m.organs[o], m.skin ? &*m.skin : nullptr, partners, m.plans[o],
                                        {shiftOf(2 * grid), shiftOf(2 * grid + 1)});
      });
    }
  }
}

void addVertexTasks(TaskList& tasks, Measuring& m, const std::vector<std::vector<double>>& areas) {
  for (std::size_t o = 0; m.skin && o < m.organs.size(); ++o) {
    const std::size_t vertices = m.organs[o].positions.size();
    m.outside[o].resize(tasksFor(vertices));
    for (std::size_t t = 0; t < m.outside[o].size(); ++t) {
      tasks.add([&m, &areas, o, t, vertices] {
        m.outside[o][t] =
            outsideSums(*m.skin, m.organs[o], areas[o], t * taskSize, std::min(vertices, (t + 1) * taskSize));
      });
    }
  }
}

void addGapTasks(TaskList& tasks, Measuring& m, const std::vector<ContactSide>& sides) {
  m.gaps.resize(sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const std::span<const ContactPoint> points = sides[s].points;
    m.gaps[s].resize(tasksFor(points.size()));
    for (std::size_t t = 0; t < m.gaps[s].size(); ++t) {
      const auto some = points.subspan(t * taskSize, std::min(taskSize, points.size() - t * taskSize));
      tasks.add([&m, &sides, s, t, some] { m.gaps[s][t] = gapSums(sides[s], some, m.organs); });
    }
  }
}

}  // namespace

PoseAudit DeformationAudit::Impl::measure(const Positions& skinNow, const Organs& organsNow, base::Threads threads,
                                          const base::Progress& progress) const {
  LORICA_CHECK(organsNow.size() == organs.size(), "the organs of the audit");
  Measuring m;
  m.organs.reserve(organs.size());
  for (std::size_t o = 0; o < organs.size(); ++o) {
    progress.check();
    LORICA_CHECK(organsNow[o]->size() == organs[o].rest->positions.size(), "the vertices of the organ at rest");
    m.organs.emplace_back(*organsNow[o], organs[o].topology);
  }
  if (skinCloses) {
    LORICA_CHECK(skinNow.size() == skin.rest->positions.size(), "the vertices of the skin at rest");
    m.skin.emplace(skinNow, skin.topology);
  }
  m.partners.resize(organs.size());
  m.plans.resize(organs.size());
  m.columns.resize(organs.size());
  m.outside.resize(organs.size());
  TaskList tasks;
  addColumnTasks(tasks, m, basis, options);
  addVertexTasks(tasks, m, areas);
  addGapTasks(tasks, m, contacts);
  tasks.run(threads, progress);

  PoseAudit audit;
  for (std::size_t o = 0; o < organs.size(); ++o) {
    audit.organs.push_back(organAudit(m, o, *organsNow[o]));
  }
  addContacts(m, audit);
  return audit;
}

OrganAudit DeformationAudit::Impl::organAudit(const Measuring& m, std::size_t o, const Positions& now) const {
  OrganAudit organ;
  organ.basis = basis[o];
  organ.largestStretch = largestStretch(*organs[o].rest, now);
  if (m.skin) {
    OutsideSums sums;
    for (const OutsideSums& part : m.outside[o]) {
      sums.add(part);
    }
    organ.outsideSurface = sums.area > 0.0 ? sums.outside / sums.area : 0.0;
    organ.protrusion = sums.deepest;
  }
  if (basis[o] == AuditBasis::surface) {
    return organ;
  }
  organ.volume = closedVolume(now, *organs[o].topology);
  organ.volumeChange = *organ.volume / restVolume[o] - 1.0;
  organ.overlap = Estimate{};
  organ.overlapBeyondRest = 0.0;
  if (m.skin) {
    std::vector<double> outside;
    std::vector<double> inside;
    for (const ColumnSums& grid : m.columns[o]) {
      outside.push_back(grid.inside - grid.insideBoth);
      inside.push_back(grid.inside);
    }
    organ.outsideShare = ratioOf(outside, inside);
  }
  return organ;
}

void DeformationAudit::Impl::addContacts(const Measuring& m, PoseAudit& audit) const {
  std::vector<GapSums> organGaps(organs.size());
  std::map<Pair, GapSums> pairGaps;
  for (std::size_t s = 0; s < contacts.size(); ++s) {
    for (const GapSums& sums : m.gaps[s]) {
      organGaps[contacts[s].from].add(sums);
      pairGaps[std::minmax(contacts[s].from, contacts[s].onto)].add(sums);
    }
  }
  for (std::size_t a = 0; a < organs.size(); ++a) {
    audit.organs[a].gap = gapOf(organGaps[a]);
    for (std::size_t b = a + 1; b < organs.size(); ++b) {
      ContactAudit contact{a, b, {}, {}, {}};
      const auto gap = pairGaps.find({a, b});
      if (gap != pairGaps.end()) {
        contact.gap = gapOf(gap->second);
      }
      const auto atRest = restOverlap.find({a, b});
      if (basis[a] != AuditBasis::surface && basis[b] != AuditBasis::surface) {
        const Estimate overlap = pairOverlap(m, a, b);
        const double beyond = std::max(0.0, overlap.value - (atRest == restOverlap.end() ? 0.0 : atRest->second));
        contact.overlap = overlap;
        contact.overlapBeyondRest = beyond;
        for (const std::size_t o : {a, b}) {
          Estimate& sum = *audit.organs[o].overlap;
          sum = {sum.value + overlap.value, std::hypot(sum.error, overlap.error)};
          *audit.organs[o].overlapBeyondRest += beyond;
        }
      }
      const bool overlaps = contact.overlap && contact.overlap->value > 0.0;
      if (contact.gap || overlaps || atRest != restOverlap.end()) {
        audit.contacts.push_back(contact);
      }
    }
  }
}

DeformationAudit::DeformationAudit(AuditedMesh skin, std::vector<AuditedMesh> organs, const AuditOptions& options,
                                   base::Threads threads, const base::Progress& progress)
    : impl_(std::make_unique<Impl>()) {
  LORICA_CHECK(options.grids >= 2, "at least two grids, whose spread tells the error");
  impl_->skin = std::move(skin);
  impl_->organs = std::move(organs);
  impl_->options = options;
  impl_->lookAtMeshes();
  std::vector<AuditMesh> meshes;
  std::vector<const Positions*> positions;
  for (const AuditedMesh& organ : impl_->organs) {
    meshes.emplace_back(organ.rest->positions, organ.topology);
    positions.push_back(&organ.rest->positions);
  }
  impl_->contacts = findContacts(meshes, impl_->areas, options.contactDistance, threads, progress.part(0.0, 0.5));
  meshes.clear();
  impl_->rest = impl_->measure(impl_->skin.rest->positions, positions, threads, progress.part(0.5, 1.0));
  for (ContactAudit& contact : impl_->rest.contacts) {
    if (contact.overlap && contact.overlap->value > 0.0) {
      impl_->restOverlap[{contact.first, contact.second}] = contact.overlap->value;
    }
    if (contact.overlapBeyondRest) {
      contact.overlapBeyondRest = 0.0;
    }
  }
  for (OrganAudit& organ : impl_->rest.organs) {
    if (organ.overlapBeyondRest) {
      organ.overlapBeyondRest = 0.0;
    }
  }
}

DeformationAudit::~DeformationAudit() = default;
DeformationAudit::DeformationAudit(DeformationAudit&&) noexcept = default;
DeformationAudit& DeformationAudit::operator=(DeformationAudit&&) noexcept = default;

PoseAudit DeformationAudit::measure(const Positions& skin, const std::vector<const Positions*>& organs,
                                    base::Threads threads, const base::Progress& progress) const {
  if (impl_->isRest(skin, organs)) {
    return impl_->rest;
  }
  return impl_->measure(skin, organs, threads, progress);
}

const PoseAudit& DeformationAudit::rest() const {
  return impl_->rest;
}

const base::Issues& DeformationAudit::issues() const {
  return impl_->issues;
}

}  // namespace lorica::viscera
