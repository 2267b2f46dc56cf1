#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "commands.h"
#include "console.h"
#include "lorica/analysis/threats.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"

namespace lorica::cli {

namespace {

std::string number(std::optional<double> value, const char* pattern = "{:.4g}") {
  return value ? fmt::format(fmt::runtime(pattern), *value) : "-";
}

std::string line(const analysis::ThreatRow& row) {
  const auto scaled = [](std::optional<double> value, double factor) {
    return value ? std::optional(*value * factor) : std::nullopt;
  };
  return fmt::format("  {:<24} {:<7} {:>10} {:>10} {:>10} {:>8} {:>10} {:>8}\n", row.structure, row.kind,
                     number(row.peak), number(scaled(row.peakTime, 1e3)), number(row.mean),
                     number(scaled(row.shareAbove, 100.0), "{:.1f}"), number(row.peakImpulse),
                     row.area > 0.0 ? fmt::format("{:.1f}", 100.0 * row.areaWithValue / row.area) : "-");
}

std::string tableOf(const std::vector<analysis::ThreatRow>& rows) {
  std::string text;
  const analysis::ThreatRow* before = nullptr;
  for (const analysis::ThreatRow& row : rows) {
    if (before == nullptr || before->threat != row.threat || before->pose != row.pose) {
      const bool pressure = threat::pascalsPer(row.attribute.unit).has_value();
      text += fmt::format("\n{}, pose {}: {}{}\n  {:<24} {:<7} {:>10} {:>10} {:>10} {:>8} {:>10} {:>8}\n", row.threat,
                          row.pose, threat::label(row.attribute),
                          row.time ? fmt::format(" at {:g} ms", 1e3 * *row.time) : "", "structure", "kind", "peak",
                          "at ms", "mean", "above %", pressure ? "Pa*s" : "impulse", "known %");
    }
    text += line(row);
    before = &row;
  }
  return text + (rows.empty()
                     ? ""
                     : "\npeak: greatest value on the surface. mean: by area, of each place's greatest. above: "
                       "share of the area on which\nthe study's threshold is exceeded. known: share of the "
                       "area where the data have a value. Nothing shields or reflects.\n");
}

}  // namespace

std::optional<analysis::SlicePlane> sliceNamed(const std::string& text) {
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '@') {
    return std::nullopt;
  }
  analysis::SlicePlane plane{text[0] - 'x', 0.0};
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), plane.metres);
  const bool read = error == std::errc() && end == text.data() + text.size() && std::abs(plane.metres) < 1e5;
  return read ? std::optional(plane) : std::nullopt;
}

int exposeToThreats(const ThreatArguments& arguments) {
  study::Study study = study::loadStudy(arguments.study);
  analysis::ThreatOptions options;
  options.poses = arguments.poses;
  options.model = *viscera::organModelNamed(arguments.model);
  options.models = arguments.models;
  options.levels = arguments.levels;
  options.threads = {arguments.threads};
  if (arguments.timeMs) {
    options.time = *arguments.timeMs / 1000.0;
  }
  if (arguments.spacingMm) {
    options.spacing = *arguments.spacingMm / 1000.0;
  }
  for (const std::string& slice : arguments.slices) {
    options.slices.push_back(*sliceNamed(slice));
  }
  study.models = {options.model};
  base::requireWritableFolder(arguments.out);
  analysis::ThreatResult result;
  {
    Stage stage("reading " + arguments.study.filename().string(), arguments.quiet);
    const analysis::LoadedStudy loaded =
        analysis::load(std::move(study), arguments.study, options.threads, stage.progress().part(0.0, 0.5));
    result = analysis::threatAnalysis(loaded, options, stage.progress().part(0.5, 1.0));
  }
  const std::vector<std::string> names = analysis::writeThreats(result, arguments.out);
  printIssues(result.issues, false);
  if (!arguments.quiet) {
    fmt::print("{}", tableOf(result.rows));
    if (!result.crossings.empty()) {
      fmt::print("\n{} crossings of structures by fragments\n", result.crossings.size());
    }
    fmt::print("{}\n", names.empty() ? "no fragment crosses anything, and there are no values: nothing was written"
                                     : fmt::format("{} in {}", fmt::join(names, ", "), arguments.out.string()));
  }
  return done;
}

}  // namespace lorica::cli
