#include "lorica/analysis/compare_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/table.h"
#include "lorica/io/export.h"
#include "lorica/stats/accumulators.h"
#include "lorica/stats/tests.h"
#include "lorica/study/provenance.h"
#include "lorica/study/reserved_names.h"
#include "probability.h"

namespace lorica::analysis {

namespace {

namespace fs = std::filesystem;

/// source, system, model, pose, structure, kind.
using Key = std::array<std::string, 6>;
constexpr std::array<const char*, 6> keyColumns{"source", "system", "model", "pose", "structure", "kind"};
constexpr std::size_t systemColumn = 1;
constexpr std::size_t poseColumn = 3;

/// Counts of one trial.
struct TrialValues {
  std::uint64_t shots = 0;
  std::uint64_t any = 0;
  std::uint64_t guarded = 0;
};

/// What a measure is the share of, in one trial.
struct Share {
  std::uint64_t hits = 0;
  std::uint64_t of = 0;
};

struct Measure {
  const char* name;
  double scale;
  Share (*share)(const TrialValues&);

  std::optional<double> operator()(const TrialValues& values) const {
    const Share part = share(values);
    return part.of == 0 ? std::nullopt
                        : std::optional(scale * static_cast<double>(part.hits) / static_cast<double>(part.of));
  }
};

constexpr std::array<Measure, 2> measures{{
    {"pct_of_shots", 100.0,
     [](const TrialValues& values) {
       return Share{values.any, values.shots};
     }},
    {"coverage", 1.0,
     [](const TrialValues& values) {
       return Share{values.guarded, values.any};
     }},
}};

struct Basis {
  std::string what;
  std::string unit;
  double total = 0.0;
};

/// The trials of a run.
struct RunTable {
  std::string file;
  std::uint64_t seed = 0;
  bool partial = false;
  std::vector<Key> order;
  std::map<Key, std::map<std::uint64_t, TrialValues>> trials;
  std::map<std::string, Basis> bases;  ///< by source
};

/// Reads rows of trials.csv and checks their numbers.
class TrialReader {
 public:
  explicit TrialReader(const fs::path& file)
      : file_(file.string()), text_(base::readFile(file)), table_(text_, file_) {}

  RunTable read() {
    RunTable run;
    run.file = file_;
    for (row_ = 0; row_ < table_.rows(); ++row_) {
      Key key;
      for (std::size_t c = 0; c < key.size(); ++c) {
        key.at(c) = table_.text(row_, keyColumns.at(c));
      }
      const std::uint64_t trial = whole("trial", 1);
      const std::uint64_t shots = whole("shots", 1);
      const std::uint64_t any = atMost("any_hit", shots, "shots");
      const std::uint64_t guarded = atMost("protected_hit", any, "any_hit");
      const TrialValues values{shots, any, guarded};
      auto [place, fresh] = run.trials.try_emplace(key);
      if (fresh) {
        run.order.push_back(key);
      }
      if (!place->second.emplace(trial, values).second) {
        fail(fmt::format("trial {} of \"{}\" stands there twice", trial, key[4]));
      }
      takeBasis(run, key[0]);
    }
    if (run.order.empty()) {
      throw base::InputError(file_, "", "holds no trial; run the study again");
    }
    return run;
  }

 private:
  [[noreturn]] void fail(const std::string& text) const {
    throw base::InputError(file_, fmt::format("line {}", row_ + 2), text);
  }
  std::uint64_t whole(const char* column, std::uint64_t least) const {
    const double value = table_.number(row_, column);
    constexpr double most = 0x1p53;
    if (value != std::floor(value) || value < static_cast<double>(least) || value > most) {
      fail(fmt::format("expected a whole number from {} in column '{}', found '{}'", least, column,
                       table_.text(row_, column)));
    }
    return static_cast<std::uint64_t>(value);
  }
  std::uint64_t atMost(const char* column, std::uint64_t limit, const char* limitColumn) const {
    const std::uint64_t value = whole(column, 0);
    if (value > limit) {
      fail(fmt::format("'{}' is {}, more than '{}', which is {}", column, value, limitColumn, limit));
    }
    return value;
  }
  void takeBasis(RunTable& run, const std::string& source) const {
    Basis basis{table_.text(row_, "basis"), table_.text(row_, "unit"), 0.0};
    if (!basis.unit.empty()) {
      basis.total = table_.number(row_, "basis_total");
    }
    const Basis& known = run.bases.try_emplace(source, basis).first->second;
    if (known.what != basis.what || known.unit != basis.unit || known.total != basis.total) {
      fail(fmt::format("source \"{}\" has another basis here than in the lines before", source));
    }
  }

