#pragma once

/// \file
/// How names and numbers of a run read in a report.

#include <QString>
#include <optional>
#include <span>
#include <string>

#include "lorica/analysis/run_tables.h"

namespace lorica::report {

inline QString text(const std::string& bytes) {
  return QString::fromStdString(bytes);
}

/// As the window names the model.
QString modelLabel(const std::string& model);
/// "Essential organs", "All organs", "Body" or the structure's own name.
QString structureLabel(const std::string& structure, const std::string& kind);

/// A share from 0 to 1 in per cent: "62.1"; a dash for none.
QString percent(std::optional<double> share);
/// "61.2–63.0", per cent; empty for none.
QString range(const analysis::Coverage& coverage);
/// "62.1 % (61.2–63.0)"
QString percentWithRange(const analysis::Coverage& coverage);
/// Percentage points with their sign: "+3.4"; a dash for none.
QString points(std::optional<double> difference);
/// A number with so many decimals, a proper minus and no "-0"; a dash for none.
QString number(std::optional<double> value, int decimals, bool sign = false);
/// "0.012", "< 0.001".
QString probability(std::optional<double> p);
/// "full_torso, plate_carrier and 3 more"
QString listed(std::span<const std::string> names, std::size_t most = 6);
/// The first digits of a hash.
QString shortHash(const std::string& hash);

}  // namespace lorica::report
