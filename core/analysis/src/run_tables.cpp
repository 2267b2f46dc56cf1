#include "lorica/analysis/run_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "lorica/analysis/posed_scene.h"
#include "lorica/base/error.h"
#include "row_reader.h"

namespace lorica::analysis {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads the tables of one folder against what its provenance says.
class Folder {
 public:
  explicit Folder(const fs::path& folder) : folder_(folder) {
    tables_.facts = study::readProvenance(folder / "provenance.json");
    for (const study::RunFacts::Source& source : tables_.facts.sources) {
      sources_.push_back(source.name);
    }
  }

  RunTables read() {
    readSummary();
    checkSummary();
    readDeformation();
    readContacts();
    readRooms();
    readComparisons();
    readPieces();
    readSystems();
    readConvergence();
    readGaps();
    readAnatomy();
    readDirections();
    readMotion();
    readMotionSummary();
    return std::move(tables_);
  }

 private:
  /// Whether a table is there that need not be. One that provenance names and that is not there is noted.
  bool has(const char* name) {
    const auto& named = tables_.facts.tables;
    if (named && !holds(*named, name)) {
      return false;
    }
    std::error_code ignored;
    if (!fs::exists(folder_ / name, ignored)) {
      if (named) {
        tables_.missing.emplace_back(name);
      }
      return false;
    }
    tables_.present.emplace_back(name);
    return true;
  }

  /// \throw base::InputError when a name is none of the run's
  void expectKnown(const RowReader& row, const Names& known, const char* column, const std::string& name) const {
    if (!holds(known, name)) {
      row.fail(
          fmt::format("'{}' is no {} of the run that provenance.json is of; the files are of different runs, so "
                      "run the study again",
                      name, column));
    }
  }
  RowPlace placeOf(const RowReader& row, bool source, bool system, bool model, bool pose) const {
    RowPlace place;
    const auto take = [&](bool wanted, const char* column, const Names& known, std::string& into) {
      if (wanted) {
        into = row.text(column);
        expectKnown(row, known, column, into);
      }
    };
    take(source, "source", sources_, place.source);
    take(system, "system", tables_.facts.systems, place.system);
    take(model, "model", tables_.facts.models, place.model);
    take(pose, "pose", tables_.facts.poses, place.pose);
    return place;
  }
  RowPlace placeOf(const RowReader& row) const { return placeOf(row, true, true, true, true); }
  static Coverage coverageOf(const RowReader& row) {
    return {row.share("coverage"), row.share("coverage_lo"), row.share("coverage_hi")};
  }

  void readSummary() {
    RowReader row(folder_ / "summary.csv", {"source", "system", "model", "pose", "structure", "kind", "class", "shots",
                                            "any_hit", "first_hit", "unprotected_hit", "protected_hit", "pct_of_shots",
                                            "pct_of_body_hits", "coverage", "coverage_lo", "coverage_hi"});
    while (row.next()) {
      CoverageRow read;
      read.place = placeOf(row);
      read.structure = row.text("structure");
      read.kind = row.text("kind");
      read.injuryClass = row.text("class");
      read.shots = row.whole("shots");
      read.any = row.atMost("any_hit", read.shots, "shots");
      read.first = row.atMost("first_hit", read.any, "any_hit");
      read.unprotectedHits = row.atMost("unprotected_hit", read.any, "any_hit");
      read.protectedHits = row.atMost("protected_hit", read.any, "any_hit");
      if (read.unprotectedHits + read.protectedHits != read.any) {
        row.fail("'unprotected_hit' and 'protected_hit' do not add up to 'any_hit'");
      }
      read.percentOfShots = row.number("pct_of_shots");
      read.percentOfBodyHits = row.maybe("pct_of_body_hits");
      read.coverage = coverageOf(row);
      tables_.summary.push_back(std::move(read));
    }
    tables_.present.emplace_back("summary.csv");
  }

  /// A cut file has fewer blocks than provenance tells, or a last one without its end.
  void checkSummary() const {
    std::map<std::array<std::string, 4>, std::set<std::string>> blocks;
    for (const CoverageRow& row : tables_.summary) {
      auto& block = blocks[{row.place.source, row.place.system, row.place.model, row.place.pose}];
      if (!block.insert(row.kind + "/" + row.structure).second) {
        throw base::InputError(
            (folder_ / "summary.csv").string(), "",
            fmt::format("has '{}' twice for one source, system, model and pose; run the study again", row.structure));
      }
    }
    const std::string last = fmt::format("class/{}", injuryClasses.back());
    for (const study::RunFacts::Run& run : tables_.facts.runs) {
      for (const std::string& system : run.trials > 0 ? tables_.facts.systems : Names()) {
        for (const std::string& model : tables_.facts.models) {
          const auto block = blocks.find({run.source, system, model, run.pose});
          if (block == blocks.end() || !block->second.contains("body/body") || !block->second.contains(last)) {
            throw base::InputError(
                (folder_ / "summary.csv").string(), "",
                fmt::format("lacks rows for source '{}', system '{}', model '{}', pose '{}', which provenance.json "
                            "says were shot; the file is cut, so run the study again",
                            run.source, system, model, run.pose));
          }
        }
      }
    }
  }

