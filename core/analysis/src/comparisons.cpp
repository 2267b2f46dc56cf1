#include "lorica/analysis/comparisons.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/io/export.h"
#include "lorica/stats/accumulators.h"
#include "lorica/stats/tests.h"
#include "probability.h"

namespace lorica::analysis {

using shotline::Count;
using shotline::Tally;

namespace {

std::optional<double> coverageOf(const Count& count) {
  return count.any == 0 ? std::nullopt
                        : std::optional(static_cast<double>(count.shielded) / static_cast<double>(count.any));
}

/// Body or an organ, as a target of comparisons.
struct Target {
  std::string name;
  std::optional<std::size_t> organ;  ///< none: the body

  Count in(const Tally& tally, std::size_t model, std::size_t system) const {
    return organ ? tally.organ(*organ, model, system) : tally.body(system);
  }
  std::size_t pairTarget(const shotline::PairTally& pairs, std::size_t model) const {
    return organ ? pairs.organTarget(*organ, model) : shotline::PairTally::bodyTarget();
  }
};

std::vector<Target> targetsOf(const LoadedStudy& study, bool withBody) {
  std::vector<Target> targets;
  if (withBody) {
    targets.push_back({"body", std::nullopt});
  }
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    targets.push_back({study.organs[o]->name, o});
  }
  return targets;
}

Tally sumOf(const SourcePoseResult& here) {
  Tally sum;
  for (const Tally& trial : here.trials) {
    sum.add(trial);
  }
  return sum;
}

/// Coverage in each trial that has one in both.
template <class First, class Second>
void comparePaired(Comparison& row, const SourcePoseResult& here, const First& first, const Second& second) {
  std::vector<double> a;
  std::vector<double> b;
  stats::Moments differences;
  for (const Tally& trial : here.trials) {
    const auto coverageA = coverageOf(first(trial));
    const auto coverageB = coverageOf(second(trial));
    if (coverageA && coverageB) {
      a.push_back(*coverageA);
      b.push_back(*coverageB);
      differences.add(*coverageA - *coverageB);
    }
  }
  row.trials = a.size();
  if (row.trials > 0) {
    row.difference = differences.mean();
  }
  if (row.trials < 2) {
    return;
  }
  const double n = static_cast<double>(row.trials);
  const double reach = stats::studentQuantile(0.975, n - 1.0) * differences.standardDeviation() / std::sqrt(n);
  row.interval = stats::Interval{differences.mean() - reach, differences.mean() + reach};
  if (const auto test = stats::pairedT(a, b)) {
    row.t = test->statistic;
    row.pairedP = test->pValue;
  }
}

/// Adjusts the p-values of the structures of one comparison.
void adjust(std::span<Comparison> rows) {
  std::vector<double> exact;
  std::vector<double> paired;
  for (const Comparison& row : rows) {
    if (row.mcNemarP) {
      exact.push_back(*row.mcNemarP);
    }
    if (row.pairedP) {
      paired.push_back(*row.pairedP);
    }
  }
  exact = stats::holm(exact);
  paired = stats::holm(paired);
  std::size_t nextExact = 0;
  std::size_t nextPaired = 0;
  for (Comparison& row : rows) {
    if (row.mcNemarP) {
      row.mcNemarHolm = exact[nextExact++];
    }
    if (row.pairedP) {
      row.pairedHolm = paired[nextPaired++];
    }
  }
}

/// Where two things are compared.
struct Place {
  const LoadedStudy& study;
  const RunResult& result;
  const SourcePoseResult& here;
  const Tally sum;

