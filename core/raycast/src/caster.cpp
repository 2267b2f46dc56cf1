#include "lorica/raycast/caster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "embree.h"
#include "lorica/base/error.h"

namespace lorica::raycast {

using geometry::Vec3d;
using geometry::Vec3f;

namespace {

/// Quadruple precision: differences of floats of one scene have some 30 bits, so triple products of them are exact.
__extension__ using Quad = __float128;

/// The sign of an edge function too near zero for double precision; where the ray meets the edge exactly, the sign it
/// has when the ray's direction is turned by (e, e^2, e^3), e -> 0. As good as zero but for its sign.
double signNearEdge(const Vec3d& direction, const Vec3d& p, const Vec3d& q) {
  std::array<Quad, 3> normal{};
  Quad side = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    normal[static_cast<std::size_t>(axis)] = Quad(q[next]) * Quad(p[last]) - Quad(q[last]) * Quad(p[next]);
    side += Quad(direction[axis]) * normal[static_cast<std::size_t>(axis)];
  }
  for (const Quad value : {side, normal[0], normal[1], normal[2]}) {
    if (value != 0) {
      return value > 0 ? 1e-300 : -1e-300;
    }
  }
  return 0.0;
}

/// Which side of the edge from p to q the ray passes, seen from its origin. Swapping p and q turns the sign exactly,
/// also in floating point, so two triangles at an edge never both win or both lose the ray.
double edgeFunction(const Vec3d& direction, const Vec3d& p, const Vec3d& q) {
  const double side = direction.dot(q.cross(p));
  // Generous bound of the rounding errors of the products above.
  const double noise = 1e-14 * direction.cwiseAbs().sum() * p.cwiseAbs().maxCoeff() * q.cwiseAbs().maxCoeff();
  return std::abs(side) > noise ? side : signNearEdge(direction, p, q);
}

}  // namespace

void CastCounts::add(const CastCounts& other) {
  rays += other.rays;
  retraced += other.retraced;
  unresolved += other.unresolved;
  nearOpenEdge += other.nearOpenEdge;
}

std::optional<Crossing> crossing(const Ray& ray, const Vec3f& fa, const Vec3f& fb, const Vec3f& fc) {
  const Vec3d origin = ray.origin.cast<double>();
  const Vec3d direction = ray.direction.cast<double>();
  const Vec3d a = fa.cast<double>() - origin;
  const Vec3d b = fb.cast<double>() - origin;
  const Vec3d c = fc.cast<double>() - origin;
  const double ab = edgeFunction(direction, a, b);
  const double bc = edgeFunction(direction, b, c);
  const double ca = edgeFunction(direction, c, a);
  const bool entering = ab > 0.0 && bc > 0.0 && ca > 0.0;
  const bool leaving = ab < 0.0 && bc < 0.0 && ca < 0.0;
  if (!entering && !leaving) {
    return std::nullopt;
  }
  const Vec3d normal = (b - a).cross(c - a);
  const double slope = direction.dot(normal);
  if (slope == 0.0) {
    return std::nullopt;
  }
  const double t = a.dot(normal) / slope;
  if (!(t >= 0.0)) {
    return std::nullopt;
  }
  return Crossing{t, entering};
}

namespace {

bool shareCorner(const geometry::Triangle& first, const geometry::Triangle& second) {
  return std::any_of(first.begin(), first.end(), [&](std::uint32_t vertex) {
    return std::find(second.begin(), second.end(), vertex) != second.end();
  });
}

}  // namespace

void sortAndMerge(std::vector<Hit>& hits, const Scene& scene) {
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    if (a.t != b.t) {
      return a.t < b.t;
    }
    if (a.mesh != b.mesh) {
      return a.mesh < b.mesh;
    }
    return a.component != b.component ? a.component < b.component : a.triangle < b.triangle;
  });
  constexpr double tolerance = 1e-9;
  std::size_t kept = 0;
  for (const Hit& hit : hits) {
    const MeshTopology& topology = scene.topology(MeshIndex{hit.mesh});
    bool repeats = false;
    for (std::size_t k = kept; k-- > 0 && hit.t - hits[k].t <= tolerance * hit.t;) {
      if (hits[k].mesh != hit.mesh || hits[k].component != hit.component || hits[k].entering != hit.entering) {
        continue;
      }
      // Two triangles of a closed component are never one too many: they add up, also where it folds onto itself.
      repeats = repeats || hits[k].triangle == hit.triangle ||
                (!topology.closed[hit.component] &&
                 shareCorner(topology.triangles[hits[k].triangle], topology.triangles[hit.triangle]));
    }
    if (!repeats) {
      hits[kept++] = hit;
    }
  }
  hits.resize(kept);
}

/// What travels with rays through Embree. The base must stand first: Embree hands back a pointer to it.
struct Caster::Context {
#if RTC_VERSION_MAJOR >= 4
  RTCRayQueryContext base;
#else
  RTCIntersectContext base;
#endif
  std::vector<Candidate>* lanes;  // of each ray, by its id

