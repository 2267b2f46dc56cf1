#include "lorica/study/run_facts.h"

#include <limits>
#include <utility>

#include "json_node.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::study {

namespace {

constexpr std::uint64_t most = std::uint64_t{1} << 53U;
constexpr NumberRange anyNumber{-1e12, 1e12, true, "a number"};
constexpr NumberRange notNegative{0.0, 1e12, true, "a number from 0"};

std::vector<std::string> texts(const Node& node, const std::string& what) {
  std::vector<std::string> all;
  for (const Node& one : node.list(what)) {
    all.push_back(one.text(what));
  }
  return all;
}

/// The same where a run has at least one.
std::vector<std::string> someTexts(const Node& node, const std::string& what) {
  std::vector<std::string> all = texts(node, what);
  if (all.empty()) {
    node.fail("expected " + what + " with one entry at least");
  }
  return all;
}

/// One number or several.
std::vector<double> numbers(const Node& node) {
  if (!node.present()) {
    return {};
  }
  if (!node.isList()) {
    return {node.number(anyNumber)};
  }
  std::vector<double> all;
  for (const Node& one : node.list("numbers")) {
    all.push_back(one.number(anyNumber));
  }
  return all;
}

std::optional<double> maybe(const Node& node) {
  return node.present() ? std::optional(node.number(notNegative)) : std::nullopt;
}

std::string textOr(const Node& node, const std::string& what) {
  return node.present() ? node.text(what) : std::string();
}

RunFacts::Source sourceOf(const Node& node) {
  node.members("a source of the run");
  RunFacts::Source source;
  source.name = node["name"].text("the name of a source");
  source.type = node["type"].text("the type of a source");
  source.sampler = textOr(node["sampler"], "a sampler");
  source.sequence = textOr(node["sequence"], "a sequence");
  source.interval = textOr(node["interval"], "how intervals are made");
  source.basis = textOr(node["percentages_are_of"], "what percentages are of");
  source.shotsPerTrial = node["shots_per_trial"].whole(0, most);
  source.position = numbers(node["position_m"]);
  source.azimuth = numbers(node["azimuth_deg"]);
  source.elevation = numbers(node["elevation_deg"]);
  source.halfAngle = maybe(node["half_angle_deg"]);
  source.solidAngle = maybe(node["solid_angle_sr"]);
  source.area = maybe(node["area_m2"]);
  return source;
}

RunFacts::Run runOf(const Node& node) {
  node.members("what was shot from a source at a pose");
  RunFacts::Run run;
  run.source = node["source"].text("the name of a source");
  run.pose = node["pose"].text("the name of a pose");
  run.trials = node["trials_finished"].whole(0, most);
  run.shots = node["shots"].whole(0, most);
  run.retraced = node["retraced"].whole(0, most);
  run.unresolved = node["unresolved"].whole(0, most);
  run.nearOpenEdge = node["near_open_edge"].whole(0, most);
  if (const Node reached = node["stop_goal_reached"]; reached.present()) {
    run.goalReached = reached.boolean();
  }
  return run;
}

void readStudy(const Node& node, RunFacts& facts) {
  node.members("the study that was run");
  facts.study = node["name"].text("the name of the study");
  facts.description = textOr(node["description"], "a description");
  facts.studyHash = node["sha256"].text("the SHA-256 of the study");
}

void readStop(const Node& node, RunFacts& facts) {
  if (!node.present()) {
    return;
  }
  node.members("a rule for stopping");
  RunFacts::Stop stop;
  stop.structures = texts(node["structures"], "a list of structures");
  stop.halfWidth = node["half_width"].number(notNegative);
  stop.maxTrials = node["max_trials"].whole(0, most);
  facts.stop = std::move(stop);
}

}  // namespace

RunFacts readProvenance(const std::filesystem::path& file) {
  const std::string name = file.string();
  const Json json = parseJson(base::readFile(file), name);
  const Node root(&json, name, "");
  root.members("the provenance of a run, as lorica-cli run writes it");
  RunFacts facts;
  facts.version = root["lorica_version"].text("the version that made the run; is this a run's provenance.json?");
  facts.partial = root["partial"].boolean();
  readStudy(root["study"], facts);
  for (const Node& input : root["inputs"].list("the inputs of the study")) {
    input.members("an input");
    facts.inputs.push_back({input["file"].text("a file"), input["sha256"].text("a SHA-256")});
  }
  facts.seed = root["seed"].whole(0, std::numeric_limits<std::uint64_t>::max());
  facts.trials = root["trials"].whole(0, most);
  readStop(root["stop"], facts);
  facts.models = someTexts(root["models"], "a list of models");
  facts.systems = someTexts(root["systems"], "a list of systems");
  facts.poses = someTexts(root["poses"], "a list of poses");
  for (const Node& source : root["sources"].list("the sources of the run")) {
    facts.sources.push_back(sourceOf(source));
  }
  facts.skinning = textOr(root["skinning"], "how the skin is deformed");
  facts.deformer = textOr(root["deformer"], "how organs are deformed");
  facts.interiorSites = root["interior_sites"].whole(0, most);
  for (const Node& run : root["runs"].list("the runs")) {
    facts.runs.push_back(runOf(run));
  }
  facts.issues = texts(root["issues"], "a list of issues");
  if (const Node tables = root["tables"]; tables.present()) {
    facts.tables = texts(tables, "a list of files");
  }
  return facts;
}

}  // namespace lorica::study