  /// McNemar's test of the shots that only one of two has.
  void testExactly(Comparison& row) const {
    if (shotline::independentShots(result.sources[here.source].source)) {
      row.mcNemarP = stats::mcNemar(row.onlyFirst, row.onlySecond).exactP;
    }
  }
  Comparison head(const char* what, const std::string& held) const {
    Comparison row;
    row.what = what;
    row.source = result.sources[here.source].source.name;
    row.pose = result.poses[here.pose];
    row.held = held;
    return row;
  }
};

void compareSystems(const Place& place, std::size_t model, std::size_t a, std::size_t b,
                    std::vector<Comparison>& rows) {
  const std::size_t begin = rows.size();
  for (const Target& target : targetsOf(place.study, true)) {
    Comparison row = place.head("system", viscera::name(place.result.models[model]));
    row.first = place.result.systems[a];
    row.second = place.result.systems[b];
    row.structure = target.name;
    row.shots = place.sum.shots();
    row.countFirst = target.in(place.sum, model, a);
    row.countSecond = target.in(place.sum, model, b);
    row.coverageFirst = coverageOf(row.countFirst);
    row.coverageSecond = coverageOf(row.countSecond);
    const std::size_t pair = target.pairTarget(place.here.pairs, model);
    row.onlyFirst = place.here.pairs.onlyProtected(pair, a, b);
    row.onlySecond = place.here.pairs.onlyProtected(pair, b, a);
    place.testExactly(row);
    comparePaired(
        row, place.here, [&](const Tally& t) { return target.in(t, model, a); },
        [&](const Tally& t) { return target.in(t, model, b); });
    rows.push_back(std::move(row));
  }
  adjust(std::span(rows).subspan(begin));
}

void compareModels(const Place& place, std::size_t system, std::size_t a, std::size_t b,
                   std::vector<Comparison>& rows) {
  const std::size_t begin = rows.size();
  for (const Target& target : targetsOf(place.study, false)) {
    Comparison row = place.head("model", place.result.systems[system]);
    row.first = viscera::name(place.result.models[a]);
    row.second = viscera::name(place.result.models[b]);
    row.structure = target.name;
    row.shots = place.sum.shots();
    row.countFirst = target.in(place.sum, a, system);
    row.countSecond = target.in(place.sum, b, system);
    row.coverageFirst = coverageOf(row.countFirst);
    row.coverageSecond = coverageOf(row.countSecond);
    row.onlyFirst = place.here.pairs.onlyHit(*target.organ, a, b);
    row.onlySecond = place.here.pairs.onlyHit(*target.organ, b, a);
    place.testExactly(row);
    comparePaired(
        row, place.here, [&](const Tally& t) { return target.in(t, a, system); },
        [&](const Tally& t) { return target.in(t, b, system); });
    rows.push_back(std::move(row));
  }
  adjust(std::span(rows).subspan(begin));
}

/// Calls `use(a, b)` for every pair a < b of `count` things.
template <class Use>
void forEachPair(std::size_t count, const Use& use) {
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      use(a, b);
    }
  }
}

}  // namespace

std::vector<Comparison> comparisons(const LoadedStudy& study, const RunResult& result) {
  std::vector<Comparison> rows;
  for (const SourcePoseResult& here : result.results) {
    if (here.trials.empty()) {
      continue;
    }
    const Place place{study, result, here, sumOf(here)};
    for (std::size_t model = 0; model < result.models.size(); ++model) {
      forEachPair(result.systems.size(),
                  [&](std::size_t a, std::size_t b) { compareSystems(place, model, a, b, rows); });
    }
    for (std::size_t system = 0; system < result.systems.size(); ++system) {
      forEachPair(result.models.size(),
                  [&](std::size_t a, std::size_t b) { compareModels(place, system, a, b, rows); });
    }
  }
  return rows;
}

std::string comparisonsCsv(const std::vector<Comparison>& rows) {
  std::string text =
      "comparison,source,pose,model_or_system,first,second,structure,coverage_first,coverage_second,only_first,"
      "only_second,mcnemar_p,mcnemar_p_holm,trials,difference,difference_lo,difference_hi,paired_t,paired_p,"
      "paired_p_holm,shots,any_hit_first,protected_hit_first,any_hit_second,protected_hit_second\n";
  for (const Comparison& row : rows) {
    const auto end = [&](double stats::Interval::*which) {
      return row.interval ? io::csvNumber((*row.interval).*which) : std::string();
    };
    text += io::csvRow(std::array{row.what,
                                  row.source,
                                  row.pose,
                                  row.held,
                                  row.first,
                                  row.second,
                                  row.structure,
                                  io::csvNumber(row.coverageFirst),
                                  io::csvNumber(row.coverageSecond),
                                  std::to_string(row.onlyFirst),
                                  std::to_string(row.onlySecond),
                                  probability(row.mcNemarP),
                                  probability(row.mcNemarHolm),
                                  std::to_string(row.trials),
                                  io::csvNumber(row.difference),
                                  end(&stats::Interval::low),
                                  end(&stats::Interval::high),
                                  io::csvNumber(row.t),
                                  probability(row.pairedP),
                                  probability(row.pairedHolm),
                                  std::to_string(row.shots),
                                  std::to_string(row.countFirst.any),
                                  std::to_string(row.countFirst.shielded),
                                  std::to_string(row.countSecond.any),
                                  std::to_string(row.countSecond.shielded)});
  }
  return text;
}