  /// Takes note of every hit and rejects it, so that the ray goes on.
  static void record(const RTCFilterFunctionNArguments* arguments) {
    auto* context = reinterpret_cast<Context*>(arguments->context);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
      if (arguments->valid[i] != 0) {
        context->lanes[RTCRayN_id(arguments->ray, count, i)].push_back(
            {RTCHitN_geomID(arguments->hit, count, i), RTCHitN_primID(arguments->hit, count, i)});
        arguments->valid[i] = 0;
      }
    }
  }
};

namespace {

#if RTC_VERSION_MAJOR >= 4
/// Asks for the filter in the context of the query.
template <class Context>
RTCIntersectArguments argumentsOf(Context& context) {
  rtcInitRayQueryContext(&context.base);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.base;
  arguments.filter = Context::record;
  arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  return arguments;
}
#endif

}  // namespace

Caster::Caster(const Scene& scene) : scene_(&scene), sums_(scene.meshes()) {
  for (std::size_t m = 0; m < sums_.size(); ++m) {
    const MeshTopology& topology = scene.topology(MeshIndex{m});
    sums_[m].assign(topology.closed.size(), 0);
    meshes_.push_back(
        {scene.positions(MeshIndex{m}), topology.triangles.data(), topology.componentOf.data(), &topology});
  }
}

std::span<const Hit> Caster::cast(const Ray& ray) {
  nearOpen_ = false;
  collect(ray);
  ++counts_.rays;
  counts_.nearOpenEdge += nearOpen_ ? 1 : 0;
  balance(ray);
  return hits_;
}

void Caster::collect(const Ray& ray) {
  candidates_.clear();
  hits_.clear();
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x();
  query.ray.org_y = ray.origin.y();
  query.ray.org_z = ray.origin.z();
  query.ray.dir_x = ray.direction.x();
  query.ray.dir_y = ray.direction.y();
  query.ray.dir_z = ray.direction.z();
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xFFFFFFFFU;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  Context context{};
  context.lanes = &candidates_;
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments = argumentsOf(context);
  rtcIntersect1(scene_->impl_->scene, &query, &arguments);
#else
  rtcInitIntersectContext(&context.base);
  context.base.filter = Context::record;
  rtcIntersect1(scene_->impl_->scene, &context.base, &query);
#endif
  decide(ray);
}

void Caster::collectPacket(std::span<const Ray> packet) {
  alignas(32) std::array<int, packetWidth> valid{};
  alignas(32) RTCRayHit8 query{};
  for (std::size_t i = 0; i < packet.size(); ++i) {
    lanes_[i].clear();
    valid[i] = -1;
    query.ray.org_x[i] = packet[i].origin.x();
    query.ray.org_y[i] = packet[i].origin.y();
    query.ray.org_z[i] = packet[i].origin.z();
    query.ray.dir_x[i] = packet[i].direction.x();
    query.ray.dir_y[i] = packet[i].direction.y();
    query.ray.dir_z[i] = packet[i].direction.z();
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.mask[i] = 0xFFFFFFFFU;
    query.ray.id[i] = static_cast<unsigned>(i);
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  Context context{};
  context.lanes = lanes_.data();
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments = argumentsOf(context);
  arguments.flags = static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_COHERENT);
  rtcIntersect8(valid.data(), scene_->impl_->scene, &query, &arguments);
#else
  rtcInitIntersectContext(&context.base);
  context.base.filter = Context::record;
  context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), scene_->impl_->scene, &context.base, &query);
#endif
}

void Caster::fetchAhead(std::size_t lanes) const {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    for (const Candidate& candidate : lanes_[lane]) {
      __builtin_prefetch(meshes_[candidate.mesh].triangles + candidate.triangle);
      __builtin_prefetch(meshes_[candidate.mesh].componentOf + candidate.triangle);
    }
  }
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    for (const Candidate& candidate : lanes_[lane]) {
      for (const std::uint32_t vertex : meshes_[candidate.mesh].triangles[candidate.triangle]) {
        __builtin_prefetch(meshes_[candidate.mesh].positions + vertex);
      }
    }
  }
}

std::span<const Hit> Caster::finishLane(const Ray& ray, std::size_t lane) {
  ++counts_.rays;
  if (lanes_[lane].empty()) {
    return {};
  }
  std::swap(candidates_, lanes_[lane]);
  hits_.clear();
  nearOpen_ = false;
  decide(ray);
  counts_.nearOpenEdge += nearOpen_ ? 1 : 0;
  balance(ray);
  return hits_;
}

void Caster::decide(const Ray& ray) {
  for (const Candidate& candidate : candidates_) {
    const MeshTopology& topology = *meshes_[candidate.mesh].topology;
    nearOpen_ = nearOpen_ || (topology.hasOpenEdges && nearOpenEdge(ray, candidate));
    if (decideOne(ray, candidate.mesh, candidate.triangle)) {
      continue;
    }
    // Single precision took this triangle where double precision takes one beside it.
    for (const std::uint32_t vertex : topology.triangles[candidate.triangle]) {
      for (std::uint32_t r = topology.ringStart[vertex]; r < topology.ringStart[vertex + 1]; ++r) {
        if (topology.ring[r] != candidate.triangle) {
          decideOne(ray, candidate.mesh, topology.ring[r]);
        }
      }
    }
  }
  sortAndMerge(hits_, *scene_);
}

