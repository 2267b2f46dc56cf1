#pragma once

#include <functional>
#include <span>

#include "lorica/analysis/run.h"

namespace lorica::analysis {

/// The posed skins of all poses compared, one after another. Those of the first poses are kept, as far as they fit into
/// some memory; the others are posed again whenever they are asked for: motions have thousands.
class PosedSkins {
 public:
  using Repose = std::function<geometry::Positions(std::size_t pose)>;
  /// Of one pose.
  explicit PosedSkins(geometry::Positions skin) { add(std::move(skin)); }
  /// \param again gives the skin of a pose that was added before
  explicit PosedSkins(Repose again) : again_(std::move(again)) {}

  void add(geometry::Positions skin);
  /// Calls `use` with the skin of every pose, in the order in which they were added.
  void forEach(const std::function<void(std::span<const geometry::Vec3f>)>& use) const;
  /// Around all of them.
  const geometry::Box3d& box() const { return box_; }

 private:
  static constexpr std::size_t keptBytes = 16U << 20U;

  Repose again_;
  std::vector<geometry::Positions> kept_;  // of the first poses
  std::size_t bytes_ = 0;                  // of those
  std::size_t poses_ = 0;
  geometry::Box3d box_;
};

/// What a source is aimed at: the same for all poses compared.
struct Aim {
  PosedSkins skins;
  /// Box around an organ or a piece over all poses and models; empty when the study has none of that name.
  std::function<geometry::Box3d(const std::string& structure)> boxOf;
};

/// A source of the study made ready: its target, and the cone or disk that bounds the posed skins.
/// \throw base::InputError when it stands on its target or inside a posed skin, or the structure it is aimed at is
///        unknown
ShotSource prepareSource(const LoadedStudy& study, std::size_t source, const Aim& aim, base::Issues& issues);

}  // namespace lorica::analysis