std::string piecesCsv(const LoadedStudy& study, const RunResult& result) {
  std::string text =
      "source,pose,model,system,piece,structure,any_hit,protected_hit,protected_by_it_alone,coverage,coverage_without,"
      "share_of_coverage,shots\n";
  for (const SourcePoseResult& here : result.results) {
    const Tally sum = sumOf(here);
    for (std::size_t model = 0; !here.trials.empty() && model < result.models.size(); ++model) {
      for (std::size_t piece = 0; piece < study.pieces.size(); ++piece) {
        const std::size_t system = study.systemOfPiece[piece] + 1;
        for (const Target& target : targetsOf(study, true)) {
          const Count count = target.in(sum, model, system);
          const std::uint64_t alone = here.pairs.soleGuard(target.pairTarget(here.pairs, model), piece);
          Count without = count;
          without.shielded -= alone;
          const std::string share =
              count.shielded == 0 ? ""
                                  : io::csvNumber(static_cast<double>(alone) / static_cast<double>(count.shielded));
          text += io::csvRow(std::array{result.sources[here.source].source.name, result.poses[here.pose],
                                        std::string(viscera::name(result.models[model])), result.systems[system],
                                        study.pieces[piece]->name, target.name, std::to_string(count.any),
                                        std::to_string(count.shielded), std::to_string(alone),
                                        io::csvNumber(coverageOf(count)), io::csvNumber(coverageOf(without)), share,
                                        std::to_string(sum.shots())});
        }
      }
    }
  }
  return text;
}

std::string convergenceCsv(const LoadedStudy& study, const RunResult& result) {
  std::string text =
      "source,system,model,pose,structure,kind,trials,shots,coverage,coverage_lo,coverage_hi,any_hit,protected_hit\n";
  for (std::size_t s = 0; s < result.results.size(); ++s) {
    RunResult part;
    part.sources = result.sources;
    part.poses = result.poses;
    part.models = result.models;
    part.systems = result.systems;
    part.results = result.results;
    for (SourcePoseResult& other : part.results) {
      other.trials.clear();
    }
    for (std::size_t trials = 1; trials <= result.results[s].trials.size(); ++trials) {
      const auto& all = result.results[s].trials;
      part.results[s].trials.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(trials));
      for (const ResultRow& row : summaryRows(study, part)) {
        if (row.kind != "organ" && row.kind != "class" && row.structure != "body") {
          continue;
        }
        const auto interval = row.coverageInterval();
        text += io::csvRow(std::array{row.source, row.system, row.model, row.pose, row.structure, row.kind,
                                      std::to_string(trials), std::to_string(row.shots), io::csvNumber(row.coverage()),
                                      interval ? io::csvNumber(interval->low) : std::string(),
                                      interval ? io::csvNumber(interval->high) : std::string(),
                                      std::to_string(row.count.any), std::to_string(row.count.shielded)});
      }
    }
  }
  return text;
}

std::string systemsCsv(const LoadedStudy& study, const RunResult& result) {
  struct Sum {
    double area = 0.0;
    std::optional<double> mass = 0.0;
  };
  std::vector<Sum> sums(result.systems.size());
  std::size_t index = 0;
  for (std::size_t s = 0; s < study.study.systems.size(); ++s) {
    for (const study::ArmorPiece& piece : study.study.systems[s].pieces) {
      // Of a closed shell one face is half of the surface.
      const geometry::TriangleMesh& mesh = study.pieces[index++]->rig.rest;
      const double area = 0.5 * geometry::area(mesh);
      Sum& sum = sums[s + 1];
      sum.area += area;
      sum.mass = sum.mass && piece.arealDensity ? std::optional(*sum.mass + area * *piece.arealDensity) : std::nullopt;
    }
  }
  std::string text =
      "source,system,model,pose,pieces_area_m2,mass_kg,structure,kind,coverage,coverage_lo,coverage_hi,shots,"
      "any_hit,protected_hit\n";
  for (const ResultRow& row : summaryRows(study, result)) {
    if (row.kind != "class" && row.structure != "body" && row.structure != "organs") {
      continue;
    }
    const auto found = std::find(result.systems.begin(), result.systems.end(), row.system);
    const Sum& sum = sums[static_cast<std::size_t>(found - result.systems.begin())];
    const auto interval = row.coverageInterval();
    text += io::csvRow(std::array{row.source, row.system, row.model, row.pose, io::csvNumber(sum.area),
                                  io::csvNumber(sum.mass), row.structure, row.kind, io::csvNumber(row.coverage()),
                                  interval ? io::csvNumber(interval->low) : std::string(),
                                  interval ? io::csvNumber(interval->high) : std::string(), std::to_string(row.shots),
                                  std::to_string(row.count.any), std::to_string(row.count.shielded)});
  }
  return text;
}

}  // namespace lorica::analysis
