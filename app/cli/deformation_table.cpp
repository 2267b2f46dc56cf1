#include "deformation_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lorica::cli {

namespace {

struct Sums {
  double volume = 0.0;
  double outside = 0.0;  ///< m3
  bool skinCloses = false;
  double protrusion = 0.0;
  std::string deepest;
  double overlap = 0.0;
  double gap = 0.0;  ///< m times m2
  double contact = 0.0;
  double change = 0.0;  ///< of the organ whose volume changed most
  std::string changed;
  std::size_t inverted = 0;
};

Sums sumsOf(const analysis::DeformationTables& tables, const analysis::ModelDeformation& row) {
  Sums sums;
  for (std::size_t o = 0; o < row.audit.organs.size(); ++o) {
    const viscera::OrganAudit& organ = row.audit.organs[o];
    sums.inverted += row.lattices[o].inverted;
    sums.skinCloses = sums.skinCloses || organ.protrusion.has_value();
    if (organ.protrusion.value_or(0.0) > sums.protrusion) {
      sums.protrusion = *organ.protrusion;
      sums.deepest = tables.organs[o];
    }
    if (organ.volume) {
      sums.volume += *organ.volume;
      sums.outside += organ.outsideShare ? organ.outsideShare->value * *organ.volume : 0.0;
      if (std::abs(*organ.volumeChange) > std::abs(sums.change)) {
        sums.change = *organ.volumeChange;
        sums.changed = tables.organs[o];
      }
    }
  }
  for (const viscera::ContactAudit& contact : row.audit.contacts) {
    sums.overlap += contact.overlapBeyondRest.value_or(0.0);
    sums.gap += contact.gap ? contact.gap->mean * contact.gap->area : 0.0;
    sums.contact += contact.gap ? contact.gap->area : 0.0;
  }
  return sums;
}

std::string line(const analysis::DeformationTables& tables, const analysis::ModelDeformation& row) {
  const Sums sums = sumsOf(tables, row);
  const std::string outside =
      sums.skinCloses && sums.volume > 0.0 ? fmt::format("{:.2f}", 100.0 * sums.outside / sums.volume) : "-";
  const std::string protrusion = sums.skinCloses ? fmt::format("{:.1f}", 1e3 * sums.protrusion) : "-";
  const std::string overlap = sums.volume > 0.0 ? fmt::format("{:.1f}", 1e6 * sums.overlap) : "-";
  const std::string gap = sums.contact > 0.0 ? fmt::format("{:.2f}", 1e3 * sums.gap / sums.contact) : "-";
  const std::string change = std::abs(sums.change) >= 5e-4
                                 ? fmt::format("{:+.1f} {}", 100.0 * sums.change, sums.changed)
                             : sums.volume > 0.0 ? "0.0"
                                                 : "-";
  std::string text =
      fmt::format("  {:<15} {:>9} {:>8} {:<16} {:>9} {:>7} {:>6}  {}", viscera::name(tables.models[row.model]), outside,
                  protrusion, sums.deepest, overlap, gap, sums.inverted, change);
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

}  // namespace

std::string deformationTable(const analysis::DeformationTables& tables) {
  if (tables.organs.empty() || tables.rows.empty()) {
    return {};
  }
  std::string text = fmt::format("\n{:<17} {:>9} {:>8} {:<16} {:>9} {:>7} {:>6}  {}\n", "all organs", "outside %",
                                 "prot. mm", "of", "over. cm3", "gap mm", "invert", "volume change %");
  for (std::size_t p = 0; p < tables.poses.size(); ++p) {
    const bool reached = std::any_of(tables.rows.begin(), tables.rows.end(),
                                     [&](const analysis::ModelDeformation& row) { return row.pose == p; });
    if (!reached) {
      continue;
    }
    text += tables.poses[p];
    if (tables.restRoom && p < tables.rooms.size() && tables.rooms[p]) {
      text += fmt::format(": {:.2f} l inside the skin ({:+.2f} %)", 1e3 * tables.rooms[p]->whole,
                          100.0 * (tables.rooms[p]->whole / tables.restRoom->whole - 1.0));
      if (tables.restRoom->torso > 0.0) {
        text += fmt::format(", {:.2f} l in the torso ({:+.2f} %)", 1e3 * tables.rooms[p]->torso,
                            100.0 * (tables.rooms[p]->torso / tables.restRoom->torso - 1.0));
      }
    }
    text += "\n";
    for (const analysis::ModelDeformation& row : tables.rows) {
      text += row.pose == p ? line(tables, row) : std::string();
    }
  }
  return text +
         "\noutside: share of the organs' volume outside the skin; prot.: depth of their deepest vertex there. "
         "over.: overlap of\norgans beyond that at rest. gap: mean distance opened between surfaces that touch at "
         "rest. invert: lattice cells turned\ninside out. volume change: of the organ that changed most.\n";
}

}  // namespace lorica::cli
