#pragma once

/// \file
/// All organs as parts of one soft body that fills the skin: the deformer behind OrganModel::dynamic.
///
/// One lattice of cubic cells covers the organs and the flesh around them up to the skin, and every organ is embedded
/// in it (thesis Eq 10-14 with shared control points). Organs that touch move alike where they touch, so that no gap
/// opens and no overlap grows as long as no cell turns inside out. Three things decide where the control points go:
///  - the posed skin: every vertex of the skin pulls the place of the lattice where it lies at rest;
///  - stiffness: a cell resists every change of its shape but a turn (as-rigid-as-possible, Sorkine and Alexa 2007;
///    solved by alternating turns and positions as in projective dynamics, Bouaziz et al. 2014). Flesh is five times
///    softer than organs and takes up what the skin takes away;
///  - pressure: one number per closed organ, found along with the positions, keeps its volume. It is limited: where the
///    skin leaves no room, volume gives way before the skin is pierced.
/// The turns start from those of the joints, spread from the skin's weights into the body, and a fixed number of rounds
/// follows: a pose has one answer, whatever came before it, and the answer follows the pose continuously.

#include <memory>
#include <span>
#include <vector>

#include "lorica/base/issue.h"
#include "lorica/parenting/body_rig.h"
#include "lorica/viscera/lattice.h"

namespace lorica::viscera {

struct SoftBodyOptions {
  double cellMetres = 0.025;  ///< edge length of a cell; larger where the organs would take more than `cellLimit`
  double reachMetres = 0.08;  ///< how far from an organ the flesh takes part
  std::size_t cellLimit = 20000;
  int rounds = 5;  ///< of turns and positions
};

/// An organ at rest. \pre mesh is not empty
struct SoftOrgan {
  std::string name;
  const geometry::TriangleMesh* mesh = nullptr;
};

/// Immutable; const functions are thread-safe.
class SoftBody {
 public:
  /// Cost: half a second for twenty organs of 200k triangles.
  /// \pre the body has a skeleton, organs is not empty
  /// \throw base::Cancelled
  SoftBody(std::span<const SoftOrgan> organs, const parenting::BodyRig& body, const SoftBodyOptions& options,
           base::Threads threads, const base::Progress& progress = {});
  ~SoftBody();
  SoftBody(SoftBody&&) noexcept;
  SoftBody& operator=(SoftBody&&) noexcept;

  /// How the control points move in a pose: zero, exactly, at rest.
  /// The same bits at any number of threads. Cost: some milliseconds for 5000 cells on two cores.
  /// \pre pose is one of the body the organs were bound to
  std::vector<geometry::Vec3f> settle(const parenting::PosedBody& pose, base::Threads threads) const;

  /// The organ's vertices in the pose whose settle() gave `offsets`. What would come nearer to the skin than a
  /// millimetre, or than it is at rest, is held back, square to the skin over it. At rest every vertex keeps its bits.
  /// \param rest the organ's own vertices \pre posed.size() == rest.size()
  void place(std::size_t organ, std::span<const geometry::Vec3f> rest, std::span<const geometry::Vec3f> offsets,
             const parenting::PosedBody& pose, std::span<geometry::Vec3f> posed, base::Threads threads) const;

  const Embedding& embedding(std::size_t organ) const;
  /// Edge length of a cell, metres.
  double cell() const;
  std::size_t cells() const;
  std::size_t controlPoints() const;
  const base::Issues& issues() const;

 private:
  struct Parts;
  struct Binding;
  struct Settling;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace lorica::viscera
