#include "section_readers.h"

#include "study_words.h"

namespace lorica::study {

std::string readDescription(const Node& node) {
  const Node text = node["description"];
  return text.present() ? text.text("a text") : "";
}

std::string sha256Text(const Node& node) {
  const char* what = "64 lower-case hexadecimal digits";
  std::string digits = node.text(what);
  if (digits.size() != 64 || digits.find_first_not_of("0123456789abcdef") != std::string::npos) {
    node.failExpected(what);
  }
  return digits;
}

std::vector<std::string> nameList(const Node& node, const std::string& what) {
  std::vector<std::string> names;
  Names taken;
  for (const Node& entry : node.list("a list of " + what)) {
    names.push_back(entry.name(what));
    taken.claim(entry, names.back());
  }
  return names;
}

StopRule readStop(const Node& node) {
  node.checkObject("when trials are enough", stopKeys);
  StopRule stop;
  const Node structures = node["structures"];
  stop.structures = nameList(structures, "names of organs");
  if (stop.structures.empty()) {
    structures.fail("names no organ; name one whose interval is to be narrow, or remove \"stop\"");
  }
  if (const Node width = node["half_width"]; width.present()) {
    stop.halfWidth = width.number({0.0, 0.5, false, "half the width of an interval above 0, up to 0.5"});
  }
  if (const Node trials = node["max_trials"]; trials.present()) {
    stop.maxTrials = static_cast<std::uint32_t>(trials.whole(1, 100000));
  }
  return stop;
}

Overlap readOverlap(const Node& node) {
  node.checkObject("who owns what several structures claim", overlapKeys);
  Overlap overlap;
  if (const Node policy = node["policy"]; policy.present()) {
    overlap.policy = policy.choice(overlapWords);
  }
  const Node order = node["order"];
  if (overlap.policy == OverlapPolicy::priority) {
    overlap.order = nameList(order, "names of organs and pieces");
  } else if (order.present()) {
    order.fail("belongs to the policy \"priority\"; remove it here");
  }
  return overlap;
}

namespace {

DirectionGrid readDirections(const Node& node) {
  node.checkObject("coverage by direction", directionsKeys);
  DirectionGrid grid;
  if (const Node step = node["step_deg"]; step.present()) {
    grid.step = static_cast<double>(step.whole(1, 90));
    if (180 % static_cast<int>(grid.step) != 0) {
      step.fail(
          fmt::format("steps of {} degrees do not divide 180; choose 10, 15, 20, 30 or another that does", grid.step));
    }
  }
  if (const Node shots = node["shots"]; shots.present()) {
    grid.shots = shots.whole(1, 1'000'000'000ULL);
  }
  return grid;
}

MotionSettings readMotion(const Node& node) {
  node.checkObject("coverage over a motion", motionKeys);
  MotionSettings motion;
  motion.clip = node["clip"].name("the name of a clip");
  if (const Node every = node["every"]; every.present()) {
    motion.every = static_cast<std::uint32_t>(every.whole(1, 10000));
  }
  if (const Node rate = node["frames_per_second"]; rate.present()) {
    motion.framesPerSecond = rate.number({0.0, 1000.0, false, "frames per second above 0, up to 1000"});
  }
  return motion;
}

}  // namespace

Analyses readAnalyses(const Node& node) {
  node.checkObject("what a run works out beside the coverage", analysesKeys);
  Analyses analyses;
  if (const Node compare = node["compare"]; compare.present()) {
    analyses.compare = compare.boolean();
  }
  if (const Node convergence = node["convergence"]; convergence.present()) {
    analyses.convergence = convergence.boolean();
  }
  if (const Node directions = node["directions"]; directions.present()) {
    analyses.directions = readDirections(directions);
  }
  if (const Node motion = node["motion"]; motion.present()) {
    analyses.motion = readMotion(motion);
  }
  return analyses;
}

}  // namespace lorica::study