bool Caster::decideOne(const Ray& ray, std::uint32_t mesh, std::uint32_t triangle) {
  const MeshView& target = meshes_[mesh];
  const geometry::Triangle& corner = target.triangles[triangle];
  const auto found =
      crossing(ray, target.positions[corner[0]], target.positions[corner[1]], target.positions[corner[2]]);
  if (found) {
    hits_.push_back({found->t, mesh, target.componentOf[triangle], triangle, found->entering});
  }
  return found.has_value();
}

bool Caster::nearOpenEdge(const Ray& ray, const Candidate& candidate) const {
  const MeshView& target = meshes_[candidate.mesh];
  const geometry::Triangle& corner = target.triangles[candidate.triangle];
  const Vec3d direction = ray.direction.cast<double>();
  const Vec3d origin = ray.origin.cast<double>();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!target.topology->openEdge[3 * candidate.triangle + k]) {
      continue;
    }
    const Vec3d p = target.positions[corner[k]].cast<double>() - origin;
    const Vec3d q = target.positions[corner[(k + 1) % 3]].cast<double>() - origin;
    // Volume over area is the distance between the two lines.
    const double distance = std::abs(direction.dot(q.cross(p)));
    if (distance <= 1e-6 * direction.cross(q - p).norm() * std::max(p.norm(), q.norm())) {
      return true;
    }
  }
  return false;
}

void Caster::probeOrigin(const Ray& ray) {
  if (windingsKnown_ && ray.origin == windingOrigin_) {
    return;
  }
  windings_.clear();
  windingOrigin_ = ray.origin;
  windingsKnown_ = true;
  std::swap(hits_, probeHits_);
  hits_.clear();
  const bool nearOpen = nearOpen_;
  collect({ray.origin, Vec3f(0.5477F, 0.6231F, 0.5583F)});
  nearOpen_ = nearOpen;
  std::swap(hits_, probeHits_);
  for (const Hit& hit : probeHits_) {
    const std::uint64_t key = (std::uint64_t{hit.mesh} << 32U) | hit.component;
    const auto known =
        std::find_if(windings_.begin(), windings_.end(), [&](const auto& entry) { return entry.first == key; });
    if (known == windings_.end()) {
      windings_.emplace_back(key, -hit.sign());
    } else {
      known->second -= hit.sign();
    }
  }
}

int Caster::originWinding(const Ray& ray, std::uint32_t mesh, std::uint32_t component) {
  probeOrigin(ray);
  const std::uint64_t key = (std::uint64_t{mesh} << 32U) | component;
  const auto known =
      std::find_if(windings_.begin(), windings_.end(), [&](const auto& entry) { return entry.first == key; });
  return known == windings_.end() ? 0 : known->second;
}

void Caster::findUnbalanced(const Ray& ray, std::vector<std::uint32_t>& meshes) {
  meshes.clear();
  for (const Hit& hit : hits_) {
    sums_[hit.mesh][hit.component] += hit.sign();
  }
  for (const Hit& hit : hits_) {
    int& sum = sums_[hit.mesh][hit.component];
    if (sum != 0 && meshes_[hit.mesh].topology->closed[hit.component] &&
        sum != -originWinding(ray, hit.mesh, hit.component)) {
      meshes.push_back(hit.mesh);
    }
    sum = 0;
  }
  std::sort(meshes.begin(), meshes.end());
  meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
}

void Caster::balance(const Ray& ray) {
  findUnbalanced(ray, suspects_);
  if (suspects_.empty()) {
    return;
  }
  ++counts_.retraced;
  for (const std::uint32_t mesh : suspects_) {
    std::erase_if(hits_, [&](const Hit& hit) { return hit.mesh == mesh; });
    const std::size_t triangles = meshes_[mesh].topology->triangles.size();
    for (std::size_t t = 0; t < triangles; ++t) {
      decideOne(ray, mesh, static_cast<std::uint32_t>(t));
    }
  }
  sortAndMerge(hits_, *scene_);
  findUnbalanced(ray, suspects_);
  counts_.unresolved += suspects_.empty() ? 0 : 1;
}

int windingNumber(Caster& caster, MeshIndex mesh, const Vec3d& point) {
  int winding = 0;
  // A direction without symmetry, so that it runs along no edge of a regular mesh.
  const Ray probe{point.cast<float>(), Vec3f(0.1367F, 0.0519F, 0.9893F)};
  for (const Hit& hit : caster.cast(probe)) {
    if (hit.mesh == mesh.value && caster.isClosed(hit)) {
      winding -= hit.sign();
    }
  }
  return winding;
}

}  // namespace lorica::raycast
