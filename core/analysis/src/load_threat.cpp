#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lorica/analysis/threats.h"
#include "lorica/base/error.h"
#include "lorica/base/readable.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/study_file.h"
#include "lorica/threat/blast.h"

namespace lorica::analysis {

namespace {

using base::Severity;
using geometry::Box3d;
using geometry::Vec3d;

geometry::Quatd turned(const Vec3d& degrees) {
  return geometry::Quatd(Eigen::AngleAxisd(base::radians(degrees.z()), Vec3d::UnitZ()) *
                         Eigen::AngleAxisd(base::radians(degrees.y()), Vec3d::UnitY()) *
                         Eigen::AngleAxisd(base::radians(degrees.x()), Vec3d::UnitX()));
}

threat::ReadField readData(const LoadedStudy& study, const study::Threat& wanted, const Box3d& around,
                           base::Threads threads, const base::Progress& progress) {
  threat::ReadField read;
  if (const auto* charge = std::get_if<study::BlastCharge>(&wanted.from)) {
    threat::BlastOptions options;
    options.tntKilograms = charge->tntKilograms;
    options.position = charge->position;
    options.box = around;
    read.field = threat::blastField(options, threads);
    return read;
  }
  const auto& input = std::get<study::InputFile>(wanted.from);
  threat::ReadOptions options;
  options.units = input.units;
  options.timeUnits = wanted.timeUnits;
  options.up = input.up.value_or('y');
  if (!wanted.attribute.empty()) {
    options.attributes = {wanted.attribute};
  }
  read = threat::readThreat(study::resolve(input, study.file), options, progress);
  const geometry::RigidTransform placed{turned(wanted.turn), wanted.offset};
  if (!placed.isIdentity()) {
    read.field.placement = placed * read.field.placement;
  }
  return read;
}

std::string sizeOf(const threat::ThreatField& field) {
  const std::string points = base::readableCount(field.points(0));
  if (field.lattice) {
    const auto& axes = field.lattice->axes;
    return fmt::format("a lattice of {} x {} x {} points", axes[0].size(), axes[1].size(), axes[2].size());
  }
  return fmt::format("{} scattered points{}", points, field.steps.size() > 1 ? " at the first time" : "");
}

std::string timesOf(const threat::ThreatField& field) {
  return field.timed ? fmt::format("{} time(s) from {:g} to {:g} ms", field.steps.size(),
                                   1e3 * field.steps.front().time, 1e3 * field.steps.back().time)
                     : "no times";
}

base::Issue rangeOf(const threat::ThreatField& field, std::size_t attribute, const std::string& file) {
  const threat::Attribute& about = field.attributes[attribute];
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  std::size_t missing = 0;
  for (const threat::Step& step : field.steps) {
    const std::vector<float>& values = step.values[attribute];
    for (std::size_t p = 0; p < values.size(); p += about.components) {
      const float value =
          about.components == 1 ? values[p] : geometry::Vec3f(values[p], values[p + 1], values[p + 2]).norm();
      missing += std::isnan(value) ? 1 : 0;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return {Severity::note, file, about.name,
          fmt::format("{}from {:g} to {:g}{}{}", about.components == 3 ? "vectors of length " : "", low, high,
                      about.unit.empty() ? "" : " " + about.unit,
                      missing > 0 ? fmt::format("; {} value(s) are missing", missing) : "")};
}

base::Issues describe(const threat::ThreatField& field, const std::string& file, const std::string& place) {
  const Box3d box = field.bounds();
  base::Issues issues{{Severity::note, file, place,
                       fmt::format("{}, {}, x {:.3f} to {:.3f}, y {:.3f} to {:.3f}, z {:.3f} to {:.3f} m",
                                   sizeOf(field), timesOf(field), box.min().x(), box.max().x(), box.min().y(),
                                   box.max().y(), box.min().z(), box.max().z())}};
  for (std::size_t a = 0; a < field.attributes.size(); ++a) {
    issues.push_back(rangeOf(field, a, file));
  }
  return issues;
}

}  // namespace

LoadedThreat loadThreat(const LoadedStudy& study, std::size_t index, const Box3d& around, base::Threads threads,
                        const base::Progress& progress) {
  LORICA_CHECK(index < study.study.threats.size() && !around.isEmpty(), "a threat of the study and a place for it");
  const study::Threat& wanted = study.study.threats[index];
  threat::ReadField read = readData(study, wanted, around, threads, progress);
  for (threat::Step& step : read.field.steps) {
    step.time += wanted.timeOffset;
  }
  LoadedThreat loaded;
  loaded.name = wanted.name;
  loaded.issues = std::move(read.issues);
  if (!read.field.attributes.empty()) {
    loaded.attribute = 0;
  } else if (read.field.steps.front().ids.empty()) {
    throw base::InputError(study.file.string(), fmt::format("/threats/{}", index),
                           "the data have neither values nor ids of fragments; add a column");
  }
  loaded.field = std::make_shared<const threat::ThreatField>(std::move(read.field));
  return loaded;
}

base::Issues checkThreatFile(const std::filesystem::path& path, const base::Progress& progress) {
  threat::ReadField read = threat::readThreat(path, {}, progress);
  base::Issues issues = std::move(read.issues);
  base::append(issues, describe(read.field, path.string(), ""));
  return issues;
}

base::Issues checkThreats(const LoadedStudy& study, base::Threads threads, const base::Progress& progress) {
  base::Issues issues;
  const Box3d body = geometry::bounds(study.body->body().skin.positions);
  for (std::size_t t = 0; t < study.study.threats.size(); ++t) {
    try {
      LoadedThreat loaded = loadThreat(study, t, body, threads, progress);
      base::append(issues, std::move(loaded.issues));
      base::append(issues, describe(*loaded.field, study.file.string(), loaded.name));
      const Box3d box = loaded.field->bounds();
      if (!box.intersects(body)) {
        issues.push_back({Severity::warning, study.file.string(), fmt::format("/threats/{}", t),
                          fmt::format("\"{}\" lies {:.2f} m beside the body at rest; check its units, up axis and "
                                      "offset",
                                      loaded.name, box.exteriorDistance(body))});
      }
    } catch (const base::InputError& error) {
      issues.push_back({Severity::error, error.file(), error.place(), error.text()});
    }
  }
  return issues;
}

}  // namespace lorica::analysis
