#include "lorica/analysis/results.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "lorica/analysis/anatomy.h"
#include "lorica/analysis/comparisons.h"
#include "lorica/analysis/directions.h"
#include "lorica/analysis/gaps.h"
#include "lorica/analysis/posed_scene.h"
#include "lorica/base/error.h"
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
  return independent ? stats::wilson(count.shielded, count.any) : stats::ratioInterval(coverageByTrial);
}

std::optional<stats::Interval> ResultRow::shareInterval() const {
  return independent ? stats::wilson(count.any, shots) : stats::ratioInterval(shareByTrial);
}

std::optional<stats::Moments> ResultRow::coverageOverTrials() const {
  stats::Moments moments;
  for (const stats::TrialCount& here : coverageByTrial) {
    if (here.base > 0) {
      moments.add(static_cast<double>(here.hits) / static_cast<double>(here.base));
    }
  }
  return moments.count() < 2 ? std::nullopt : std::optional(moments);
}

namespace {

/// Rows of one (source, system, model, pose) from one tally.
/// \param trials what the tally is the sum of
void appendBlock(std::vector<ResultRow>& rows, const LoadedStudy& study, ResultRow head, const Tally& tally,
                 std::span<const Tally> trials, std::size_t system, std::size_t model) {
  head.shots = tally.shots();
  head.bodyHits = tally.body(system).any;
  const auto row = [&](const std::string& structure, const char* kind, const std::string& injuryClass,
                       const auto& countOf) {
    const Count count = countOf(tally);
    ResultRow made = head;
    made.structure = structure;
    made.kind = kind;
    made.injuryClass = injuryClass;
    made.count = count;
    for (const Tally& trial : trials) {
      const Count part = countOf(trial);
      made.shareByTrial.push_back({part.any, trial.shots()});
      made.coverageByTrial.push_back({part.shielded, part.any});
    }
    rows.push_back(std::move(made));
  };
  row("body", "body", "", [&](const Tally& t) { return t.body(system); });
  row("miss", "body", "", [](const Tally& t) { return t.miss(); });
  const auto& regions = study.body->body().regions.names;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    row(regions[r], "region", "", [&](const Tally& t) { return t.region(r, system); });
  }
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    row(study.organs[o]->name, "organ", study.study.organs[o].injuryClass,
        [&](const Tally& t) { return t.organ(o, model, system); });
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    if (study.systemOfPiece[p] + 1 == system) {
      row(study.pieces[p]->name, "armor", "", [&](const Tally& t) { return t.piece(p); });
    }
  }
  row("armor", "aggregate", "", [&](const Tally& t) { return t.anyArmor(system); });
  row("organs", "aggregate", "", [&](const Tally& t) { return t.anyOrgan(model, system); });
  for (std::size_t c = 0; c < injuryClasses.size(); ++c) {
    const std::string name(injuryClasses.at(c));
    row(name, "class", name, [&](const Tally& t) { return t.organClass(c, model, system); });
  }
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
          head.measure = result.sources[s].measure;
          head.independent = shotline::independentShots(result.sources[s].source);
          head.drawn = shotline::isDrawn(result.sources[s].source);
          emit(head, here, system, model);
        }
      }
    }
  }
}

std::string low(const std::optional<stats::Interval>& interval, double scale = 1.0) {
  return interval ? io::csvNumber(scale * interval->low) : std::string();
}

std::string high(const std::optional<stats::Interval>& interval, double scale = 1.0) {
  return interval ? io::csvNumber(scale * interval->high) : std::string();
}

/// What the row's percentage of shots is a share of, and how sure it is.
void appendBasis(std::vector<std::string>& fields, const ResultRow& row) {
  const std::optional<stats::Interval> share = row.shareInterval();
  fields.push_back(low(share, 100.0));
  fields.push_back(high(share, 100.0));
  fields.emplace_back(!row.drawn ? "none" : row.independent ? "wilson" : "trials");
  switch (row.measure.basis) {
    case shotline::Basis::solidAngle:
      fields.emplace_back("solid angle");
      fields.emplace_back("sr");
      break;
    case shotline::Basis::area:
      fields.emplace_back("presented area");
      fields.emplace_back("m2");
      break;
    case shotline::Basis::shots:
      fields.emplace_back("shots");
      fields.emplace_back("");
      fields.emplace_back("");
      return;
  }
  fields.push_back(fmt::format("{:.9g}", row.measure.total));
}

