#include "lorica/commands/shot_edits.h"

#include <cmath>
#include <set>

#include "find.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"

namespace lorica::commands {

using document::Change;
using study::Sampler;
using study::Sequence;
using study::SourceType;

namespace {

constexpr double farthest = 99000.0;  // metres that a study file holds, and some room
constexpr std::uint64_t mostShots = 1'000'000'000'000ULL;

geometry::Vec3d within(const geometry::Vec3d& position) {
  LORICA_CHECK(position.allFinite(), "positions are finite numbers");
  return position.cwiseMax(-farthest).cwiseMin(farthest);
}

bool isSize(double metres) {
  return metres > 0.0 && metres <= 1000.0;
}

bool usesGrid(const study::Source& source) {
  return source.type == SourceType::parallel && source.sequence == Sequence::grid;
}

void checkRange(const study::DegreeRange& range, double least, double most, const QString& field, const QString& angle,
                std::vector<FieldTrouble>& troubles) {
  if (!(range.from >= least && range.to <= most)) {
    troubles.push_back({field, Text::tr("%1 goes from %2 to %3 degrees.").arg(angle).arg(least).arg(most)});
  } else if (!(range.from < range.to)) {
    troubles.push_back({field, Text::tr("The band is empty: the second angle must be the larger one.")});
  } else if (range.to - range.from > 360.0) {
    troubles.push_back({field, Text::tr("The band is more than a full turn: at most 360 degrees.")});
  }
}

void checkPoint(const study::Source& source, std::vector<FieldTrouble>& troubles) {
  const QString size = Text::tr("A size is above 0 and at most 1000 m.");
  if (source.sampler == Sampler::rectangle && !isSize(source.width)) {
    troubles.push_back({"width", size});
  }
  if (source.sampler == Sampler::rectangle && !isSize(source.height)) {
    troubles.push_back({"height", size});
  }
  if (source.sampler == Sampler::disk && !isSize(source.radius)) {
    troubles.push_back({"radius", size});
  }
}

/// A property that is a member of the study.
template <class Value>
Property<Value> ofRun(const QString& id, Value study::Study::*member) {
  return {id, Change::run, [member](const study::Study& study) { return study.*member; },
          [member](study::Study& study, const Value& value) { study.*member = value; }};
}

}  // namespace

// --- sources --------------------------------------------------------------------------------------------------------

study::Source asWritten(study::Source source) {
  const study::Source fresh;
  const bool point = source.type == SourceType::point;
  const bool list = source.type == SourceType::list;
  source.position = point ? within(source.position) : fresh.position;
  source.sampler = point ? source.sampler : fresh.sampler;
  const bool rectangle = point && source.sampler == Sampler::rectangle;
  source.width = rectangle ? source.width : fresh.width;
  source.height = rectangle ? source.height : fresh.height;
  source.radius = point && source.sampler == Sampler::disk ? source.radius : fresh.radius;
  if (source.type == SourceType::parallel) {
    source.azimuth.to = 0.0;
    source.elevation.to = 0.0;
  } else if (source.type != SourceType::band) {
    source.azimuth = fresh.azimuth;
    source.elevation = fresh.elevation;
  }
  if (list || !source.targetStructure.empty()) {
    source.target.reset();
  } else if (source.target) {
    source.target = within(*source.target);
  }
  source.targetStructure = list ? std::string() : source.targetStructure;
  if (list || (point && source.sampler == Sampler::thesis) ||
      (source.sequence == Sequence::grid && source.type != SourceType::parallel)) {
    source.sequence = Sequence::random;
  }
  // A file has millimetres.
  source.cell = usesGrid(source) ? source.cell * 1000.0 / 1000.0 : fresh.cell;
  source.shots = usesGrid(source) || list ? fresh.shots : source.shots;
  source.list = list ? study::InputFile{source.list.path, source.list.sha256, {}, {}} : fresh.list;
  return source;
}

std::vector<FieldTrouble> sourceTroubles(const study::Source& source) {
  std::vector<FieldTrouble> troubles;
  switch (source.type) {
    case SourceType::point:
      checkPoint(source, troubles);
      break;
    case SourceType::parallel:
      if (std::abs(source.azimuth.from) > 360.0) {
        troubles.push_back({"azimuth", Text::tr("An azimuth goes from -360 to 360 degrees.")});
      }
      if (std::abs(source.elevation.from) > 90.0) {
        troubles.push_back({"elevation", Text::tr("An elevation goes from -90 to 90 degrees.")});
      }
      break;
    case SourceType::band:
      checkRange(source.azimuth, -360.0, 360.0, "azimuth", Text::tr("An azimuth"), troubles);
      checkRange(source.elevation, -90.0, 90.0, "elevation", Text::tr("An elevation"), troubles);
      break;
    case SourceType::sphere:
      break;
    case SourceType::list:
      if (!isName(source.list.path)) {
        troubles.push_back({"file", Text::tr("Choose the CSV file that holds the shots.")});
      }
      break;
  }
  if (usesGrid(source) && !(source.cell >= 1e-5 && source.cell <= 10.0)) {
    troubles.push_back({"cell", Text::tr("A cell of the grid is 0.01 to 10000 mm wide.")});
  }
  if (source.shots < 1 || source.shots > mostShots) {
    troubles.push_back({"shots", Text::tr("A trial has 1 to 1,000,000,000,000 shots.")});
  }
  return troubles;
}

void setSource(StudyDocument& document, const std::string& name, const study::Source& source, const QString& field,
               const QString& text, Merge merge) {
  study::Source wanted = asWritten(source);
  wanted.name = name;
  LORICA_CHECK(sourceTroubles(wanted).empty(), "a study can hold the source");
  change(document,
         Property<study::Source>{
             field + '/' + shown(name), Change::sources,
             [name](const study::Study& study) { return named(study.sources, name); },
             [name](study::Study& study, const study::Source& value) { named(study.sources, name) = value; }},
         std::move(wanted), text, merge);
}

study::Source asType(study::Source source, SourceType type) {
  source.type = type;
  switch (type) {
    case SourceType::point:
      if (source.position.isZero()) {
        source.position = {0.0, 1.0, 5.0};
      }
      break;
    case SourceType::band:
      // Threats on the ground, all around.
      source.azimuth = {0.0, 360.0};
      source.elevation = {-15.0, 15.0};
      break;
    case SourceType::parallel:
    case SourceType::sphere:
    case SourceType::list:
      break;
  }
  return source;
}

std::string duplicateSource(StudyDocument& document, const std::string& name) {
  study::Study after = document.study();
  study::Source copy = named(after.sources, name);
  for (int number = 2; hasNamed(after.sources, copy.name); ++number) {
    copy.name = Text::tr("%1 %2").arg(shown(name)).arg(number).toStdString();
  }
  const auto original = std::find_if(after.sources.begin(), after.sources.end(),
                                     [&](const study::Source& source) { return source.name == name; });
  const std::string made = copy.name;
  after.sources.insert(std::next(original), std::move(copy));
  document.undoStack().push(
      new ReplaceStudy(document, std::move(after), Change::sources, Text::tr("Duplicate source %1").arg(shown(name))));
  document.select(ItemRef{document::ItemKind::source, made});
  return made;
}

study::InputFile shotListInput(const StudyDocument& document, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  const fs::path absolute = fs::absolute(file).lexically_normal();
  shotline::readShotList(base::readFile(absolute), absolute.string());
  study::InputFile input;
  const fs::path relative = absolute.lexically_relative(fs::absolute(document.file()).lexically_normal().parent_path());
  input.path = (relative.empty() ? absolute : relative).generic_string();
  input.sha256 = study::sha256OfInput(absolute);
  return input;
}

// --- runs -----------------------------------------------------------------------------------------------------------

std::vector<FieldTrouble> stopTroubles(const study::StopRule& stop) {
  std::vector<FieldTrouble> troubles;
  const std::set<std::string> once(stop.structures.begin(), stop.structures.end());
  if (stop.structures.empty() || once.size() != stop.structures.size()) {
    troubles.push_back({"stop_structures", Text::tr("Choose at least one organ whose interval is to be narrow.")});
  }
  if (!(stop.halfWidth > 0.0 && stop.halfWidth <= 0.5)) {
    troubles.push_back({"half_width", Text::tr("Half the width of an interval is above 0 and at most 50 %.")});
  }
  if (stop.maxTrials < 1 || stop.maxTrials > 100000) {
    troubles.push_back({"max_trials", Text::tr("A run has 1 to 100,000 trials.")});
  }
  return troubles;
}

void setStop(StudyDocument& document, const std::optional<study::StopRule>& stop) {
  LORICA_CHECK(!stop || stopTroubles(*stop).empty(), "a study can hold the rule");
  change(document, ofRun("stop", &study::Study::stop), stop, Text::tr("When trials are enough"));
}

void setOverlap(StudyDocument& document, const study::Overlap& overlap) {
  study::Overlap wanted = overlap;
  if (wanted.policy != shotline::OverlapPolicy::priority) {
    wanted.order.clear();
  }
  const std::set<std::string> once(wanted.order.begin(), wanted.order.end());
  LORICA_CHECK(once.size() == wanted.order.size() && std::all_of(once.begin(), once.end(), isName),
               "each structure stands in the order once");
  change(document, ofRun("overlap", &study::Study::overlap), std::move(wanted), Text::tr("Overlap of structures"));
}

std::vector<FieldTrouble> analysesTroubles(const study::Analyses& analyses) {
  std::vector<FieldTrouble> troubles;
  if (analyses.directions) {
    const double step = analyses.directions->step;
    if (!(step >= 1.0 && step <= 90.0 && std::floor(step) == step && std::fmod(180.0, step) == 0.0)) {
      troubles.push_back({"direction_step", Text::tr("A step is a whole number of degrees that divides 180.")});
    }
    if (analyses.directions->shots < 1 || analyses.directions->shots > 1'000'000'000ULL) {
      troubles.push_back({"direction_shots", Text::tr("A beam has 1 to 1,000,000,000 shots.")});
    }
  }
  if (analyses.motion) {
    if (!isName(analyses.motion->clip)) {
      troubles.push_back({"motion_clip", Text::tr("Choose the motion.")});
    }
    if (analyses.motion->every < 1 || analyses.motion->every > 10000) {
      troubles.push_back({"motion_every", Text::tr("Every 1st to 10,000th frame can be taken.")});
    }
    if (!(analyses.motion->framesPerSecond > 0.0 && analyses.motion->framesPerSecond <= 1000.0)) {
      troubles.push_back({"motion_rate", Text::tr("A second has more than 0 and at most 1000 frames.")});
    }
  }
  if (const auto& gaps = analyses.gaps) {
    if (gaps->structures.empty()) {
      troubles.push_back({"gap_structures", Text::tr("Gaps are looked for before one structure at least.")});
    }
    if (!(gaps->openShare >= 0.0 && gaps->openShare <= 0.95)) {
      troubles.push_back({"gap_share", Text::tr("A share is from 0 to 95 %.")});
    }
    if (gaps->minShots < 1 || gaps->minShots > 1'000'000) {
      troubles.push_back({"gap_shots", Text::tr("A place needs 1 to 1,000,000 shots.")});
    }
    if (!(gaps->radius >= 0.0 && gaps->radius <= 1.0)) {
      troubles.push_back({"gap_radius", Text::tr("A radius is from 0 to 1000 mm.")});
    }
  }
  if (const auto& anatomy = analyses.anatomy) {
    if (anatomy->draws < 2 || anatomy->draws > 100'000) {
      troubles.push_back({"anatomy_draws", Text::tr("Organs are moved 2 to 100,000 times.")});
    }
    if (!(anatomy->scale >= 0.0 && anatomy->scale <= 10.0)) {
      troubles.push_back({"anatomy_scale", Text::tr("A factor is from 0 to 10.")});
    }
  }
  return troubles;
}

void setAnalyses(StudyDocument& document, const study::Analyses& analyses) {
  LORICA_CHECK(analysesTroubles(analyses).empty(), "a study can hold the analyses");
  change(document, ofRun("analyses", &study::Study::analyses), analyses, Text::tr("Analyses of a run"));
}

}  // namespace lorica::commands
