#pragma once

/// \file
/// The deformation audit: what a pose does to the organs of one model, in numbers. It looks only at meshes, so that
/// every deformer, rigid or not, is judged by the same measures.
///
/// Exact for closed organs: the volume (divergence theorem). Exact at the vertices: the depth of what is outside the
/// skin, gaps, stretch. Sampled: the volume outside the skin and the overlaps, along columns of parallel rays through
/// all surfaces (raycast::Caster finds every crossing); columns stand on several grids, each shifted by its own fixed
/// random amount, and the spread between the grids gives the standard error. What is thinner than the spacing of the
/// columns may fall between them: the protrusion, taken at vertices, still tells.
///
/// Inside is told by the signed winding of closed components: 1 or more. Parts that do not close have no volume; an
/// organ made of them gets the measures of its surface only.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/geometry/triangle_mesh.h"
#include "lorica/raycast/scene.h"

namespace lorica::viscera {

struct AuditOptions {
  /// Surfaces nearer than this at rest touch, metres.
  double contactDistance = 0.003;
  std::size_t columns = 4096;  ///< through each organ, about; over all grids
  std::size_t grids = 8;       ///< at least 2
};

/// A mesh that is audited. \pre rest outlives the audit
struct AuditedMesh {
  std::string name;
  const geometry::TriangleMesh* rest = nullptr;
  std::shared_ptr<const raycast::MeshTopology> topology;
};

/// A sampled number.
struct Estimate {
  double value = 0.0;
  double error = 0.0;  ///< standard error

  bool operator==(const Estimate&) const = default;
};

/// What the numbers of an organ rest on.
enum class AuditBasis {
  closed,       ///< every component closes
  closedParts,  ///< components with at least 90 % of the surface close; volumes are of these
  surface       ///< open patches: no volume, outside share or overlap
};
/// "closed", "closed_parts", "surface".
const char* name(AuditBasis basis);

/// Space that opened between surfaces that touched at rest.
///
/// A contact point of an organ is a vertex within AuditOptions::contactDistance of the other organ's surface at rest;
/// it stands for a third of the area of the triangles around it. Its gap is its distance from the other organ's surface
/// now less that at rest, and 0 where it came nearer or lies inside the other organ. The nearest place of the other
/// surface counts, not the one that was nearest at rest: organs slide along each other, which opens nothing.
struct Gap {
  double mean = 0.0;     ///< metres, over the contact points, weighted by area
  double largest = 0.0;  ///< metres
  double area = 0.0;     ///< m2 at rest of the contact points

  bool operator==(const Gap&) const = default;
};

struct OrganAudit {
  AuditBasis basis = AuditBasis::closed;
  std::optional<double> volume;             ///< m3
  std::optional<double> volumeChange;       ///< volume over volume at rest, less 1
  std::optional<Estimate> outsideShare;     ///< of the organ's volume, 0 to 1; none also for a skin that does not close
  std::optional<double> outsideSurface;     ///< share of its area at rest whose vertices are outside the skin, 0 to 1
  std::optional<double> protrusion;         ///< metres from the skin of the farthest vertex outside it; 0 when none is
  std::optional<Estimate> overlap;          ///< m3, sum over the other organs that enclose a volume
  std::optional<double> overlapBeyondRest;  ///< m3, sum over the other organs of what exceeds their overlap at rest
  std::optional<Gap> gap;                   ///< from all organs it touched at rest; none when it touched none
  /// Length now over length at rest of the edge stretched most, of those of 0.1 mm or more: float positions leave
  /// shorter ones no digits.
  double largestStretch = 1.0;

  bool operator==(const OrganAudit&) const = default;
};

/// Two organs that touch or overlap, at rest or now.
struct ContactAudit {
  std::size_t first = 0;  ///< organ index, below `second`
  std::size_t second = 0;
  std::optional<Estimate> overlap;  ///< m3; none when one of them encloses no volume
  std::optional<double> overlapBeyondRest;
  std::optional<Gap> gap;  ///< over the contact points of both; none when they did not touch at rest

  bool operator==(const ContactAudit&) const = default;
};

struct PoseAudit {
  std::vector<OrganAudit> organs;      ///< in the order given
  std::vector<ContactAudit> contacts;  ///< rising

  bool operator==(const PoseAudit&) const = default;
};

/// Knows the rest state of a skin and its organs. Immutable; const functions are thread-safe, and the same input gives
/// the same bits at any number of threads.
class DeformationAudit {
 public:
  /// Measures the rest state. Cost: one measure(), and a query per vertex and organ near it.
  /// \throw base::Cancelled
  DeformationAudit(AuditedMesh skin, std::vector<AuditedMesh> organs, const AuditOptions& options,
                   base::Threads threads, const base::Progress& progress = {});
  ~DeformationAudit();
  DeformationAudit(DeformationAudit&&) noexcept;
  DeformationAudit& operator=(DeformationAudit&&) noexcept;

  /// What a pose did.
  /// \param skin, organs vertices in the pose, all finite
  /// Cost: columns times the meshes near them plus a ray per vertex; some tenths of a second for twenty organs of 200k
  /// triangles on two cores.
  /// \throw base::Cancelled
  PoseAudit measure(const geometry::Positions& skin, const std::vector<const geometry::Positions*>& organs,
                    base::Threads threads, const base::Progress& progress = {}) const;

  /// Of the rest state itself: overlaps there, volumes.
  const PoseAudit& rest() const;
  /// Organs that do not close or enclose nothing, a skin that does not close: what is missing, and why.
  const base::Issues& issues() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lorica::viscera