  std::string file_;
  std::string text_;
  base::Table table_;
  std::size_t row_ = 0;
};

RunTable readRun(const fs::path& folder) {
  const study::RunOrigin origin = study::originOfRun(folder / "provenance.json");
  RunTable run = TrialReader(folder / "trials.csv").read();
  run.seed = origin.seed;
  run.partial = origin.partial;
  return run;
}

/// Shares of different solid angles or areas cannot be compared.
void checkBases(const RunTable& first, const RunTable& second) {
  constexpr double rounding = 1e-6;
  for (const auto& [source, basis] : first.bases) {
    const auto found = second.bases.find(source);
    if (found == second.bases.end()) {
      continue;
    }
    const Basis& other = found->second;
    if (basis.what != other.what || basis.unit != other.unit ||
        std::abs(basis.total - other.total) > rounding * std::max(basis.total, other.total)) {
      throw base::InputError(
          second.file, "",
          fmt::format("source \"{}\" has a basis of {} {} {}, in {} one of {} {} {}; run both with the same poses and "
                      "the same source",
                      source, other.what, other.total, other.unit, first.file, basis.what, basis.total, basis.unit));
    }
  }
}

std::set<std::string> valuesOf(const RunTable& run, std::size_t column) {
  std::set<std::string> values;
  for (const Key& key : run.order) {
    if (column != systemColumn || key.at(column) != study::unarmored) {
      values.insert(key.at(column));
    }
  }
  return values;
}

/// The key in the second run that a key of the first stands for.
class Matching {
 public:
  Matching(const RunTable& first, const RunTable& second) {
    for (std::size_t column = systemColumn; column <= poseColumn; ++column) {
      const auto mine = valuesOf(first, column);
      const auto theirs = valuesOf(second, column);
      if (mine.size() == 1 && theirs.size() == 1) {
        instead_.at(column) = {*mine.begin(), *theirs.begin()};
      }
    }
  }
  Key operator()(Key key) const {
    for (std::size_t column = systemColumn; column <= poseColumn; ++column) {
      if (key.at(column) == instead_.at(column).first) {
        key.at(column) = instead_.at(column).second;
      }
    }
    return key;
  }

 private:
  std::array<std::pair<std::string, std::string>, 6> instead_;
};

/// Values of the trials of one structure in both runs; of paired runs those of common trials.
struct Samples {
  std::vector<double> first;
  std::vector<double> second;
  Share sumFirst;
  Share sumSecond;
};

Samples samplesOf(const std::map<std::uint64_t, TrialValues>& first, const std::map<std::uint64_t, TrialValues>& second,
                  bool paired, const Measure& value) {
  Samples samples;
  const auto take = [&](const TrialValues& trial, std::vector<double>& values, Share& sum) {
    const Share part = value.share(trial);
    values.push_back(*value(trial));
    sum.hits += part.hits;
    sum.of += part.of;
  };
  for (const auto& [trial, values] : first) {
    const auto other = second.find(trial);
    const std::optional<double> mine = value(values);
    const std::optional<double> theirs = other == second.end() ? std::nullopt : value(other->second);
    if (mine && (!paired || theirs)) {
      take(values, samples.first, samples.sumFirst);
    }
    if (paired && mine && theirs) {
      take(other->second, samples.second, samples.sumSecond);
    }
  }
  for (const auto& [trial, values] : second) {
    if (!paired && value(values)) {
      take(values, samples.second, samples.sumSecond);
    }
  }
  return samples;
}

stats::Moments momentsOf(std::span<const double> values) {
  stats::Moments moments;
  for (const double value : values) {
    moments.add(value);
  }
  return moments;
}

void test(RunComparison& row, const Samples& samples, bool paired) {
  const stats::Moments first = momentsOf(samples.first);
  const stats::Moments second = momentsOf(samples.second);
  row.trialsFirst = samples.first.size();
  row.trialsSecond = samples.second.size();
  row.hitsFirst = samples.sumFirst.hits;
  row.ofFirst = samples.sumFirst.of;
  row.hitsSecond = samples.sumSecond.hits;
  row.ofSecond = samples.sumSecond.of;
  row.meanFirst = first.mean();
  row.meanSecond = second.mean();
  row.difference = row.meanFirst - row.meanSecond;
  row.test = paired ? "paired" : "welch";
  const auto result =
      paired ? stats::pairedT(samples.first, samples.second) : stats::welch(samples.first, samples.second);
  if (!result) {
    return;
  }
  row.t = result->statistic;
  row.degreesOfFreedom = result->degreesOfFreedom;
  row.p = result->pValue;
  double error = std::sqrt(first.variance() / static_cast<double>(first.count()) +
                           second.variance() / static_cast<double>(second.count()));
  if (paired) {
    stats::Moments differences;
    for (std::size_t i = 0; i < samples.first.size(); ++i) {
      differences.add(samples.first[i] - samples.second[i]);
    }
    error = differences.standardDeviation() / std::sqrt(static_cast<double>(differences.count()));
  }
  const double reach = stats::studentQuantile(0.975, result->degreesOfFreedom) * error;
  row.interval = stats::Interval{row.difference - reach, row.difference + reach};
}

/// Adjusts the p-values of the structures of one family.
void adjust(std::vector<RunComparison>& rows) {
  std::map<std::array<std::string, 5>, std::vector<std::size_t>> families;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].p) {
      families[{rows[i].source, rows[i].systemFirst, rows[i].modelFirst, rows[i].poseFirst, rows[i].measure}].push_back(
          i);
    }
  }
  for (const auto& [family, members] : families) {
    std::vector<double> p;
    for (const std::size_t member : members) {
      p.push_back(*rows[member].p);
    }
    const std::vector<double> adjusted = stats::holm(p);
    for (std::size_t i = 0; i < members.size(); ++i) {
      rows[members[i]].pHolm = adjusted[i];
    }
  }
}

}  // namespace

