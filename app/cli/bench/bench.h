#pragma once

/// \file
/// Lorica against bare libraries on the same work, in one run, as ratios: numbers that mean the same on every machine.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lorica/base/progress.h"

namespace lorica::bench {

struct Ratio {
  std::string name;
  double value = 0.0;
  std::optional<double> bar;  ///< none: for comparison only
  bool atLeast = true;        ///< the value should reach the bar; else it should stay under it
  std::string meaning;
};

struct Report {
  std::vector<Ratio> ratios;
  std::vector<std::pair<std::string, double>> rates;  ///< rays per second, milliseconds, for orientation
  std::vector<std::string> notes;                     ///< what was left out, and why
  std::uint64_t triangles = 0;
  std::uint64_t rays = 0;
  int threads = 0;
};

/// Takes about half a minute. \throw base::Cancelled
Report measure(const base::Progress& progress);

}  // namespace lorica::bench
