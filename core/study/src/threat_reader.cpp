#include "json_text.h"
#include "section_readers.h"
#include "study_words.h"

namespace lorica::study {

namespace {

constexpr NumberRange anyNumber{-1e30, 1e30, true, "a number of size up to 1e30"};

/// Fails at keys that say nothing here.
void refuse(const Node& node, std::initializer_list<const char*> keys, const char* owner) {
  for (const char* key : keys) {
    if (node[key].present()) {
      node[key].fail(fmt::format("belongs to {}; remove it here", owner));
    }
  }
}

BlastCharge readCharge(const Node& node) {
  if (node["builtin"].name("the name of something built in") != blastBuiltin) {
    node["builtin"].failExpected(inQuotes(blastBuiltin));
  }
  BlastCharge charge;
  charge.tntKilograms = node["tnt_kg"].number({0.0, 1e6, false, "kilograms of TNT above 0, up to 1000000"});
  charge.position = node["position"].vector("metres");
  return charge;
}

void readFileKeys(const Node& node, Threat& threat) {
  threat.from = readInputFile(node);
  if (const Node units = node["time_units"]; units.present()) {
    threat.timeUnits = units.choice(timeUnitWords);
  }
  if (const Node attribute = node["attribute"]; attribute.present()) {
    threat.attribute = attribute.name("the name of an attribute");
  }
  if (const Node reach = node["reach_mm"]; reach.present()) {
    threat.reach = reach.number({0.001, 1e6, true, "a distance in mm from 0.001 to 1000000"}) / 1000.0;
  }
  if (const Node offset = node["offset"]; offset.present()) {
    threat.offset = offset.vector("metres");
  }
  if (const Node turn = node["turn_deg"]; turn.present()) {
    threat.turn = turn.vector("degrees about x, y and z");
  }
}

ThreatDisplay readThreatDisplay(const Node& node) {
  node.checkObject("how threat data are drawn", threatDisplayKeys);
  ThreatDisplay display;
  if (const Node visible = node["visible"]; visible.present()) {
    display.visible = visible.boolean();
  }
  if (const Node range = node["range"]; range.present()) {
    const char* what = "two numbers, the lower one first";
    const std::vector<Node> ends = range.list(what);
    if (ends.size() != 2) {
      range.failExpected(what);
    }
    display.range = {ends[0].number(anyNumber), ends[1].number(anyNumber)};
    if (!((*display.range)[0] < (*display.range)[1])) {
      range.fail("is empty; the second number must be the larger");
    }
  }
  return display;
}

}  // namespace

Threat readThreat(const Node& node) {
  node.checkObject("threat data", threatKeys);
  Threat threat;
  threat.name = node["name"].name("a name");
  threat.description = readDescription(node);
  if (node["file"].present() == node["builtin"].present()) {
    node.fail(node["file"].present() ? "expected either \"file\" or \"builtin\", found both"
                                     : "expected \"file\" (a path) or \"builtin\" (a name), found neither");
  }
  if (node["builtin"].present()) {
    refuse(node, {"sha256", "units", "up", "time_units", "attribute", "reach_mm", "offset", "turn_deg"}, "a \"file\"");
    threat.from = readCharge(node);
  } else {
    refuse(node, {"tnt_kg", "position"}, "the builtin \"blast\"");
    readFileKeys(node, threat);
  }
  if (const Node threshold = node["threshold"]; threshold.present()) {
    threat.threshold = threshold.number(anyNumber);
  }
  if (const Node offset = node["time_offset_ms"]; offset.present()) {
    threat.timeOffset = offset.number({-1e9, 1e9, true, "milliseconds of size up to 1e9"}) / 1000.0;
  }
  if (const Node display = node["display"]; display.present()) {
    threat.display = readThreatDisplay(display);
  }
  return threat;
}

}  // namespace lorica::study