RunComparisons compareRuns(const fs::path& first, const fs::path& second) {
  std::error_code ignored;
  if (fs::equivalent(first, second, ignored)) {
    throw base::InputError(second.string(), "", "is the folder of both runs; name two");
  }
  const RunTable a = readRun(first);
  const RunTable b = readRun(second);
  checkBases(a, b);
  RunComparisons result;
  result.paired = a.seed == b.seed;
  result.partialFirst = a.partial;
  result.partialSecond = b.partial;
  const Matching matching(a, b);
  std::size_t matched = 0;
  for (const Key& key : a.order) {
    const Key other = matching(key);
    const auto found = b.trials.find(other);
    if (found == b.trials.end()) {
      continue;
    }
    ++matched;
    for (const Measure& measure : measures) {
      const Samples samples = samplesOf(a.trials.at(key), found->second, result.paired, measure);
      if (samples.first.size() < 2 || samples.second.size() < 2) {
        continue;
      }
      RunComparison row;
      row.source = key[0];
      row.systemFirst = key[1];
      row.systemSecond = other[1];
      row.modelFirst = key[2];
      row.modelSecond = other[2];
      row.poseFirst = key[3];
      row.poseSecond = other[3];
      row.structure = key[4];
      row.kind = key[5];
      row.measure = measure.name;
      test(row, samples, result.paired);
      result.rows.push_back(std::move(row));
    }
  }
  result.unmatched = a.order.size() + b.order.size() - 2 * matched;
  if (result.rows.empty()) {
    throw base::InputError(
        b.file, "",
        fmt::format("has no source, system, model, pose and structure in common with {} that has two "
                    "trials in both; run both from sources of the same name, with two trials or more",
                    a.file));
  }
  adjust(result.rows);
  return result;
}

std::string runComparisonsCsv(const RunComparisons& comparisons) {
  std::string text =
      "source,system_first,system_second,model_first,model_second,pose_first,pose_second,structure,kind,measure,"
      "trials_first,trials_second,mean_first,mean_second,difference,difference_lo,difference_hi,test,t,"
      "degrees_of_freedom,p,p_holm,hits_first,of_first,hits_second,of_second\n";
  for (const RunComparison& row : comparisons.rows) {
    text += io::csvRow(std::array{row.source,
                                  row.systemFirst,
                                  row.systemSecond,
                                  row.modelFirst,
                                  row.modelSecond,
                                  row.poseFirst,
                                  row.poseSecond,
                                  row.structure,
                                  row.kind,
                                  row.measure,
                                  std::to_string(row.trialsFirst),
                                  std::to_string(row.trialsSecond),
                                  io::csvNumber(row.meanFirst),
                                  io::csvNumber(row.meanSecond),
                                  io::csvNumber(row.difference),
                                  row.interval ? io::csvNumber(row.interval->low) : std::string(),
                                  row.interval ? io::csvNumber(row.interval->high) : std::string(),
                                  row.test,
                                  io::csvNumber(row.t),
                                  io::csvNumber(row.degreesOfFreedom),
                                  probability(row.p),
                                  probability(row.pHolm),
                                  std::to_string(row.hitsFirst),
                                  std::to_string(row.ofFirst),
                                  std::to_string(row.hitsSecond),
                                  std::to_string(row.ofSecond)});
  }
  return comparisons.partialFirst || comparisons.partialSecond ? markedPartial(text) : text;
}

}  // namespace lorica::analysis
