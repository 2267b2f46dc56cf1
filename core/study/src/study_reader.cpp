#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "json_node.h"
#include "json_text.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/study/study_file.h"
#include "section_readers.h"
#include "study_upgrade.h"
#include "study_words.h"

namespace lorica::study {

namespace {

void refuseReserved(const Node& node, const std::string& name, std::span<const std::string_view> reserved,
                    const char* meaning) {
  if (std::find(reserved.begin(), reserved.end(), name) != reserved.end()) {
    node.fail(fmt::format("the name {} is kept for {}; choose another", inQuotes(name), meaning));
  }
}

std::string structureName(const Node& node, Names& structures) {
  std::string name = node.name("a name");
  refuseReserved(node, name, reservedStructures, "a row of the results");
  structures.claim(node, name);
  return name;
}

/// The keys of a mesh inside the object that has it.
MeshSource readMesh(const Node& node) {
  MeshSource mesh;
  const Node file = node["file"];
  const Node builtin = node["builtin"];
  if (file.present() == builtin.present()) {
    node.fail(file.present() ? "expected either \"file\" or \"builtin\", found both"
                             : "expected \"file\" (a path) or \"builtin\" (a name), found neither");
  }
  if (builtin.present()) {
    mesh.from = Builtin{builtin.name("the name of something built in")};
    for (const char* key : {"sha256", "units", "up"}) {
      if (node[key].present()) {
        node[key].fail("belongs to a \"file\"; remove it here");
      }
    }
  } else {
    mesh.from = readInputFile(node);
  }
  if (const Node parts = node["parts"]; parts.present()) {
    mesh.parts = nameList(parts, "names of parts");
  }
  return mesh;
}

/// Joints and what they stand for: a name or a list of names for each role.
std::vector<human::RoleEntry> readJointRoles(const Node& node) {
  std::vector<human::RoleEntry> entries;
  for (const auto& [role, value] : node.members("an object of roles and the joints that play them")) {
    human::RoleEntry entry{role, {}};
    if (value.isList()) {
      entry.joints = nameList(value, "names of joints");
    } else {
      entry.joints.push_back(value.name("the name of a joint, or a list of them"));
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

void readHuman(const Node& node, Study& study) {
  node.checkObject("a human with \"file\" or \"builtin\"", humanKeys);
  study.human = readMesh(node);
  const bool builtin = std::holds_alternative<Builtin>(study.human.from);
  for (const char* key : {"sex", "stature_m", "mass_kg"}) {
    if (!builtin && node[key].present()) {
      node[key].fail("belongs to the \"builtin\" human; remove it here");
    }
  }
  if (const Node sex = node["sex"]; sex.present()) {
    study.person.sex = sex.choice(sexWords);
  }
  if (const Node stature = node["stature_m"]; stature.present()) {
    study.person.stature = stature.number({1.0, 2.5, true, "a stature in m, 1 to 2.5"});
  }
  if (const Node mass = node["mass_kg"]; mass.present()) {
    study.person.mass = mass.number({20.0, 300.0, true, "a mass in kg, 20 to 300"});
  }
  if (const Node roles = node["joint_roles"]; roles.present()) {
    if (builtin) {
      roles.fail("belongs to a \"file\"; the built-in human needs none");
    }
    study.jointRoles = readJointRoles(roles);
  }
}

Motion readMotion(const Node& node, Names& motions) {
  node.checkObject("a recorded motion", recordedKeys);
  Motion motion;
  motion.name = node["name"].name("a name");
  motions.claim(node["name"], motion.name);
  motion.description = readDescription(node);
  motion.file.path = node["file"].name("a path");
  if (const Node digits = node["sha256"]; digits.present()) {
    motion.file.sha256 = sha256Text(digits);
  }
  if (const Node up = node["up"]; up.present()) {
    motion.file.up = up.choice(upWords);
  }
  if (const Node inPlace = node["in_place"]; inPlace.present()) {
    motion.inPlace = inPlace.boolean();
  }
  if (const Node roles = node["joint_roles"]; roles.present()) {
    motion.jointRoles = readJointRoles(roles);
  }
  return motion;
}

std::array<int, 3> readCells(const Node& node) {
  const auto count = [](const Node& entry) { return static_cast<int>(entry.whole(1, 1000)); };
  if (node.isNumber()) {
    const int n = count(node);
    return {n, n, n};
  }
  const char* what = "a whole number or a list of three, the cells along x, y and z";
  const std::vector<Node> entries = node.list(what);
  if (entries.size() != 3) {
    node.failExpected(what);
  }
  return {count(entries[0]), count(entries[1]), count(entries[2])};
}

LatticeSettings readLattice(const Node& node) {
  using Layout = LatticeSettings::Layout;
  node.checkObject("the settings of a lattice", latticeKeys);
  LatticeSettings lattice;
  if (const Node layout = node["layout"]; layout.present()) {
    lattice.layout = layout.choice(layoutWords);
  }
  const Node cells = node["cells"];
  if (lattice.layout == Layout::uniform || lattice.layout == Layout::perAxis) {
    lattice.cells = readCells(cells);
  } else if (cells.present()) {
    cells.fail("belongs to the layouts \"uniform\" and \"per_axis\"; change the layout or remove it");
  }
  if (const Node size = node["cell_mm"]; size.present()) {
    if (lattice.layout != Layout::cellSize) {
      size.fail("belongs to the layout \"cell_size\"; change the layout or remove it");
    }
    lattice.cellMetres = size.number({0.1, 2000.0, false, "a size in mm above 0.1, up to 2000"}) / 1000.0;
  }
  if (const Node prune = node["prune"]; prune.present()) {
    lattice.prune = prune.boolean();
  }
  return lattice;
}

Organ readOrgan(const Node& node, Names& structures) {
  node.checkObject("an organ", organKeys);
  Organ organ;
  organ.name = structureName(node["name"], structures);
  organ.description = readDescription(node);
  organ.mesh = readMesh(node);
  if (const Node injury = node["class"]; injury.present()) {
    organ.injuryClass = injury.choice(classWords);
  }
  if (const Node joint = node["joint"]; joint.present()) {
    organ.joint = joint.name("the name of a joint");
  }
  if (const Node lattice = node["lattice"]; lattice.present()) {
    organ.lattice = readLattice(lattice);
  }
  return organ;
}

ArmorPiece readPiece(const Node& node, Names& structures) {
  node.checkObject("a piece of armor", pieceKeys);
  ArmorPiece piece;
  piece.name = structureName(node["name"], structures);
  piece.description = readDescription(node);
  piece.mesh = readMesh(node);
  if (const Node carriage = node["carriage"]; carriage.present()) {
    piece.carriage = carriage.choice(carriageWords);
  }
  if (const Node parts = node["non_protecting"]; parts.present()) {
    piece.nonProtecting = nameList(parts, "names of parts");
  }
  if (const Node density = node["areal_density_kg_m2"]; density.present()) {
    piece.arealDensity = density.number({0.0, 10000.0, false, "kg/m2 above 0, up to 10000"});
  }
  if (const Node material = node["material"]; material.present()) {
    piece.material = material.name("the name of a material");
  }
  return piece;
}

ArmorSystem readSystem(const Node& node, Names& systems, Names& structures) {
  node.checkObject("an armor system", systemKeys);
  ArmorSystem system;
  const Node name = node["name"];
  system.name = name.name("a name");
  refuseReserved(name, system.name, {&unarmored, 1}, "the body without armor, which is always computed");
  systems.claim(name, system.name);
  system.description = readDescription(node);
  if (const Node pieces = node["pieces"]; pieces.present()) {
    for (const Node& piece : pieces.list("a list of pieces of armor")) {
      system.pieces.push_back(readPiece(piece, structures));
    }
  }
  return system;
}

ClipPose readClipPose(const Node& node) {
  ClipPose pose;
  pose.clip = node["clip"].name("the name of a clip");
  if (const Node seconds = node["seconds"]; seconds.present()) {
    pose.seconds = seconds.number({0.0, 1e6, true, "seconds from 0 to 1000000"});
  }
  if (node["root_offset"].present()) {
    node["root_offset"].fail("belongs to \"turns\"; remove it here");
  }
  return pose;
}

TurnedPose readTurnedPose(const Node& node) {
  const char* degrees = "degrees about x, y and z";
  const Node turns = node["turns"];
  TurnedPose pose;
  if (turns.isList()) {
    Names joints;
    for (const Node& entry : turns.list("")) {
      entry.checkObject("the turn of a joint", turnKeys);
      const Node joint = entry["joint"];
      pose.turns.push_back({joint.name("the name of a joint"), entry["degrees"].vector(degrees)});
      joints.claim(joint, pose.turns.back().joint);
    }
  } else {
    for (const auto& [joint, entry] : turns.members("an object with the turned joints")) {
      entry.checkName(joint, "the name of a joint");
      pose.turns.push_back({joint, entry.vector(degrees)});
    }
  }
  if (const Node offset = node["root_offset"]; offset.present()) {
    pose.rootOffset = offset.vector("metres");
  }
  if (node["seconds"].present()) {
    node["seconds"].fail("belongs to \"clip\"; remove it here");
  }
  return pose;
}

Pose readPose(const Node& node, Names& poses) {
  node.checkObject("a pose", poseKeys);
  Pose pose;
  const Node name = node["name"];
  pose.name = name.name("a name");
  refuseReserved(name, pose.name, {&restPose, 1}, "the bind pose, which always exists");
  poses.claim(name, pose.name);
  pose.description = readDescription(node);
  if (node["clip"].present() == node["turns"].present()) {
    node.fail(node["clip"].present() ? "expected either \"clip\" or \"turns\", found both"
                                     : "expected \"clip\" (a name) or \"turns\" (of joints), found neither");
  }
  if (node["clip"].present()) {
    pose.what = readClipPose(node);
  } else {
    pose.what = readTurnedPose(node);
  }
  if (const std::optional<ClipPose> meant = clipPoseNamed(pose.name)) {
    const auto* clip = std::get_if<ClipPose>(&pose.what);
    if (clip == nullptr || *clip != *meant) {
      name.fail(fmt::format("{} reads as a clip at a time, and the pose is another; rename it", inQuotes(pose.name)));
    }
  }
  return pose;
}

/// "#rrggbb".
std::array<std::uint8_t, 3> readColour(const Node& node) {
  const char* what = "a colour such as \"#c02818\"";
  const std::string text = node.text(what);
  const bool wellFormed = text.size() == 7 && text.front() == '#' &&
                          text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!wellFormed) {
    node.failExpected(what);
  }
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    colour.at(c) = static_cast<std::uint8_t>(std::stoul(text.substr(1 + 2 * c, 2), nullptr, 16));
  }
  return colour;
}

Display readDisplay(const Node& node, Names& drawn) {
  node.checkObject("how a structure is drawn", displayKeys);
  Display display;
  const Node structure = node["structure"];
  display.structure = structure.name("the name of a structure");
  drawn.claim(structure, display.structure);
  if (const Node visible = node["visible"]; visible.present()) {
    display.visible = visible.boolean();
  }
  if (const Node colour = node["colour"]; colour.present()) {
    display.colour = readColour(colour);
  }
  if (const Node opacity = node["opacity"]; opacity.present()) {
    display.opacity = opacity.number({0.0, 1.0, true, "an opacity from 0 to 1"});
  }
  return display;
}

std::vector<std::string> readRunPoses(const Node& node, const std::vector<Pose>& poses) {
  std::vector<std::string> names;
  Names taken;
  for (const Node& entry : node.list("a list of poses")) {
    std::string name = entry.name("the name of a pose");
    const bool listed = std::any_of(poses.begin(), poses.end(), [&](const Pose& pose) { return pose.name == name; });
    if (name != restPose && !listed && !clipPoseNamed(name)) {
      entry.failExpected("\"rest\", a pose of this study or CLIP@SECONDS");
    }
    taken.claim(entry, name);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<OrganModel> readModels(const Node& node) {
  std::vector<OrganModel> models;
  Names taken;
  for (const Node& entry : node.list("a list of organ models")) {
    models.push_back(entry.choice(modelWords));
    taken.claim(entry, name(models.back()));
  }
  return models;
}

void readLists(const Node& root, Study& study) {
  Names structures;
  Names systems;
  Names poses;
  Names sources;
  Names threats;
  Names motions;
  if (const Node list = root["motions"]; list.present()) {
    for (const Node& motion : list.list("a list of recorded motions")) {
      study.motions.push_back(readMotion(motion, motions));
    }
  }
  if (const Node organs = root["organs"]; organs.present()) {
    for (const Node& organ : organs.list("a list of organs")) {
      study.organs.push_back(readOrgan(organ, structures));
    }
  }
  if (const Node armor = root["armor"]; armor.present()) {
    for (const Node& system : armor.list("a list of armor systems")) {
      study.systems.push_back(readSystem(system, systems, structures));
    }
  }
  if (const Node list = root["poses"]; list.present()) {
    for (const Node& pose : list.list("a list of poses")) {
      study.poses.push_back(readPose(pose, poses));
    }
  }
  if (const Node run = root["run_poses"]; run.present()) {
    study.runPoses = readRunPoses(run, study.poses);
  }
  if (const Node list = root["sources"]; list.present()) {
    for (const Node& source : list.list("a list of sources")) {
      study.sources.push_back(readSource(source));
      sources.claim(source["name"], study.sources.back().name);
    }
  }
  if (const Node list = root["threats"]; list.present()) {
    for (const Node& threat : list.list("a list of threat data")) {
      study.threats.push_back(readThreat(threat));
      threats.claim(threat["name"], study.threats.back().name);
    }
  }
  if (const Node list = root["display"]; list.present()) {
    Names drawn;
    for (const Node& display : list.list("a list of structures and how they are drawn")) {
      study.displays.push_back(readDisplay(display, drawn));
    }
  }
  if (const Node models = root["models"]; models.present()) {
    study.models = readModels(models);
  }
}

}  // namespace

Study parseStudy(std::string_view json, const std::string& file) {
  const Json tree = upgraded(parseJson(json, file), file, upgradeSteps());
  const Node root(&tree, file, "");
  root.checkObject("a study", studyKeys);
  Study study;
  if (const Node name = root["name"]; name.present()) {
    study.name = name.name("a name");
  }
  study.description = readDescription(root);
  readHuman(root["human"], study);
  readLists(root, study);
  if (const Node trials = root["trials"]; trials.present()) {
    study.trials = static_cast<std::uint32_t>(trials.whole(1, 100000));
  }
  if (const Node seed = root["seed"]; seed.present()) {
    study.seed = seed.whole(0, std::numeric_limits<std::uint64_t>::max());
  }
  if (const Node stop = root["stop"]; stop.present()) {
    study.stop = readStop(stop);
  }
  if (const Node overlap = root["overlap"]; overlap.present()) {
    study.overlap = readOverlap(overlap);
  }
  if (const Node analyses = root["analyses"]; analyses.present()) {
    study.analyses = readAnalyses(analyses);
  }
  if (const Node spacing = root["site_spacing_mm"]; spacing.present()) {
    study.siteSpacing = spacing.number({5.0, 500.0, true, "a spacing in mm from 5 to 500"}) / 1000.0;
  }
  if (const Node skinning = root["skinning"]; skinning.present()) {
    study.skinning = skinning.choice(skinningWords);
  }
  if (const Node deformer = root["deformer"]; deformer.present()) {
    study.deformer = deformer.choice(deformerWords);
  }
  return study;
}

Study loadStudy(const std::filesystem::path& path) {
  return parseStudy(base::readFile(path), path.string());
}

}  // namespace lorica::study