  void readDeformation() {
    RowReader row(folder_ / "deformation.csv",
                  {"structure", "model", "pose", "volume_change_pct", "outside_skin_pct", "protrusion_mm", "gap_mm",
                   "inverted_cells", "max_stretch", "overlap_beyond_rest_cm3", "gap_max_mm", "basis", "gave_way"});
    while (row.next()) {
      const RowPlace place = placeOf(row, false, false, true, true);
      tables_.deformation.push_back({row.text("structure"), place.model, place.pose, row.maybe("volume_change_pct"),
                                     row.maybe("outside_skin_pct"), row.maybe("protrusion_mm"),
                                     row.maybe("overlap_beyond_rest_cm3"), row.maybe("gap_mm"), row.maybe("gap_max_mm"),
                                     row.maybe("max_stretch"), row.whole("inverted_cells"), row.text("basis"),
                                     row.text("gave_way")});
    }
    tables_.present.emplace_back("deformation.csv");
    checkDeformation();
  }
  /// Every organ that was shot at was audited in every pose and model.
  void checkDeformation() const {
    std::set<std::array<std::string, 3>> audited;
    for (const DeformationRow& row : tables_.deformation) {
      audited.insert({row.organ, row.model, row.pose});
    }
    for (const CoverageRow& row : tables_.summary) {
      if (row.kind == "organ" && !tables_.facts.partial &&
          !audited.contains({row.structure, row.place.model, row.place.pose})) {
        throw base::InputError((folder_ / "deformation.csv").string(), "",
                               fmt::format("lacks the row for '{}', model '{}', pose '{}', which summary.csv has; the "
                                           "file is cut, so run the study again",
                                           row.structure, row.place.model, row.place.pose));
      }
    }
  }
  void readContacts() {
    RowReader row(folder_ / "contacts.csv",
                  {"structure_a", "structure_b", "model", "pose", "overlap_beyond_rest_cm3", "gap_max_mm"});
    while (row.next()) {
      const RowPlace place = placeOf(row, false, false, true, true);
      tables_.contacts.push_back({row.text("structure_a"), row.text("structure_b"), place.model, place.pose,
                                  row.maybe("overlap_beyond_rest_cm3"), row.maybe("gap_max_mm")});
    }
    tables_.present.emplace_back("contacts.csv");
  }
  void readRooms() {
    RowReader row(folder_ / "room.csv", {"pose", "skin_l", "skin_change_pct", "torso_l", "torso_change_pct"});
    while (row.next()) {
      tables_.rooms.push_back({placeOf(row, false, false, false, true).pose, row.maybe("skin_l"),
                               row.maybe("skin_change_pct"), row.maybe("torso_l"), row.maybe("torso_change_pct")});
    }
    tables_.present.emplace_back("room.csv");
  }
  void readComparisons() {
    if (!has("comparisons.csv")) {
      return;
    }
    RowReader row(folder_ / "comparisons.csv",
                  {"comparison", "source", "pose", "model_or_system", "first", "second", "structure", "coverage_first",
                   "coverage_second", "only_first", "only_second", "mcnemar_p_holm", "difference", "difference_lo",
                   "difference_hi", "paired_p_holm"});
    while (row.next()) {
      ComparisonRow read;
      read.what = row.text("comparison");
      read.place = placeOf(row, true, false, false, true);
      read.held = row.text("model_or_system");
      read.first = row.text("first");
      read.second = row.text("second");
      read.structure = row.text("structure");
      read.coverageFirst = row.share("coverage_first");
      read.coverageSecond = row.share("coverage_second");
      read.onlyFirst = row.whole("only_first");
      read.onlySecond = row.whole("only_second");
      read.mcNemarHolm = row.share("mcnemar_p_holm");
      read.difference = {row.maybe("difference"), row.maybe("difference_lo"), row.maybe("difference_hi")};
      read.pairedHolm = row.share("paired_p_holm");
      tables_.comparisons.push_back(std::move(read));
    }
  }
  void readPieces() {
    if (!has("pieces.csv")) {
      return;
    }
    RowReader row(folder_ / "pieces.csv", {"source", "pose", "model", "system", "piece", "structure", "any_hit",
                                           "protected_hit", "protected_by_it_alone", "coverage", "coverage_without"});
    while (row.next()) {
      PieceRow read;
      read.place = placeOf(row);
      read.piece = row.text("piece");
      read.structure = row.text("structure");
      read.any = row.whole("any_hit");
      read.protectedHits = row.atMost("protected_hit", read.any, "any_hit");
      read.alone = row.atMost("protected_by_it_alone", read.protectedHits, "protected_hit");
      read.coverage = row.share("coverage");
      read.without = row.share("coverage_without");
      tables_.pieces.push_back(std::move(read));
    }
  }
  void readSystems() {
    if (!has("systems.csv")) {
      return;
    }
    RowReader row(folder_ / "systems.csv", {"source", "system", "model", "pose", "pieces_area_m2", "mass_kg",
                                            "structure", "coverage", "coverage_lo", "coverage_hi"});
    while (row.next()) {
      tables_.systems.push_back(
          {placeOf(row), row.number("pieces_area_m2"), row.maybe("mass_kg"), row.text("structure"), coverageOf(row)});
    }
  }
  void readConvergence() {
    if (!has("convergence.csv")) {
      return;
    }
    RowReader row(folder_ / "convergence.csv", {"source", "system", "model", "pose", "structure", "kind", "trials",
                                                "coverage", "coverage_lo", "coverage_hi"});
    while (row.next()) {
      tables_.convergence.push_back(
          {placeOf(row), row.text("structure"), row.text("kind"), row.whole("trials"), coverageOf(row)});
    }
  }
  void readGaps() {
    if (!has("gaps.csv")) {
      return;
    }
    RowReader row(folder_ / "gaps.csv",
                  {"source", "system", "model", "pose", "structure", "patch", "region", "area_cm2", "azimuth_deg",
                   "elevation_deg", "unprotected_hit", "pct_of_unprotected", "neighbours"});
    while (row.next()) {
      tables_.gaps.push_back({placeOf(row), row.text("structure"), row.whole("patch"), row.text("region"),
                              row.maybe("area_cm2"), row.maybe("azimuth_deg"), row.maybe("elevation_deg"),
                              row.whole("unprotected_hit"), row.maybe("pct_of_unprotected"), row.text("neighbours")});
    }
  }
  void readAnatomy() {
    if (!has("anatomy.csv")) {
      return;
    }
    RowReader row(folder_ / "anatomy.csv",
                  {"source", "system", "model", "pose", "structure", "kind", "draws", "coverage", "coverage_lo",
                   "coverage_hi", "coverage_p05", "coverage_p50", "coverage_p95"});
    while (row.next()) {
      tables_.anatomy.push_back({placeOf(row), row.text("structure"), row.text("kind"), row.whole("draws"),
                                 coverageOf(row), row.share("coverage_p05"), row.share("coverage_p50"),
                                 row.share("coverage_p95")});
    }
  }
  void readDirections() {
    if (!has("directions.csv")) {
      return;
    }
    RowReader row(folder_ / "directions.csv",
                  {"system", "model", "pose", "structure", "kind", "azimuth_deg", "elevation_deg", "coverage",
                   "coverage_lo", "coverage_hi", "unprotected_area_m2", "lowest_coverage"});
    while (row.next()) {
      tables_.directions.push_back({placeOf(row, false, true, true, true), row.text("structure"), row.text("kind"),
                                    row.number("azimuth_deg"), row.number("elevation_deg"), coverageOf(row),
                                    row.maybe("unprotected_area_m2"), row.whole("lowest_coverage") != 0});
    }
  }
  void readMotion() {
    if (!has("motion.csv")) {
      return;
    }
    RowReader row(folder_ / "motion.csv", {"source", "system", "model", "frame", "time_s", "structure", "kind",
                                           "coverage", "coverage_lo", "coverage_hi"});
    while (row.next()) {
      tables_.motion.push_back({placeOf(row, true, true, true, false), row.whole("frame"), row.number("time_s"),
                                row.text("structure"), row.text("kind"), coverageOf(row)});
    }
  }
  void readMotionSummary() {
    if (!has("motion_summary.csv")) {
      return;
    }
    RowReader row(folder_ / "motion_summary.csv", {"source", "system", "model", "structure", "kind",
                                                   "coverage_time_mean", "coverage_lowest", "worst_time_s"});
    while (row.next()) {
      tables_.motionSummary.push_back({placeOf(row, true, true, true, false), row.text("structure"), row.text("kind"),
                                       row.share("coverage_time_mean"), row.share("coverage_lowest"),
                                       row.maybe("worst_time_s")});
    }
  }

  fs::path folder_;
  RunTables tables_;
  Names sources_;
};

}  // namespace

RunTables readRunTables(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw base::InputError(folder.string(), "", "is no folder; name the one that lorica-cli run wrote");
  }
  return Folder(folder).read();
}

}  // namespace lorica::analysis
