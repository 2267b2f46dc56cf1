#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "json_text.h"
#include "section_readers.h"
#include "study_words.h"

namespace lorica::study {

namespace {

/// Fails at keys that say nothing here. \param owner whom they belong to, as in "belongs to OWNER"
void refuse(const Node& node, std::initializer_list<const char*> keys, const std::string& owner) {
  for (const char* key : keys) {
    if (node[key].present()) {
      node[key].fail(fmt::format("belongs to {}; remove it here", owner));
    }
  }
}

double metres(const Node& node) {
  return node.number({0.0, 1000.0, false, "metres above 0, up to 1000"});
}

void readTarget(const Node& node, Source& source) {
  const Node target = node["target"];
  const Node structure = node["target_structure"];
  if (target.present() && structure.present()) {
    structure.fail("expected either \"target\" or \"target_structure\", found both");
  }
  if (target.present()) {
    source.target = target.vector("metres");
  }
  if (structure.present()) {
    source.targetStructure = structure.name("the name of an organ or a piece");
  }
}

void readPoint(const Node& node, Source& source) {
  source.position = node["position"].vector("metres");
  if (const Node sampler = node["sampler"]; sampler.present()) {
    source.sampler = sampler.choice(samplerWords);
  }
  if (source.sampler == Sampler::rectangle) {
    source.width = metres(node["width_m"]);
    source.height = metres(node["height_m"]);
  } else {
    refuse(node, {"width_m", "height_m"}, "the sampler \"rectangle\"");
  }
  if (source.sampler == Sampler::disk) {
    source.radius = metres(node["radius_m"]);
  } else {
    refuse(node, {"radius_m"}, "the sampler \"disk\"");
  }
}

constexpr NumberRange azimuths{-360.0, 360.0, true, "an azimuth from -360 to 360 degrees"};
constexpr NumberRange elevations{-90.0, 90.0, true, "an elevation from -90 to 90 degrees"};

DegreeRange readRange(const Node& node, const NumberRange& angles, double widest) {
  const char* what = "two angles in degrees, the lower one first";
  const std::vector<Node> ends = node.list(what);
  if (ends.size() != 2) {
    node.failExpected(what);
  }
  const DegreeRange range{ends[0].number(angles), ends[1].number(angles)};
  if (!(range.from < range.to)) {
    node.fail(fmt::format("from {} to {} degrees is empty; the second angle must be the larger", range.from, range.to));
  }
  if (range.to - range.from > widest) {
    node.fail(fmt::format("from {} to {} degrees is more than a full turn", range.from, range.to));
  }
  return range;
}

void readSequence(const Node& node, Source& source) {
  const Node sequence = node["sequence"];
  if (sequence.present()) {
    source.sequence = sequence.choice(sequenceWords);
  }
  const bool random = source.sequence == Sequence::random;
  if (!random && source.type == SourceType::list) {
    sequence.fail("shots of a list are as the file has them; remove it");
  }
  if (!random && source.type == SourceType::point && source.sampler == Sampler::thesis) {
    sequence.fail("the thesis' sampler takes random numbers; remove it or choose another sampler");
  }
  if (source.sequence == Sequence::grid && source.type != SourceType::parallel) {
    sequence.fail("a grid belongs to the type \"parallel\"; choose \"random\" or \"sobol\"");
  }
  if (source.sequence == Sequence::grid) {
    source.cell = node["cell_mm"].number({0.01, 10000.0, true, "a size in mm from 0.01 to 10000"}) / 1000.0;
    refuse(node, {"shots"}, "sources without a grid: the size of the cells decides their number");
  } else {
    refuse(node, {"cell_mm"}, "the sequence \"grid\"");
  }
}

}  // namespace

Source readSource(const Node& node) {
  node.checkObject("a source of shots", sourceKeys);
  Source source;
  source.name = node["name"].name("a name");
  source.description = readDescription(node);
  if (const Node type = node["type"]; type.present()) {
    source.type = type.choice(sourceTypeWords);
  }
  if (source.type == SourceType::point) {
    readPoint(node, source);
  } else {
    refuse(node, {"position", "sampler", "width_m", "height_m", "radius_m"}, "the type \"point\"");
  }
  if (source.type == SourceType::parallel) {
    source.azimuth.from = node["azimuth_deg"].number(azimuths);
    source.elevation.from = node["elevation_deg"].number(elevations);
  } else if (source.type == SourceType::band) {
    source.azimuth = readRange(node["azimuth_deg"], azimuths, 360.0);
    source.elevation = readRange(node["elevation_deg"], elevations, 180.0);
  } else {
    refuse(node, {"azimuth_deg", "elevation_deg"}, "the types \"parallel\" and \"band\"");
  }
  if (source.type == SourceType::list) {
    source.list.path = node["file"].name("a path");
    if (const Node digits = node["sha256"]; digits.present()) {
      source.list.sha256 = sha256Text(digits);
    }
    refuse(node, {"target", "target_structure", "shots"}, "sources that make their own shots");
  } else {
    refuse(node, {"file", "sha256"}, "the type \"list\"");
    readTarget(node, source);
  }
  readSequence(node, source);
  if (const Node shots = node["shots"]; shots.present()) {
    source.shots = shots.whole(1, 1'000'000'000'000ULL);
  }
  return source;
}

}  // namespace lorica::study
