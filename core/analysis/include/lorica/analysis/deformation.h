#pragma once

/// \file
/// The deformation audit of a study: every organ, pose and model in numbers, as deformation.csv, contacts.csv and
/// room.csv.

#include "lorica/analysis/posed_scene.h"
#include "lorica/viscera/deformation_audit.h"
#include "lorica/viscera/lattice_quality.h"
#include "lorica/viscera/skin_room.h"

namespace lorica::analysis {

/// What one pose did to the organs of one model.
struct ModelDeformation {
  std::size_t pose = 0;   ///< index into the names of the poses
  std::size_t model = 0;  ///< index into the models
  viscera::PoseAudit audit;
  std::vector<viscera::LatticeQuality> lattices;  ///< per organ

  bool operator==(const ModelDeformation&) const = default;
};

/// The audit of a study's body and organs. Immutable; const functions are thread-safe.
class StudyAudit {
 public:
  /// \pre study outlives the audit. Cost: as viscera::DeformationAudit. \throw base::Cancelled
  explicit StudyAudit(const LoadedStudy& study, base::Threads threads, const base::Progress& progress = {},
                      const viscera::AuditOptions& options = {});

  /// \pre scene shows the study, model < scene.models().size()
  /// \return its `pose` is 0. \throw base::Cancelled
  ModelDeformation measure(const PosedScene& scene, std::size_t model, base::Threads threads,
                           const base::Progress& progress = {}) const;

  /// The room inside the skin; none for one that does not close.
  std::optional<viscera::SkinRoom> room(const PosedScene& scene) const;
  std::optional<viscera::SkinRoom> restRoom() const;

  const viscera::DeformationAudit& meshes() const { return audit_; }

 private:
  const LoadedStudy* study_;
  viscera::DeformationAudit audit_;
};

/// Deformations with the names of what their indices mean.
struct DeformationTables {
  std::vector<std::string> organs;
  std::vector<std::string> poses;
  std::vector<viscera::OrganModel> models;
  std::vector<ModelDeformation> rows;                   ///< any part of poses times models
  std::vector<std::optional<viscera::SkinRoom>> rooms;  ///< per pose, as far as they are known
  std::optional<viscera::SkinRoom> restRoom;            ///< none for a skin that does not close
};

/// The tables' rows by model, then pose: the order of the files.
std::vector<const ModelDeformation*> rowsInOrder(const DeformationTables& tables);

/// What an organ does against the bars it should keep, and by how much, in the order in which they matter: a lattice
/// turned inside out, protrusion of a millimetre or more, overlap beyond rest of over 0.5 % of its volume, volume off
/// by over 2 % (5 % for lungs, stomach, intestines and colon, by their names). Empty when it keeps them all; where the
/// skin leaves no room, no organ can.
std::string gaveWay(std::string_view organ, const viscera::OrganAudit& audit, const viscera::LatticeQuality& lattice);

/// structure, model, pose, volume_change_pct, outside_skin_pct, protrusion_mm, overlap_cm3, gap_mm, inverted_cells,
/// min_jacobian, max_stretch; then overlap_beyond_rest_cm3, gap_max_mm, outside_skin_se_pct, overlap_se_cm3,
/// outside_surface_pct, basis, gave_way. Ordered by model, pose, organ. A blank field: not measurable, see `basis`.
std::string deformationCsv(const DeformationTables& tables);
/// structure_a, structure_b, model, pose, overlap_cm3, gap_mm; then overlap_beyond_rest_cm3, overlap_se_cm3,
/// gap_max_mm, contact_area_cm2. Ordered by model, pose, pair; every pair that touches or overlaps at rest or in one of
/// the rows has a row for each pose and model.
std::string contactsCsv(const DeformationTables& tables);
/// pose, skin_l, skin_change_pct, torso_l, torso_change_pct. No row for a skin that does not close.
std::string roomCsv(const DeformationTables& tables);

}  // namespace lorica::analysis
