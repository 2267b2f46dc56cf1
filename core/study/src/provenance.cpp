#include "lorica/study/provenance.h"

#include <nlohmann/json.hpp>

#include "lorica/base/units.h"
#include "lorica/study/study_file.h"
#include "study_words.h"

namespace lorica::study {

namespace {

using Json = nlohmann::ordered_json;

Json vector(const geometry::Vec3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json sourceJson(const Provenance::SourceRecord& source) {
  Json json{{"name", source.name},
            {"position_m", vector(source.position)},
            {"target_m", vector(source.target)},
            {"sampler", source.sampler},
            {"shots_per_trial", source.shots}};
  if (source.solidAngle > 0.0) {
    json["half_angle_deg"] = base::degrees(source.halfAngle);
    json["solid_angle_sr"] = source.solidAngle;
    json["percentages_are_of"] = "the cone's solid angle";
  } else {
    json["percentages_are_of"] = "shots of Eq 15, which have no solid angle; half of them go backwards";
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
  json["study"] = {{"name", provenance.study.name}, {"sha256", sha256(studyText(provenance.study))}};
  json["inputs"] = Json::array();
  for (const InputFile& input : inputFiles(provenance.study)) {
    json["inputs"].push_back({{"file", input.path}, {"sha256", input.sha256}});
  }
  json["seed"] = provenance.seed;
  json["trials"] = provenance.trials;
  json["models"] = provenance.models;
  json["systems"] = provenance.systems;
  json["poses"] = provenance.poses;
  json["interval"] = "Wilson, 95 %";
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
  }
  json["issues"] = Json::array();
  for (const base::Issue& issue : provenance.issues) {
    json["issues"].push_back(issue.line());
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lorica::study
