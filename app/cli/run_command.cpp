#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "commands.h"
#include "console.h"
#include "deformation_table.h"
#include "lorica/analysis/results.h"
#include "lorica/analysis/shot_report.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/readable.h"
#include "lorica/study/study_file.h"
#include "report_command.h"
#include "summary_table.h"

namespace lorica::cli {

namespace {

analysis::LoadedStudy loadForRun(const RunArguments& arguments) {
  study::Study study = study::loadStudy(arguments.study);
  if (!arguments.models.empty()) {
    study.models.clear();
    for (const std::string& name : arguments.models) {
      const viscera::OrganModel model = *viscera::organModelNamed(name);
      if (std::find(study.models.begin(), study.models.end(), model) == study.models.end()) {
        study.models.push_back(model);
      }
    }
  }
  Stage stage("reading " + arguments.study.filename().string(), arguments.quiet);
  return analysis::load(std::move(study), arguments.study, {arguments.threads}, stage.progress());
}

/// What the shots of a source fill.
std::string sizeOf(const analysis::ShotSource& source) {
  const std::string shots = base::readableCount(source.shots) + " shots a trial";
  switch (source.measure.basis) {
    case shotline::Basis::solidAngle:
      return fmt::format("{} over {:.6f} sr", shots, source.measure.total);
    case shotline::Basis::area:
      return fmt::format("{} over {:.4f} m2 across them", shots, source.measure.total);
    case shotline::Basis::shots:
      break;
  }
  const auto* point = std::get_if<shotline::PointSource>(&source.source.shape);
  return shots + (point != nullptr ? ", Eq 15, without a solid angle" : ", as listed");
}

void sayWhatWasShot(const analysis::RunResult& result) {
  raycast::CastCounts counts;
  for (const analysis::SourcePoseResult& here : result.results) {
    counts.add(here.counts);
  }
  for (const analysis::ShotSource& source : result.sources) {
    fmt::print("source {}: {}\n", source.source.name, sizeOf(source));
  }
  fmt::print("{} rays; {} traced again, {} unresolved, {} near an open edge\n", base::readableCount(counts.rays),
             base::readableCount(counts.retraced), base::readableCount(counts.unresolved),
             base::readableCount(counts.nearOpenEdge));
}

/// Notes are many and rarely urgent: they stand in provenance.json.
void sayHowManyNotes(const base::Issues& issues) {
  const auto notes = std::count_if(issues.begin(), issues.end(),
                                   [](const base::Issue& issue) { return issue.severity == base::Severity::note; });
  if (notes > 0) {
    fmt::print(stderr, "{} note(s) about the inputs, such as organs that do not close: see issues in provenance.json\n",
               notes);
  }
}

}  // namespace

int runStudy(const RunArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  if (arguments.pdf) {
    requireReports();
  }
  const analysis::LoadedStudy study = loadForRun(arguments);
  if (study.study.sources.empty()) {
    throw base::InputError(arguments.study.string(), "/sources", "the study has no source to shoot from; add one");
  }
  for (const std::string& pose : arguments.poses) {
    analysis::resolvePose(study, pose);
  }
  analysis::RunOptions options;
  options.poses = arguments.poses;
  options.seed = arguments.seed;
  options.trials = arguments.trials;
  options.shots = arguments.shots;
  options.threads = {arguments.threads};
  if (!arguments.shotReport.empty()) {
    const analysis::ShotName shot = analysis::shotNamed(arguments.shotReport);
    fmt::print("{}", analysis::shotReport(study, analysis::planRun(study, options), shot, options.threads));
    return done;
  }
  base::requireWritableFolder(arguments.out);
  analysis::RunResult result;
  {
    Stage stage("shooting", arguments.quiet);
    result = analysis::run(study, options, stage.progress());
  }
  analysis::writeResults(study, result, arguments.out);
  const study::Analyses& wanted = study.study.analyses;
  if ((wanted.directions || wanted.motion || wanted.gaps || wanted.anatomy) && !result.partial) {
    Stage stage("analyses", arguments.quiet);
    analysis::writeAnalyses(study, result, options, arguments.out, stage.progress());
  }
  if (!arguments.hits.empty() && !result.partial) {
    Stage stage("writing every shot", arguments.quiet);
    analysis::writeHits(study, result, arguments.hits == "csv" ? analysis::HitFormat::csv : analysis::HitFormat::vtp,
                        arguments.out, options.threads, stage.progress());
  }
  const bool reported = arguments.pdf && !result.partial;
  if (reported) {
    try {
      writeRunReport(study, result, arguments.out, options.threads, arguments.quiet);
    } catch (const base::Cancelled&) {
      fmt::print(stderr, "cancelled: the tables in {} are whole, the report was not made\n", arguments.out.string());
      return cancelled;
    }
  }
  printIssues(result.issues, false);
  if (!arguments.quiet) {
    sayHowManyNotes(result.issues);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{}\n", summaryTable(result, analysis::summaryRows(study, result)));
    fmt::print("{}\n", deformationTable(analysis::deformationTables(study, result)));
    sayWhatWasShot(result);
    fmt::print(
        "{} in {:.1f} s; {}summary.csv, trials.csv, deformation.csv, contacts.csv, room.csv and provenance.json are in "
        "{}\n",
        result.partial ? "stopped" : "finished", seconds, reported ? "report.pdf, " : "", arguments.out.string());
  }
  if (result.partial) {
    fmt::print(stderr, "cancelled: the result in {} is partial\n", arguments.out.string());
    return cancelled;
  }
  return done;
}

}  // namespace lorica::cli