/// The trials' coverage: its mean, standard deviation and standard error.
void appendTrials(std::vector<std::string>& fields, const ResultRow& row) {
  const std::optional<stats::Moments> moments = row.coverageOverTrials();
  if (!moments) {
    fields.insert(fields.end(), 3, "");
    return;
  }
  const double deviation = moments->standardDeviation();
  fields.push_back(io::csvNumber(moments->mean()));
  fields.push_back(io::csvNumber(deviation));
  fields.push_back(io::csvNumber(deviation / std::sqrt(static_cast<double>(moments->count()))));
}

std::string csv(const std::vector<ResultRow>& rows, bool withTrial) {
  std::string text = withTrial ? "source,system,model,pose,trial,structure" : "source,system,model,pose,structure";
  text +=
      ",kind,class,shots,any_hit,first_hit,unprotected_hit,protected_hit,pct_of_shots,pct_of_body_hits,coverage,"
      "coverage_lo,coverage_hi,pct_of_shots_lo,pct_of_shots_hi,interval,basis,unit,basis_total,coverage_trials_mean,"
      "coverage_trials_sd,coverage_trials_se\n";
  for (const ResultRow& row : rows) {
    std::vector<std::string> fields{row.source, row.system, row.model, row.pose};
    if (withTrial) {
      fields.push_back(std::to_string(row.trial.value_or(0)));
    }
    const std::optional<stats::Interval> interval = row.coverageInterval();
    for (std::string& field : std::array{row.structure, row.kind, row.injuryClass, std::to_string(row.shots),
                                         std::to_string(row.count.any), std::to_string(row.count.first),
                                         std::to_string(row.unprotected()), std::to_string(row.count.shielded),
                                         io::csvNumber(row.percentOfShots()), io::csvNumber(row.percentOfBodyHits()),
                                         io::csvNumber(row.coverage()), low(interval), high(interval)}) {
      fields.push_back(std::move(field));
    }
    appendBasis(fields, row);
    appendTrials(fields, row);
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
    appendBlock(rows, study, head, sum, here.trials, system, model);
  });
  return rows;
}

