#include "lorica/study/provenance.h"

#include <nlohmann/json.hpp>

#include "json_text.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/units.h"
#include "lorica/study/study_file.h"
#include "study_words.h"

namespace lorica::study {

namespace {

Json vector(const geometry::Vec3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

/// What each shape was made of.
struct ShapeJson {
  Json& json;

  void operator()(const shotline::PointSource& point) const {
    json["type"] = "point";
    json["position_m"] = vector(point.position);
    json["target_m"] = vector(point.target);
    json["sampler"] = wordFor(point.sampler, samplerWords);
    if (point.sampler == Sampler::cone || point.sampler == Sampler::disk) {
      json["half_angle_deg"] = base::degrees(point.halfAngle);
    }
    if (point.sampler == Sampler::rectangle) {
      json["width_m"] = point.width;
      json["height_m"] = point.height;
    }
  }
  void operator()(const shotline::ParallelBeam& beam) const {
    json["type"] = "parallel";
    json["azimuth_deg"] = base::degrees(beam.azimuth);
    json["elevation_deg"] = base::degrees(beam.elevation);
    json["centre_m"] = vector(beam.centre);
    json["radius_m"] = beam.radius;
  }
  void operator()(const shotline::DirectionBand& band) const {
    json["type"] = "band";
    json["azimuth_deg"] = Json::array({base::degrees(band.azimuth.from), base::degrees(band.azimuth.to)});
    json["elevation_deg"] = Json::array({base::degrees(band.elevation.from), base::degrees(band.elevation.to)});
    json["centre_m"] = vector(band.centre);
    json["radius_m"] = band.radius;
  }
  void operator()(const shotline::ShotList& /*list*/) const { json["type"] = "list"; }
};

Json sourceJson(const Provenance::SourceRecord& record) {
  Json json{{"name", record.source.name}};
  std::visit(ShapeJson{json}, record.source.shape);
  json["sequence"] = wordFor(record.source.sequence, sequenceWords);
  json["shots_per_trial"] = record.shots;
  json["interval"] = !shotline::isDrawn(record.source)           ? "none: the shots were chosen, not drawn"
                     : shotline::independentShots(record.source) ? "Wilson, 95 %"
                                                                 : "Student t across the trials, jackknife, 95 %";
  switch (record.measure.basis) {
    case shotline::Basis::solidAngle:
      json["solid_angle_sr"] = record.measure.total;
      json["percentages_are_of"] = "the solid angle of the shots";
      break;
    case shotline::Basis::area:
      json["area_m2"] = record.measure.total;
      json["percentages_are_of"] = "the area across the shots, a mean over their directions";
      break;
    case shotline::Basis::shots:
      json["percentages_are_of"] = "shots, which have no solid angle and no area";
      break;
  }
  return json;
}

}  // namespace

std::string version() {
  return LORICA_VERSION;
}

std::string provenanceText(const Provenance& provenance) {
  Json json;
  json["lorica_version"] = version();
  json["partial"] = provenance.partial;
  json["purpose"] = "coverage of the body by armor; nothing here says what a hit does";
  json["study"] = {{"name", provenance.study.name},
                   {"description", provenance.study.description},
                   {"sha256", sha256(studyText(provenance.study))}};
  json["inputs"] = Json::array();
  for (const InputFile& input : provenance.inputs) {
    json["inputs"].push_back({{"file", input.path}, {"sha256", input.sha256}});
  }
  json["seed"] = provenance.seed;
  json["trials"] = provenance.trials;
  if (const std::optional<StopRule>& stop = provenance.study.stop) {
    json["stop"] = {{"structures", stop->structures}, {"half_width", stop->halfWidth}, {"max_trials", stop->maxTrials}};
  }
  json["models"] = provenance.models;
  json["systems"] = provenance.systems;
  json["poses"] = provenance.poses;
  json["azimuth_and_elevation"] = azimuthConvention;
  json["sources"] = Json::array();
  for (const Provenance::SourceRecord& source : provenance.sources) {
    json["sources"].push_back(sourceJson(source));
  }
  json["skinning"] = wordFor(provenance.study.skinning, skinningWords);
  json["deformer"] = wordFor(provenance.study.deformer, deformerWords);
  json["interior_sites"] = provenance.interiorSites;
  json["collapsed_sites"] = provenance.collapsedSites;
  json["runs"] = Json::array();
  for (const Provenance::RunRecord& run : provenance.runs) {
    json["runs"].push_back({{"source", run.source},
                            {"pose", run.pose},
                            {"trials_finished", run.trials},
                            {"shots", run.rays},
                            {"retraced", run.retraced},
                            {"unresolved", run.unresolved},
                            {"near_open_edge", run.nearOpenEdge}});
    if (run.goalReached) {
      json["runs"].back()["stop_goal_reached"] = *run.goalReached;
    }
  }
  json["tables"] = provenance.tables;
  json["issues"] = Json::array();
  for (const base::Issue& issue : provenance.issues) {
    json["issues"].push_back(issue.line());
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

RunOrigin originOfRun(const std::filesystem::path& file) {
  const Json json = parseJson(base::readFile(file), file.string());
  const auto seed = json.is_object() ? json.find("seed") : json.end();
  if (seed == json.end() || !seed->is_number_unsigned()) {
    throw base::InputError(file.string(), "/seed", "expected the seed of a run, a whole number from 0");
  }
  const auto partial = json.find("partial");
  if (partial != json.end() && !partial->is_boolean()) {
    throw base::InputError(file.string(), "/partial", "expected true or false: whether the run was cut short");
  }
  return {seed->get<std::uint64_t>(), partial != json.end() && partial->get<bool>()};
}

}  // namespace lorica::study
