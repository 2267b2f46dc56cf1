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

InputFile readInputFile(const Node& node) {
  InputFile input;
  input.path = node["file"].name("a path");
  if (const Node digits = node["sha256"]; digits.present()) {
    input.sha256 = sha256Text(digits);
  }
  if (const Node units = node["units"]; units.present()) {
    input.units = units.choice(unitWords);
  }
  if (const Node up = node["up"]; up.present()) {
    input.up = up.choice(upWords);
  }
  return input;
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

GapSettings readGaps(const Node& node) {
  node.checkObject("where shots get past the armor", gapsKeys);
  GapSettings gaps;
  const Node structures = node["structures"];
  gaps.structures = nameList(structures, "names of organs, or \"body\" for the skin");
  if (gaps.structures.empty()) {
    structures.fail("names no structure; name an organ or \"body\", or remove \"gaps\"");
  }
  if (const Node share = node["open_share"]; share.present()) {
    gaps.openShare = share.number({0.0, 0.95, true, "a share of shots from 0 to 0.95"});
  }
  if (const Node shots = node["min_shots"]; shots.present()) {
    gaps.minShots = static_cast<std::uint32_t>(shots.whole(1, 1'000'000));
  }
  if (const Node radius = node["radius_mm"]; radius.present()) {
    gaps.radius = radius.number({0.0, 1000.0, true, "a radius in mm from 0 to 1000"}) / 1000.0;
  }
  if (const Node maps = node["maps"]; maps.present()) {
    gaps.maps = maps.boolean();
  }
  return gaps;
}

AnatomySettings readAnatomy(const Node& node) {
  node.checkObject("organs moved at random", anatomyKeys);
  AnatomySettings anatomy;
  if (const Node draws = node["draws"]; draws.present()) {
    anatomy.draws = static_cast<std::uint32_t>(draws.whole(2, 100000));
  }
  if (const Node scale = node["scale"]; scale.present()) {
    anatomy.scale = scale.number({0.0, 10.0, true, "a factor from 0 to 10"});
  }
  if (const Node verified = node["verified_only"]; verified.present()) {
    anatomy.verifiedOnly = verified.boolean();
  }
  if (const Node deviations = node["sd_mm"]; deviations.present()) {
    for (const auto& [organ, entry] : deviations.members("standard deviations by organ")) {
      deviations.checkName(organ, "the name of an organ");
      const geometry::Vec3d millimetres = entry.vector("standard deviations in mm to the left, up and forward");
      if (millimetres.minCoeff() < 0.0 || millimetres.maxCoeff() > 500.0) {
        entry.fail("standard deviations are from 0 to 500 mm");
      }
      anatomy.deviations.push_back({organ, millimetres / 1000.0});
    }
  }
  return anatomy;
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
  if (const Node gaps = node["gaps"]; gaps.present()) {
    analyses.gaps = readGaps(gaps);
  }
  if (const Node anatomy = node["anatomy"]; anatomy.present()) {
    analyses.anatomy = readAnatomy(anatomy);
  }
  return analyses;
}

}  // namespace lorica::study