std::vector<ResultRow> trialRows(const LoadedStudy& study, const RunResult& result) {
  std::vector<ResultRow> rows;
  forEachBlock(result, [&](ResultRow head, const SourcePoseResult& here, std::size_t system, std::size_t model) {
    for (std::size_t t = 0; t < here.trials.size(); ++t) {
      head.trial = static_cast<std::uint32_t>(t + 1);
      appendBlock(rows, study, head, here.trials[t], std::span(&here.trials[t], 1), system, model);
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

namespace {

/// The study's inputs; those written by hand, without a hash, get that of their file.
std::vector<study::InputFile> hashedInputs(const LoadedStudy& study) {
  std::vector<study::InputFile> inputs = study::inputFiles(study.study);
  for (study::InputFile& input : inputs) {
    if (input.sha256.empty()) {
      try {
        input.sha256 = study::sha256OfInput(study::resolve(input, study.file));
      } catch (const base::InputError&) {
        // Gone since it was read: then there is no hash to tell.
      }
    }
  }
  return inputs;
}

/// The tables of a run, those of writeAnalyses() among them: none of a run before it in the same folder is one of them.
std::vector<std::string> tablesOf(const LoadedStudy& study, const RunResult& result) {
  std::vector<std::string> names{"summary.csv", "trials.csv", "deformation.csv", "contacts.csv", "room.csv"};
  const auto add = [&](bool wanted, std::initializer_list<const char*> files) {
    if (wanted) {
      names.insert(names.end(), files.begin(), files.end());
    }
  };
  const study::Analyses& wanted = study.study.analyses;
  add(wanted.compare, {"comparisons.csv", "pieces.csv", "systems.csv"});
  add(wanted.convergence, {"convergence.csv"});
  if (!result.partial) {
    add(wanted.gaps.has_value(), {"gaps.csv"});
    add(wanted.anatomy.has_value(), {"anatomy.csv"});
    add(wanted.directions.has_value(), {"directions.csv"});
    add(wanted.motion.has_value(), {"motion.csv", "motion_summary.csv"});
  }
  return names;
}

study::Provenance::SourceRecord recordOf(const ShotSource& source) {
  study::Provenance::SourceRecord record;
  record.source = source.source;
  record.shots = source.shots;
  record.measure = source.measure;
  return record;
}

}  // namespace

std::string provenanceJson(const LoadedStudy& study, const RunResult& result) {
  study::Provenance provenance;
  provenance.study = study.study;
  provenance.inputs = hashedInputs(study);
  provenance.seed = result.seed;
  provenance.trials = result.trials;
  provenance.partial = result.partial;
  provenance.poses = result.poses;
  provenance.systems = result.systems;
  for (const viscera::OrganModel model : result.models) {
    provenance.models.push_back(viscera::name(model));
  }
  for (const ShotSource& source : result.sources) {
    provenance.sources.push_back(recordOf(source));
  }
  for (const SourcePoseResult& here : result.results) {
    provenance.runs.push_back({result.sources[here.source].source.name, result.poses[here.pose], here.trials.size(),
                               here.counts.rays, here.counts.retraced, here.counts.unresolved, here.counts.nearOpenEdge,
                               here.goalReached});
  }
  for (std::size_t p = 0; p < result.collapsedSites.size(); ++p) {
    provenance.collapsedSites.push_back(result.collapsedSites[p]);
  }
  provenance.interiorSites = study.body->sites().size();
  provenance.issues = result.issues;
  provenance.tables = tablesOf(study, result);
  return study::provenanceText(provenance);
}

std::string markedPartial(std::string_view csv) {
  return io::csvWithColumn(csv, "partial", "yes");
}

void writeProvenance(const LoadedStudy& study, const RunResult& result, const std::filesystem::path& folder) {
  base::writeFileAtomically(folder / "provenance.json", provenanceJson(study, result));
}

void writeResults(const LoadedStudy& study, const RunResult& result, const std::filesystem::path& folder) {
  const DeformationTables deformations = deformationTables(study, result);
  std::vector<base::FileBytes> files{{folder / "summary.csv", summaryCsv(summaryRows(study, result))},
                                     {folder / "trials.csv", trialsCsv(trialRows(study, result))},
                                     {folder / "deformation.csv", deformationCsv(deformations)},
                                     {folder / "contacts.csv", contactsCsv(deformations)},
                                     {folder / "room.csv", roomCsv(deformations)},
                                     {folder / "provenance.json", provenanceJson(study, result)}};
  if (study.study.analyses.compare) {
    files.push_back({folder / "comparisons.csv", comparisonsCsv(comparisons(study, result))});
    files.push_back({folder / "pieces.csv", piecesCsv(study, result)});
    files.push_back({folder / "systems.csv", systemsCsv(study, result)});
  }
  if (study.study.analyses.convergence) {
    files.push_back({folder / "convergence.csv", convergenceCsv(study, result)});
  }
  if (result.partial) {
    for (base::FileBytes& file : files) {
      if (file.path.extension() == ".csv") {
        file.bytes = markedPartial(file.bytes);
      }
    }
  }
  base::writeFilesAtomically(files);
}

std::vector<std::string> writeAnalyses(const LoadedStudy& study, const RunResult& result, const RunOptions& options,
                                       const std::filesystem::path& folder, const base::Progress& progress) {
  std::vector<std::string> names;
  const study::Analyses& wanted = study.study.analyses;
  if (wanted.gaps) {
    names = writeGaps(study, result, options.threads, folder, progress.part(0.0, 0.1));
  }
  if (wanted.anatomy) {
    const AnatomyResult anatomy = overAnatomies(study, result, options.threads, progress.part(0.1, 0.5));
    base::writeFileAtomically(folder / "anatomy.csv", anatomyCsv(study, result, anatomy));
    names.emplace_back("anatomy.csv");
  }
  if (wanted.directions) {
    const auto directions = byDirection(study, result, options.threads, progress.part(0.5, 0.7));
    base::writeFileAtomically(folder / "directions.csv", directionsCsv(study, result, directions));
    names.emplace_back("directions.csv");
  }
  if (wanted.motion) {
    const MotionResult motion = overMotion(study, options, progress.part(0.7, 1.0));
    base::writeFilesAtomically({{folder / "motion.csv", motionCsv(study, motion)},
                                {folder / "motion_summary.csv", motionSummaryCsv(study, motion)}});
    names.insert(names.end(), {"motion.csv", "motion_summary.csv"});
  }
  return names;
}

}  // namespace lorica::analysis
