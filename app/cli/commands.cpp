#include "commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench.h"
#include "console.h"
#include "lorica/analysis/check.h"
#include "lorica/analysis/compare_runs.h"
#include "lorica/analysis/export_pose.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/readable.h"
#include "lorica/study/provenance.h"
#include "lorica/study/study_file.h"

namespace lorica::cli {

namespace fs = std::filesystem;

int checkFiles(const std::vector<fs::path>& files, bool acceptInputs) {
  bool sound = true;
  for (const fs::path& file : files) {
    if (acceptInputs && file.extension() == ".json") {
      const study::Study study = study::loadStudy(file);
      study::saveStudy(study::withCurrentHashes(study, file), file);
    }
    Stage stage("checking " + file.filename().string(), false);
    for (const base::Issue& issue : analysis::checkFile(file, {}, stage.progress())) {
      sound = sound && issue.severity != base::Severity::error;
      fmt::print("{}\n", issue.line());
    }
  }
  return sound ? done : badInput;
}

int printTemplate(const std::string& name, bool list) {
  const std::vector<std::string> names = study::templateNames();
  if (!list && std::find(names.begin(), names.end(), name) == names.end()) {
    fmt::print(stderr, "lorica-cli: there is no template named \"{}\"; there are {}\n", name, fmt::join(names, ", "));
    return wrongUsage;
  }
  if (!list) {
    fmt::print("{}", study::templateText(name));
    return done;
  }
  for (const std::string& known : names) {
    fmt::print("{}\n", known);
  }
  return done;
}

namespace {

/// The file to be written must not be one that is read.
void refuseToOverwrite(const fs::path& out, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    if (fs::equivalent(out, input, ignored)) {
      throw base::InputError(out.string(), "", "is read here, so it cannot be written too; give --out another name");
    }
  }
}

}  // namespace

int importFiles(const analysis::ImportRequest& request) {
  std::vector<fs::path> inputs = request.organs;
  inputs.push_back(request.skin);
  for (const analysis::ArmorRequest& armor : request.armor) {
    if (const auto* file = std::get_if<fs::path>(&armor.from)) {
      inputs.push_back(*file);
    }
  }
  refuseToOverwrite(request.studyFile, inputs);
  analysis::ImportedStudy imported;
  {
    Stage stage("importing", false);
    imported = analysis::importStudy(request, {}, stage.progress());
  }
  study::saveStudy(imported.study, request.studyFile);
  for (const base::Issue& issue : imported.issues) {
    fmt::print("{}\n", issue.line());
  }
  fmt::print("{}: a body, {} organ(s), {} armor system(s); run it with\n  lorica-cli run {} --out out\n",
             request.studyFile.string(), imported.study.organs.size(), imported.study.systems.size(),
             request.studyFile.string());
  return done;
}

int exportPose(const ExportArguments& arguments) {
  const io::SceneFormat format = arguments.format == "glb"   ? io::SceneFormat::glb
                                 : arguments.format == "ply" ? io::SceneFormat::ply
                                                             : io::SceneFormat::vtp;
  study::Study study = study::loadStudy(arguments.study);
  std::vector<fs::path> inputs{arguments.study};
  for (const study::InputFile& input : study::inputFiles(study)) {
    inputs.push_back(study::resolve(input, arguments.study));
  }
  refuseToOverwrite(arguments.out, inputs);
  const viscera::OrganModel model = *viscera::organModelNamed(arguments.model);
  study.models = {model};
  Stage stage("exporting", false);
  const analysis::LoadedStudy loaded = analysis::load(std::move(study), arguments.study, {}, stage.progress());
  const std::string bytes = analysis::exportPose(loaded, arguments.pose, model, format, {});
  stage.progress().check();
  base::writeFileAtomically(arguments.out, bytes);
  return done;
}

int compareRuns(const fs::path& first, const fs::path& second, const fs::path& out) {
  const std::vector<fs::path> inputs{first / "trials.csv", first / "provenance.json", second / "trials.csv",
                                     second / "provenance.json"};
  refuseToOverwrite(out, inputs);
  const analysis::RunComparisons compared = analysis::compareRuns(first, second);
  base::writeFileAtomically(out, analysis::runComparisonsCsv(compared));
  for (const auto& [partial, run] : {std::pair(compared.partialFirst, first), {compared.partialSecond, second}}) {
    if (partial) {
      fmt::print(stderr, "{}: the run was cut short; what it finished is compared\n", run.string());
    }
  }
  const auto apart = std::count_if(compared.rows.begin(), compared.rows.end(),
                                   [](const auto& row) { return row.pHolm && *row.pHolm < 0.05; });
  fmt::print("{}: {} comparisons by {}; {} differ at 5 % after Holm; {} structures are in one run only\n", out.string(),
             compared.rows.size(),
             compared.paired ? "the paired t of trials on the same shots (both runs have the same seed)"
                             : "Welch's t of independent runs",
             apart, compared.unmatched);
  return done;
}

int upgradeStudy(const fs::path& file, const fs::path& out) {
  const study::Study study = study::loadStudy(file);
  study::saveStudy(study, out.empty() ? file : out);
  return done;
}

int runBenchmarks(const fs::path& json) {
  bench::Report report;
  {
    Stage stage("measuring", false);
    report = bench::measure(stage.progress());
  }
  nlohmann::ordered_json document;
  for (const bench::Ratio& ratio : report.ratios) {
    document["ratios"][ratio.name] = ratio.value;
    const std::string bar = ratio.bar ? fmt::format("bar {} {}", ratio.atLeast ? ">=" : "<=", *ratio.bar) : "";
    fmt::print("{:<28} {:>8.3f}   {:<12}  {}\n", ratio.name, ratio.value, bar, ratio.meaning);
  }
  document["scene"] = {{"triangles", report.triangles}, {"rays", report.rays}};
  document["threads"] = report.threads;
  document["lorica_version"] = study::version();
  for (const auto& [name, value] : report.rates) {
    fmt::print("{:<40} {:>14.1f}\n", name, value);
    document["rates"][name] = value;
  }
  for (const std::string& note : report.notes) {
    fmt::print("{}\n", note);
  }
  fmt::print("scene of {} triangles, {} rays, {} threads; each ratio is the median of interleaved runs\n",
             base::readableCount(report.triangles), base::readableCount(report.rays), report.threads);
  if (!json.empty()) {
    base::writeFileAtomically(json, document.dump(2) + "\n");
  }
  return done;
}

}  // namespace lorica::cli
