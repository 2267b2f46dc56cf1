#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "json_text.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "study_words.h"

namespace lorica::study {

namespace {

/// Shortest text that reads back as the same number; both zeros are "0".
std::string numberText(double value) {
  LORICA_CHECK(std::isfinite(value), "a study holds finite numbers only");
  return fmt::format("{}", value == 0.0 ? 0.0 : value);
}

/// Millimetres that the reader turns back into these metres, with the fewest digits.
double millimetres(double metres) {
  const double product = metres * 1000.0;
  double best = product;
  bool found = false;
  for (const double candidate : {product, std::nextafter(product, 0.0), std::nextafter(product, 2.0 * product)}) {
    if (candidate / 1000.0 == metres && (!found || numberText(candidate).size() < numberText(best).size())) {
      best = candidate;
      found = true;
    }
  }
  return best;
}

std::string scalarText(const Json& value) {
  return value.is_number_float() ? numberText(value.get<double>()) : value.dump();
}

/// Two spaces a level; a list of numbers stays on one line.
void print(const Json& value, const std::string& indent, std::string& out) {
  if (!value.is_structured() || value.empty()) {
    out += scalarText(value);
    return;
  }
  const bool flat = value.is_array() && value.front().is_number();
  const std::string inner = flat ? "" : "\n" + indent + "  ";
  out += value.is_array() ? '[' : '{';
  const char* separator = "";
  for (const auto& [key, entry] : value.items()) {
    out += separator + inner + (value.is_array() ? "" : Json(key).dump() + ": ");
    print(entry, indent + "  ", out);
    separator = flat ? ", " : ",";
  }
  out += flat ? "" : "\n" + indent;
  out += value.is_array() ? ']' : '}';
}

Json vectorJson(const geometry::Vec3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

void putText(Json& object, const char* key, const std::string& text) {
  if (!text.empty()) {
    object[key] = text;
  }
}

void putNames(Json& object, const char* key, const std::vector<std::string>& names) {
  if (!names.empty()) {
    object[key] = names;
  }
}

void putInput(Json& object, const InputFile& input) {
  object["file"] = input.path;
  putText(object, "sha256", input.sha256);
  if (input.units) {
    object["units"] = wordFor(*input.units, unitWords);
  }
  if (input.up) {
    object["up"] = wordFor(*input.up, upWords);
  }
}

void putMesh(Json& object, const MeshSource& mesh) {
  if (const auto* builtin = std::get_if<Builtin>(&mesh.from)) {
    object["builtin"] = builtin->name;
  } else {
    putInput(object, std::get<InputFile>(mesh.from));
  }
  putNames(object, "parts", mesh.parts);
}

void putRoles(Json& object, const std::vector<human::RoleEntry>& roles) {
  for (const human::RoleEntry& entry : roles) {
    object["joint_roles"][entry.role] = entry.joints.size() == 1 ? Json(entry.joints.front()) : Json(entry.joints);
  }
}

Json humanJson(const Study& study) {
  Json object = Json::object();
  putMesh(object, study.human);
  if (std::holds_alternative<Builtin>(study.human.from)) {
    object["sex"] = wordFor(study.person.sex, sexWords);
    object["stature_m"] = study.person.stature;
    object["mass_kg"] = study.person.mass;
  }
  putRoles(object, study.jointRoles);
  return object;
}

Json named(const std::string& name, const std::string& description) {
  Json object;
  object["name"] = name;
  putText(object, "description", description);
  return object;
}

Json motionJson(const Motion& motion) {
  Json object = named(motion.name, motion.description);
  object["file"] = motion.file.path;
  putText(object, "sha256", motion.file.sha256);
  if (motion.file.up) {
    object["up"] = wordFor(*motion.file.up, upWords);
  }
  if (motion.inPlace) {
    object["in_place"] = true;
  }
  putRoles(object, motion.jointRoles);
  return object;
}

Json latticeJson(const LatticeSettings& lattice) {
  using Layout = LatticeSettings::Layout;
  const LatticeSettings defaults;
  Json object = Json::object();
  if (lattice.layout != defaults.layout) {
    object["layout"] = wordFor(lattice.layout, layoutWords);
  }
  const auto& [x, y, z] = lattice.cells;
  if (lattice.layout == Layout::uniform || lattice.layout == Layout::perAxis) {
    object["cells"] = x == y && y == z ? Json(x) : Json(lattice.cells);
  }
  if (lattice.layout == Layout::cellSize) {
    object["cell_mm"] = millimetres(lattice.cellMetres);
  }
  if (lattice.prune != defaults.prune) {
    object["prune"] = lattice.prune;
  }
  return object;
}

Json organJson(const Organ& organ) {
  Json object = named(organ.name, organ.description);
  putMesh(object, organ.mesh);
  putText(object, "class", organ.injuryClass);
  if (organ.joint) {
    object["joint"] = *organ.joint;
  }
  if (Json lattice = latticeJson(organ.lattice); !lattice.empty()) {
    object["lattice"] = std::move(lattice);
  }
  return object;
}

Json pieceJson(const ArmorPiece& piece) {
  Json object = named(piece.name, piece.description);
  putMesh(object, piece.mesh);
  if (piece.carriage != Carriage::rigid) {
    object["carriage"] = wordFor(piece.carriage, carriageWords);
  }
  putNames(object, "non_protecting", piece.nonProtecting);
  if (piece.arealDensity) {
    object["areal_density_kg_m2"] = *piece.arealDensity;
  }
  putText(object, "material", piece.material);
  return object;
}

Json systemJson(const ArmorSystem& system) {
  Json object = named(system.name, system.description);
  for (const ArmorPiece& piece : system.pieces) {
    object["pieces"].push_back(pieceJson(piece));
  }
  return object;
}

Json poseJson(const Pose& pose) {
  Json object = named(pose.name, pose.description);
  if (const auto* clip = std::get_if<ClipPose>(&pose.what)) {
    object["clip"] = clip->clip;
    if (clip->seconds != 0.0) {
      object["seconds"] = clip->seconds;
    }
    return object;
  }
  const auto& turned = std::get<TurnedPose>(pose.what);
  object["turns"] = Json::object();
  for (const TurnedPose::Turn& turn : turned.turns) {
    object["turns"][turn.joint] = vectorJson(turn.degrees);
  }
  if (turned.rootOffset != geometry::Vec3d::Zero()) {
    object["root_offset"] = vectorJson(turned.rootOffset);
  }
  return object;
}

/// What a point alone has, after its position and before its target.
void putPosition(Json& object, const Source& source) {
  if (source.type == SourceType::point) {
    object["position"] = vectorJson(source.position);
  }
}

void putAngles(Json& object, const Source& source) {
  if (source.type == SourceType::parallel) {
    object["azimuth_deg"] = source.azimuth.from;
    object["elevation_deg"] = source.elevation.from;
  }
  if (source.type == SourceType::band) {
    object["azimuth_deg"] = Json::array({source.azimuth.from, source.azimuth.to});
    object["elevation_deg"] = Json::array({source.elevation.from, source.elevation.to});
  }
}

void putTarget(Json& object, const Source& source) {
  if (source.target) {
    object["target"] = vectorJson(*source.target);
  }
  putText(object, "target_structure", source.targetStructure);
}

void putSampler(Json& object, const Source& source) {
  if (source.type != SourceType::point) {
    return;
  }
  object["sampler"] = wordFor(source.sampler, samplerWords);
  if (source.sampler == Sampler::rectangle) {
    object["width_m"] = source.width;
    object["height_m"] = source.height;
  }
  if (source.sampler == Sampler::disk) {
    object["radius_m"] = source.radius;
  }
}

Json sourceJson(const Source& source) {
  Json object = named(source.name, source.description);
  if (source.type != SourceType::point) {
    object["type"] = wordFor(source.type, sourceTypeWords);
  }
  if (source.type == SourceType::list) {
    object["file"] = source.list.path;
    putText(object, "sha256", source.list.sha256);
    return object;
  }
  putPosition(object, source);
  putAngles(object, source);
  putTarget(object, source);
  putSampler(object, source);
  if (source.sequence != Sequence::random) {
    object["sequence"] = wordFor(source.sequence, sequenceWords);
  }
  if (source.sequence == Sequence::grid) {
    object["cell_mm"] = millimetres(source.cell);
  } else {
    object["shots"] = source.shots;
  }
  return object;
}

/// What a file alone has.
void putThreatFile(Json& object, const Threat& threat, const InputFile& file) {
  const Threat defaults;
  putInput(object, file);
  if (threat.timeUnits) {
    object["time_units"] = wordFor(*threat.timeUnits, timeUnitWords);
  }
  putText(object, "attribute", threat.attribute);
  if (threat.reach) {
    object["reach_mm"] = millimetres(*threat.reach);
  }
  if (threat.offset != defaults.offset) {
    object["offset"] = vectorJson(threat.offset);
  }
  if (threat.turn != defaults.turn) {
    object["turn_deg"] = vectorJson(threat.turn);
  }
}

Json threatJson(const Threat& threat) {
  Json object = named(threat.name, threat.description);
  if (const auto* charge = std::get_if<BlastCharge>(&threat.from)) {
    object["builtin"] = blastBuiltin;
    object["tnt_kg"] = charge->tntKilograms;
    object["position"] = vectorJson(charge->position);
  } else {
    putThreatFile(object, threat, std::get<InputFile>(threat.from));
  }
  if (threat.threshold) {
    object["threshold"] = *threat.threshold;
  }
  if (threat.timeOffset != 0.0) {
    // Seconds in ms are as metres in mm.
    object["time_offset_ms"] = millimetres(threat.timeOffset);
  }
  Json display = Json::object();
  if (!threat.display.visible) {
    display["visible"] = false;
  }
  if (threat.display.range) {
    display["range"] = *threat.display.range;
  }
  if (!display.empty()) {
    object["display"] = std::move(display);
  }
  return object;
}

Json stopJson(const StopRule& stop) {
  return {{"structures", stop.structures}, {"half_width", stop.halfWidth}, {"max_trials", stop.maxTrials}};
}

Json overlapJson(const Overlap& overlap) {
  Json object;
  object["policy"] = wordFor(overlap.policy, overlapWords);
  if (overlap.policy == OverlapPolicy::priority) {
    object["order"] = overlap.order;
  }
  return object;
}

Json gapsJson(const GapSettings& gaps) {
  const GapSettings defaults;
  Json object = {{"structures", gaps.structures},
                 {"open_share", gaps.openShare},
                 {"min_shots", gaps.minShots},
                 {"radius_mm", millimetres(gaps.radius)}};
  if (gaps.maps != defaults.maps) {
    object["maps"] = gaps.maps;
  }
  return object;
}

Json anatomyJson(const AnatomySettings& anatomy) {
  Json object = {{"draws", anatomy.draws}, {"scale", anatomy.scale}};
  if (anatomy.verifiedOnly) {
    object["verified_only"] = true;
  }
  for (const AnatomySettings::Deviation& deviation : anatomy.deviations) {
    const geometry::Vec3d& metres = deviation.metres;
    object["sd_mm"][deviation.organ] =
        Json::array({millimetres(metres.x()), millimetres(metres.y()), millimetres(metres.z())});
  }
  return object;
}

Json analysesJson(const Analyses& analyses) {
  Json object;
  if (analyses.compare) {
    object["compare"] = true;
  }
  if (analyses.convergence) {
    object["convergence"] = true;
  }
  if (analyses.directions) {
    object["directions"] = {{"step_deg", analyses.directions->step}, {"shots", analyses.directions->shots}};
  }
  if (analyses.motion) {
    object["motion"] = {{"clip", analyses.motion->clip},
                        {"every", analyses.motion->every},
                        {"frames_per_second", analyses.motion->framesPerSecond}};
  }
  if (analyses.gaps) {
    object["gaps"] = gapsJson(*analyses.gaps);
  }
  if (analyses.anatomy) {
    object["anatomy"] = anatomyJson(*analyses.anatomy);
  }
  return object;
}

Json displayJson(const Display& display) {
  Json object;
  object["structure"] = display.structure;
  if (!display.visible) {
    object["visible"] = false;
  }
  if (display.colour) {
    const auto& [red, green, blue] = *display.colour;
    object["colour"] = fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
  }
  if (display.opacity) {
    object["opacity"] = *display.opacity;
  }
  return object;
}

template <class Item>
void putList(Json& object, const char* key, const std::vector<Item>& items, Json (*json)(const Item&)) {
  for (const Item& item : items) {
    object[key].push_back(json(item));
  }
}

Json studyJson(const Study& study) {
  const Study defaults;
  Json root;
  root["lorica_study"] = studyVersion;
  putText(root, "name", study.name);
  putText(root, "description", study.description);
  root["human"] = humanJson(study);
  putList(root, "motions", study.motions, motionJson);
  putList(root, "organs", study.organs, organJson);
  putList(root, "armor", study.systems, systemJson);
  putList(root, "poses", study.poses, poseJson);
  putNames(root, "run_poses", study.runPoses);
  putList(root, "sources", study.sources, sourceJson);
  putList(root, "threats", study.threats, threatJson);
  // What decides the numbers is written out, defaults or not.
  root["models"] = Json::array();
  for (const OrganModel model : study.models) {
    root["models"].push_back(name(model));
  }
  root["trials"] = study.trials;
  root["seed"] = study.seed;
  if (study.stop) {
    root["stop"] = stopJson(*study.stop);
  }
  if (study.overlap != defaults.overlap) {
    root["overlap"] = overlapJson(study.overlap);
  }
  if (study.analyses != defaults.analyses) {
    root["analyses"] = analysesJson(study.analyses);
  }
  if (study.siteSpacing != defaults.siteSpacing) {
    root["site_spacing_mm"] = millimetres(study.siteSpacing);
  }
  if (study.skinning != defaults.skinning) {
    root["skinning"] = wordFor(study.skinning, skinningWords);
  }
  if (study.deformer != defaults.deformer) {
    root["deformer"] = wordFor(study.deformer, deformerWords);
  }
  putList(root, "display", study.displays, displayJson);
  return root;
}

}  // namespace

std::string studyText(const Study& study) {
  std::string text;
  try {
    print(studyJson(study), "", text);
  } catch (const Json::type_error&) {
    throw base::InputError("", "", "a name, path or text of the study is not UTF-8; rename it");
  }
  return text + '\n';
}

void saveStudy(const Study& study, const std::filesystem::path& path) {
  base::writeFileAtomically(path, studyText(study));
}

}  // namespace lorica::study
