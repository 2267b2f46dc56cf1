#include "lorica/analysis/deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "lorica/base/error.h"
#include "lorica/io/export.h"

namespace lorica::analysis {

using viscera::ContactAudit;
using viscera::OrganAudit;
using viscera::SkinRoom;

namespace {

viscera::DeformationAudit auditOf(const LoadedStudy& study, base::Threads threads, const base::Progress& progress,
                                  const viscera::AuditOptions& options) {
  std::vector<viscera::AuditedMesh> organs;
  for (const auto& organ : study.organs) {
    organs.push_back({organ->name, &organ->rig.rest, organ->topology});
  }
  return {
      {"body", &study.body->body().skin, study.body->skinTopology()}, std::move(organs), options, threads, progress};
}

}  // namespace

std::vector<const ModelDeformation*> rowsInOrder(const DeformationTables& tables) {
  std::vector<const ModelDeformation*> rows;
  for (const ModelDeformation& row : tables.rows) {
    rows.push_back(&row);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const ModelDeformation* a, const ModelDeformation* b) {
    return std::pair(a->model, a->pose) < std::pair(b->model, b->pose);
  });
  return rows;
}

StudyAudit::StudyAudit(const LoadedStudy& study, base::Threads threads, const base::Progress& progress,
                       const viscera::AuditOptions& options)
    : study_(&study), audit_(auditOf(study, threads, progress, options)) {}

ModelDeformation StudyAudit::measure(const PosedScene& scene, std::size_t model, base::Threads threads,
                                     const base::Progress& progress) const {
  LORICA_CHECK(model < scene.models().size(), "a model of the scene");
  std::vector<const geometry::Positions*> organs;
  ModelDeformation result;
  result.model = model;
  for (std::size_t o = 0; o < study_->organs.size(); ++o) {
    organs.push_back(&scene.organ(o, model));
    const bool soft = scene.models()[model] == viscera::OrganModel::dynamic && !scene.softBodyOffsets().empty();
    result.lattices.push_back(
        soft ? viscera::latticeQuality(study_->softBody->embedding(o), scene.softBodyOffsets())
             : viscera::latticeQuality(study_->organs[o]->rig, scene.models()[model], scene.body(), threads));
  }
  result.audit = audit_.measure(scene.body().skin, organs, threads, progress);
  return result;
}

std::optional<SkinRoom> StudyAudit::room(const PosedScene& scene) const {
  return restRoom() ? std::optional(viscera::skinRoom(study_->body->body(), scene.body().skin)) : std::nullopt;
}

std::optional<SkinRoom> StudyAudit::restRoom() const {
  const raycast::MeshTopology& skin = *study_->body->skinTopology();
  if (skin.hasOpenEdges || skin.closed.empty()) {
    return std::nullopt;
  }
  return viscera::skinRoom(study_->body->body(), study_->body->body().skin.positions);
}

namespace {

constexpr double percent = 100.0;
constexpr double millimetres = 1e3;
constexpr double squareCentimetres = 1e4;
constexpr double cubicCentimetres = 1e6;
constexpr double litres = 1e3;

std::string field(std::optional<double> value, double scale) {
  if (!value) {
    return {};
  }
  std::string text = fmt::format("{:.6f}", *value * scale);
  return text == "-0.000000" ? "0.000000" : text;
}

std::string csvLine(const std::vector<std::string>& fields) {
  return io::csvRow(fields);
}

std::optional<double> valueOf(const std::optional<viscera::Estimate>& estimate) {
  return estimate ? std::optional(estimate->value) : std::nullopt;
}

std::optional<double> errorOf(const std::optional<viscera::Estimate>& estimate) {
  return estimate ? std::optional(estimate->error) : std::nullopt;
}

std::optional<double> meanOf(const std::optional<viscera::Gap>& gap) {
  return gap ? std::optional(gap->mean) : std::nullopt;
}

std::optional<double> largestOf(const std::optional<viscera::Gap>& gap) {
  return gap ? std::optional(gap->largest) : std::nullopt;
}

using Pair = std::pair<std::size_t, std::size_t>;

std::set<Pair> pairsIn(const DeformationTables& tables) {
  std::set<Pair> pairs;
  for (const ModelDeformation& row : tables.rows) {
    for (const ContactAudit& contact : row.audit.contacts) {
      pairs.emplace(contact.first, contact.second);
    }
  }
  return pairs;
}

/// The contact of a pair in a pose; where the pose has none, that of two organs that do not meet.
ContactAudit contactOf(const viscera::PoseAudit& audit, const Pair& pair) {
  for (const ContactAudit& contact : audit.contacts) {
    if (Pair{contact.first, contact.second} == pair) {
      return contact;
    }
  }
  ContactAudit none{pair.first, pair.second, {}, {}, {}};
  if (audit.organs[pair.first].volume && audit.organs[pair.second].volume) {
    none.overlap = viscera::Estimate{};
    none.overlapBeyondRest = 0.0;
  }
  return none;
}

/// Organs that hold air or food give way to their surroundings.
bool mayChange(std::string_view organ) {
  constexpr std::array<std::string_view, 4> hollow{"lung", "stomach", "intestine", "colon"};
  return std::any_of(hollow.begin(), hollow.end(),
                     [&](std::string_view part) { return organ.find(part) != std::string_view::npos; });
}

std::string change(double now, double before) {
  return before != 0.0 ? field(now / before - 1.0, percent) : std::string();
}

}  // namespace

