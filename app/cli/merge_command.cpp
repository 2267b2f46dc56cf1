#include <fmt/format.h>

#include <algorithm>

#include "console.h"
#include "lorica/analysis/run.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "part_file.h"
#include "run_steps.h"

namespace lorica::cli {

namespace {

/// The parts in their order. \throw base::InputError unless they are all parts of one run, each of them once
std::vector<PartFile> readParts(const std::vector<std::filesystem::path>& folders) {
  std::vector<PartFile> parts;
  for (const std::filesystem::path& folder : folders) {
    parts.emplace_back(folder);
    const PartFile& first = parts.front();
    const PartFile& part = parts.back();
    part.requireSameRun(first.planText(), first.file());
    if (part.part().count != first.part().count) {
      throw base::InputError(part.file(), "/of",
                             fmt::format("is one of {} parts, but {} is one of {}; give the parts of one run",
                                         part.part().count, first.file(), first.part().count));
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const PartFile& a, const PartFile& b) { return a.part().index < b.part().index; });
  for (std::size_t p = 1; p < parts.size(); ++p) {
    if (parts[p].part() == parts[p - 1].part()) {
      throw base::InputError(parts[p].file(), "/part",
                             fmt::format("is part {} of {}, and so is {}; give each part once",
                                         parts[p].part().index + 1, parts[p].part().count, parts[p - 1].file()));
    }
  }
  for (std::uint32_t p = 0; p < parts.front().part().count; ++p) {
    if (p >= parts.size() || parts[p].part().index != p) {
      throw base::InputError(parts.front().file(), "/of",
                             fmt::format("there are {} parts, and part {} is missing; give its folder too",
                                         parts.front().part().count, p + 1));
    }
  }
  return parts;
}

}  // namespace

int mergeParts(const MergeArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<PartFile> parts = readParts(arguments.parts);
  RunArguments run = parts.front().arguments();
  run.study = arguments.study.empty() ? run.study : arguments.study;
  run.out = arguments.out;
  run.threads = arguments.threads;
  run.quiet = arguments.quiet;
  const analysis::LoadedStudy study = loadForRun(run);
  base::NewFolders folders;
  folders.willMake(run.out);
  base::requireWritableFolder(run.out);

  analysis::RunOptions options = runOptions(run);
  options.shoot = false;
  analysis::RunResult planned;
  {
    Stage stage("planning", run.quiet);
    planned = analysis::planRun(study, options, stage.progress());
    stage.progress().check();
  }
  parts.front().requireSameRun(planText(study, planned), "that of " + run.study.string() + " as it is now");
  std::vector<analysis::RunResult> results;
  for (const PartFile& part : parts) {
    results.push_back(part.counted(study, planned));
  }
  analysis::RunResult whole = analysis::merge(results);
  {
    Stage stage("measuring the deformation", run.quiet);
    analysis::RunResult audited = analysis::run(study, options, stage.progress());
    stage.progress().check();
    whole.deformations = std::move(audited.deformations);
    whole.rooms = std::move(audited.rooms);
    whole.restRoom = audited.restRoom;
    whole.issues = std::move(audited.issues);
  }
  return writeRun(run, study, std::move(whole), start);
}

}  // namespace lorica::cli
