#include "lorica/analysis/results.h"

#include <fmt/format.h>

#include <array>

#include "lorica/base/files.h"
#include "lorica/io/export.h"
#include "lorica/study/provenance.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {

using shotline::Count;
using shotline::Tally;

double ResultRow::percentOfShots() const {
  return shots == 0 ? 0.0 : 100.0 * static_cast<double>(count.any) / static_cast<double>(shots);
}

std::optional<double> ResultRow::percentOfBodyHits() const {
  if (bodyHits == 0) {
    return std::nullopt;
  }
  return 100.0 * static_cast<double>(count.withBody) / static_cast<double>(bodyHits);
}

std::optional<double> ResultRow::coverage() const {
  if (count.any == 0) {
    return std::nullopt;
  }
  return static_cast<double>(count.shielded) / static_cast<double>(count.any);
}

std::optional<stats::Interval> ResultRow::coverageInterval() const {
  if (count.any == 0) {
    return std::nullopt;
  }
  return stats::wilson(count.shielded, count.any);
}

namespace {

/// Rows of one (source, system, model, pose) from one tally.
void appendBlock(std::vector<ResultRow>& rows, const LoadedStudy& study, ResultRow head, const Tally& tally,
                 std::size_t system, std::size_t model) {
  head.shots = tally.shots();
  head.bodyHits = tally.body(system).any;
  const auto row = [&](const std::string& structure, const char* kind, const std::string& injuryClass,
                       const Count& count) {
    ResultRow made = head;
    made.structure = structure;
    made.kind = kind;
    made.injuryClass = injuryClass;
    made.count = count;
    rows.push_back(std::move(made));
  };
  row("body", "body", "", tally.body(system));
  row("miss", "body", "", tally.miss());
  const auto& regions = study.body->body().regions.names;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    row(regions[r], "region", "", tally.region(r, system));
  }
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    row(study.organs[o]->name, "organ", study.study.organs[o].injuryClass, tally.organ(o, model, system));
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    if (study.systemOfPiece[p] + 1 == system) {
      row(study.pieces[p]->name, "armor", "", tally.piece(p));
    }
  }
  row("armor", "aggregate", "", tally.anyArmor(system));
  row("organs", "aggregate", "", tally.anyOrgan(model, system));
}

/// Walks blocks in the tables' order and hands each to `emit`.
template <class Emit>
void forEachBlock(const RunResult& result, const Emit& emit) {
  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    for (std::size_t system = 0; system < result.systems.size(); ++system) {
      for (std::size_t model = 0; model < result.models.size(); ++model) {
        for (std::size_t p = 0; p < result.poses.size(); ++p) {
          const SourcePoseResult& here = result.results[s * result.poses.size() + p];
          if (here.trials.empty()) {
            continue;
          }
          ResultRow head;
          head.source = result.sources[s].source.name;
          head.system = result.systems[system];
          head.model = viscera::name(result.models[model]);
          head.pose = result.poses[p];
          emit(head, here, system, model);
        }
      }
    }
  }
}

std::string number(std::optional<double> value) {
  return value ? fmt::format("{:.6f}", *value) : std::string();
}

std::string csv(const std::vector<ResultRow>& rows, bool withTrial) {
  std::string text = withTrial ? "source,system,model,pose,trial,structure" : "source,system,model,pose,structure";
  text +=
      ",kind,class,shots,any_hit,first_hit,unprotected_hit,protected_hit,pct_of_shots,pct_of_body_hits,coverage,"
      "coverage_lo,coverage_hi\n";
  for (const ResultRow& row : rows) {
    std::vector<std::string> fields{row.source, row.system, row.model, row.pose};
    if (withTrial) {
      fields.push_back(std::to_string(row.trial.value_or(0)));
    }
    const std::optional<stats::Interval> interval = row.coverageInterval();
    for (std::string& field :
         std::array{row.structure, row.kind, row.injuryClass, std::to_string(row.shots), std::to_string(row.count.any),
                    std::to_string(row.count.first), std::to_string(row.unprotected()),
                    std::to_string(row.count.shielded), number(row.percentOfShots()), number(row.percentOfBodyHits()),
                    number(row.coverage()), number(interval ? std::optional(interval->low) : std::nullopt),
                    number(interval ? std::optional(interval->high) : std::nullopt)}) {
      fields.push_back(std::move(field));
    }
    text += io::csvRow(fields);
  }
  return text;
}

}  // namespace

