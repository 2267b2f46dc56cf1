#pragma once

/// \file
/// All hits of a ray, exactly. Embree proposes candidates in single precision (robust mode); each is decided again in
/// double precision from the float vertices and the float ray. A ray that meets an edge or a vertex is decided as if
/// its direction were turned by an infinitesimal amount, the same for every triangle, so that it crosses exactly one
/// of the triangles there (simulation of simplicity, Edelsbrunner and Muecke 1990) and the crossings of a closed
/// component always add up.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "lorica/raycast/scene.h"

namespace lorica::raycast {

/// Starts at `origin` and has no end; parameters t count in lengths of `direction`.
struct Ray {
  geometry::Vec3f origin;
  geometry::Vec3f direction;
};

struct Hit {
  double t = 0.0;               ///< origin + t * direction, t >= 0
  std::uint32_t mesh = 0;       ///< MeshIndex value
  std::uint32_t component = 0;  ///< connected component of the mesh
  std::uint32_t triangle = 0;
  bool entering = false;  ///< the ray runs against the triangle's normal

  int sign() const { return entering ? 1 : -1; }
};

/// What happened while casting; sums, so counts of several casters add up.
struct CastCounts {
  std::uint64_t rays = 0;
  std::uint64_t retraced = 0;      ///< crossings of a closed component did not add up at first
  std::uint64_t unresolved = 0;    ///< and still did not after testing every triangle of that mesh
  std::uint64_t nearOpenEdge = 0;  ///< within 1e-6, relative to its distance, of an open edge of a triangle proposed

  void add(const CastCounts& other);
  bool operator==(const CastCounts&) const = default;
};

/// The double-precision decision itself, for one triangle: t of the crossing, or nothing.
struct Crossing {
  double t = 0.0;
  bool entering = false;
};
std::optional<Crossing> crossing(const Ray& ray, const geometry::Vec3f& a, const geometry::Vec3f& b,
                                 const geometry::Vec3f& c);

/// Orders hits by (t, mesh, component, triangle) and merges repeated ones: the same triangle, or, in an open component,
/// triangles with a common corner, the same orientation and the same t within 1e-9 (relative): faces that a mesh holds
/// twice. A ray at an edge needs no merging, it crosses one triangle there.
void sortAndMerge(std::vector<Hit>& hits, const Scene& scene);

/// Casts rays at a built scene. One caster per thread: it keeps buffers.
class Caster {
 public:
  explicit Caster(const Scene& scene);

  /// All hits in order. The span is valid until the next call.
  std::span<const Hit> cast(const Ray& ray);
  /// All hits of each of many rays: calls `use(index, hits)` in the order of the rays. Faster than one by one when
  /// neighbours run close together; the hits are the same.
  template <class Use>
  void castMany(std::span<const Ray> rays, const Use& use) {
    for (std::size_t begin = 0; begin < rays.size(); begin += packetWidth) {
      const std::span<const Ray> packet = rays.subspan(begin, std::min(packetWidth, rays.size() - begin));
      collectPacket(packet);
      fetchAhead(packet.size());
      for (std::size_t lane = 0; lane < packet.size(); ++lane) {
        use(begin + lane, finishLane(packet[lane], lane));
      }
    }
  }
  const CastCounts& counts() const { return counts_; }
  /// Whether the component of a hit is closed, so that its crossings pair up.
  bool isClosed(const Hit& hit) const { return scene_->topology(MeshIndex{hit.mesh}).closed[hit.component]; }

 private:
  struct Candidate {
    std::uint32_t mesh;
    std::uint32_t triangle;
  };
  /// What decisions read of a mesh, without a detour.
  struct MeshView {
    const geometry::Vec3f* positions;
    const geometry::Triangle* triangles;
    const std::uint32_t* componentOf;
    const MeshTopology* topology;
  };
  struct Context;
  static constexpr std::size_t packetWidth = 8;

  void collectPacket(std::span<const Ray> packet);
  /// Asks the memory for what the decisions on a packet's candidates will read.
  void fetchAhead(std::size_t lanes) const;
  std::span<const Hit> finishLane(const Ray& ray, std::size_t lane);
  void collect(const Ray& ray);
  void decide(const Ray& ray);
  bool decideOne(const Ray& ray, std::uint32_t mesh, std::uint32_t triangle);
  bool nearOpenEdge(const Ray& ray, const Candidate& candidate) const;
  void balance(const Ray& ray);
  void findUnbalanced(const Ray& ray, std::vector<std::uint32_t>& meshes);
  void probeOrigin(const Ray& ray);
  /// How often a closed component winds around the ray's origin, told by a second ray from there.
  int originWinding(const Ray& ray, std::uint32_t mesh, std::uint32_t component);

  const Scene* scene_;
  std::vector<MeshView> meshes_;
  std::vector<Candidate> candidates_;
  std::array<std::vector<Candidate>, packetWidth> lanes_;
  std::vector<Hit> hits_;
  std::vector<Hit> probeHits_;
  std::vector<std::uint32_t> suspects_;
  bool nearOpen_ = false;
  std::vector<std::vector<int>> sums_;  ///< per mesh and component; all zero between rays
  CastCounts counts_;
  bool windingsKnown_ = false;
  geometry::Vec3f windingOrigin_ = geometry::Vec3f::Zero();
  std::vector<std::pair<std::uint64_t, int>> windings_;  ///< known windings around windingOrigin_
};

/// How often the mesh winds around a point, counted by signed crossings along a ray; 1 inside, 0 outside. Only closed
/// components count. \pre the caster's scene holds the mesh
int windingNumber(Caster& caster, MeshIndex mesh, const geometry::Vec3d& point);

}  // namespace lorica::raycast