std::string gaveWay(std::string_view organ, const OrganAudit& audit, const viscera::LatticeQuality& lattice) {
  constexpr double protrusionBar = 1e-3;
  constexpr double overlapBar = 0.005;
  const double volumeBar = mayChange(organ) ? 0.05 : 0.02;
  std::vector<std::string> broken;
  if (lattice.inverted > 0) {
    broken.push_back(fmt::format("{} cells inverted", lattice.inverted));
  }
  if (audit.protrusion.value_or(0.0) >= protrusionBar) {
    broken.push_back(fmt::format("protrusion {:.1f} mm", millimetres * *audit.protrusion));
  }
  if (audit.volume && audit.overlapBeyondRest.value_or(0.0) > overlapBar * *audit.volume) {
    const double overlap = cubicCentimetres * *audit.overlapBeyondRest;
    broken.push_back(overlap < 1.0 ? fmt::format("overlap {:.2g} cm3", overlap)
                                   : fmt::format("overlap {:.1f} cm3", overlap));
  }
  if (std::abs(audit.volumeChange.value_or(0.0)) > volumeBar) {
    broken.push_back(fmt::format("volume {:+.1f} %", percent * *audit.volumeChange));
  }
  return fmt::format("{}", fmt::join(broken, "; "));
}

std::string deformationCsv(const DeformationTables& tables) {
  std::string text =
      "structure,model,pose,volume_change_pct,outside_skin_pct,protrusion_mm,overlap_cm3,gap_mm,inverted_cells,"
      "min_jacobian,max_stretch,overlap_beyond_rest_cm3,gap_max_mm,outside_skin_se_pct,overlap_se_cm3,"
      "outside_surface_pct,basis,gave_way\n";
  for (const ModelDeformation* row : rowsInOrder(tables)) {
    for (std::size_t o = 0; o < row->audit.organs.size(); ++o) {
      const OrganAudit& organ = row->audit.organs[o];
      const viscera::LatticeQuality& lattice = row->lattices[o];
      text += csvLine({tables.organs[o], viscera::name(tables.models[row->model]), tables.poses[row->pose],
                       field(organ.volumeChange, percent), field(valueOf(organ.outsideShare), percent),
                       field(organ.protrusion, millimetres), field(valueOf(organ.overlap), cubicCentimetres),
                       field(meanOf(organ.gap), millimetres), std::to_string(lattice.inverted),
                       field(lattice.smallestJacobian, 1.0), field(organ.largestStretch, 1.0),
                       field(organ.overlapBeyondRest, cubicCentimetres), field(largestOf(organ.gap), millimetres),
                       field(errorOf(organ.outsideShare), percent), field(errorOf(organ.overlap), cubicCentimetres),
                       field(organ.outsideSurface, percent), viscera::name(organ.basis),
                       gaveWay(tables.organs[o], organ, lattice)});
    }
  }
  return text;
}

std::string contactsCsv(const DeformationTables& tables) {
  std::string text =
      "structure_a,structure_b,model,pose,overlap_cm3,gap_mm,overlap_beyond_rest_cm3,overlap_se_cm3,gap_max_mm,"
      "contact_area_cm2\n";
  const std::set<Pair> pairs = pairsIn(tables);
  for (const ModelDeformation* row : rowsInOrder(tables)) {
    for (const Pair& pair : pairs) {
      const ContactAudit contact = contactOf(row->audit, pair);
      text += csvLine({tables.organs[pair.first], tables.organs[pair.second], viscera::name(tables.models[row->model]),
                       tables.poses[row->pose], field(valueOf(contact.overlap), cubicCentimetres),
                       field(meanOf(contact.gap), millimetres), field(contact.overlapBeyondRest, cubicCentimetres),
                       field(errorOf(contact.overlap), cubicCentimetres), field(largestOf(contact.gap), millimetres),
                       contact.gap ? field(contact.gap->area, squareCentimetres) : std::string()});
    }
  }
  return text;
}

std::string roomCsv(const DeformationTables& tables) {
  std::string text = "pose,skin_l,skin_change_pct,torso_l,torso_change_pct\n";
  for (std::size_t p = 0; tables.restRoom && p < tables.rooms.size(); ++p) {
    if (const std::optional<SkinRoom>& room = tables.rooms[p]) {
      text += csvLine({tables.poses[p], field(room->whole, litres), change(room->whole, tables.restRoom->whole),
                       field(room->torso, litres), change(room->torso, tables.restRoom->torso)});
    }
  }
  return text;
}

}  // namespace lorica::analysis