std::vector<ResultRow> summaryRows(const LoadedStudy& study, const RunResult& result) {
  std::vector<ResultRow> rows;
  forEachBlock(result, [&](const ResultRow& head, const SourcePoseResult& here, std::size_t system, std::size_t model) {
    Tally sum;
    for (const Tally& trial : here.trials) {
      sum.add(trial);
    }
    appendBlock(rows, study, head, sum, system, model);
  });
  return rows;
}

std::vector<ResultRow> trialRows(const LoadedStudy& study, const RunResult& result) {
  std::vector<ResultRow> rows;
  forEachBlock(result, [&](ResultRow head, const SourcePoseResult& here, std::size_t system, std::size_t model) {
    for (std::size_t t = 0; t < here.trials.size(); ++t) {
      head.trial = static_cast<std::uint32_t>(t + 1);
      appendBlock(rows, study, head, here.trials[t], system, model);
    }
  });
  return rows;
}

DeformationTables deformationTables(const LoadedStudy& study, const RunResult& result) {
  DeformationTables tables;
  for (const auto& organ : study.organs) {
    tables.organs.push_back(organ->name);
  }
  tables.poses = result.poses;
  tables.models = result.models;
  tables.rows = result.deformations;
  tables.rooms = result.rooms;
  tables.restRoom = result.restRoom;
  return tables;
}

std::string summaryCsv(const std::vector<ResultRow>& rows) {
  return csv(rows, false);
}
std::string trialsCsv(const std::vector<ResultRow>& rows) {
  return csv(rows, true);
}

std::string provenanceJson(const LoadedStudy& study, const RunResult& result) {
  study::Provenance provenance;
  provenance.study = study.study;
  provenance.seed = result.seed;
  provenance.trials = result.trials;
  provenance.partial = result.partial;
  provenance.poses = result.poses;
  provenance.systems = result.systems;
  for (const viscera::OrganModel model : result.models) {
    provenance.models.push_back(viscera::name(model));
  }
  for (const ShotSource& source : result.sources) {
    provenance.sources.push_back({source.source.name, source.source.position, source.source.target,
                                  source.source.sampler == shotline::Sampler::cone ? "cone" : "thesis", source.shots,
                                  source.source.halfAngle, source.solidAngle});
  }
  for (const SourcePoseResult& here : result.results) {
    provenance.runs.push_back({result.sources[here.source].source.name, result.poses[here.pose], here.trials.size(),
                               here.counts.rays, here.counts.retraced, here.counts.unresolved,
                               here.counts.nearOpenEdge});
  }
  for (std::size_t p = 0; p < result.collapsedSites.size(); ++p) {
    provenance.collapsedSites.push_back(result.collapsedSites[p]);
  }
  provenance.interiorSites = study.body->sites().size();
  provenance.issues = result.issues;
  return study::provenanceText(provenance);
}

void writeResults(const LoadedStudy& study, const RunResult& result, const std::filesystem::path& folder) {
  const DeformationTables deformations = deformationTables(study, result);
  base::writeFilesAtomically({{folder / "summary.csv", summaryCsv(summaryRows(study, result))},
                              {folder / "trials.csv", trialsCsv(trialRows(study, result))},
                              {folder / "deformation.csv", deformationCsv(deformations)},
                              {folder / "contacts.csv", contactsCsv(deformations)},
                              {folder / "room.csv", roomCsv(deformations)},
                              {folder / "provenance.json", provenanceJson(study, result)}});
}

}  // namespace lorica::analysis
