#include "lorica/analysis/anatomy.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <tuple>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/base/table.h"
#include "lorica/io/export.h"
#include "lorica/shotline/trace.h"
#include "lorica/stats/philox.h"

namespace lorica::analysis {

using geometry::Mat3d;
using geometry::Vec3d;
using geometry::Vec3f;

/// Written at build time from resources/tables.
std::span<const std::pair<std::string_view, std::string_view>> embeddedMotionTable();

namespace {

/// A range is this many standard deviations wide, and draws are cut at half of it.
constexpr double rangeWidth = 4.0;
constexpr double leastDepth = 0.001;  // metres that stay between a moved organ and the skin

/// The words of a name in alphabetical order, in small letters.
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char letter : name) {
    const bool capital = letter >= 'A' && letter <= 'Z';
    if (capital || (letter >= 'a' && letter <= 'z')) {
      words.back() += static_cast<char>(capital ? letter - 'A' + 'a' : letter);
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  std::erase(words, "");
  std::sort(words.begin(), words.end());
  return words;
}

int axisNamed(const std::string& name) {
  constexpr std::array<std::string_view, 3> names{"left", "up", "forward"};
  const auto found = std::find(names.begin(), names.end(), name);
  LORICA_CHECK(found != names.end(), "the axes of the embedded table are left, up and forward");
  return static_cast<int>(found - names.begin());
}

std::vector<PublishedRange> readRanges() {
  const auto files = embeddedMotionTable();
  const base::Table table(files.front().second, "organ_motion");
  std::vector<PublishedRange> ranges;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    ranges.push_back({table.text(r, "organ"), axisNamed(table.text(r, "axis")),
                      (table.number(r, "high_mm") - table.number(r, "low_mm")) / 1000.0,
                      table.text(r, "verification") == "verified"});
  }
  return ranges;
}

/// One normal number, cut at two standard deviations.
double cutNormal(double uniform) {
  static const double below = 0.5 * std::erfc(0.5 * rangeWidth / std::sqrt(2.0));
  const double probability = below + uniform * (1.0 - 2.0 * below);
  return std::clamp(stats::normalQuantile(probability), -0.5 * rangeWidth, 0.5 * rangeWidth);
}

/// How a posed organ is turned against rest.
Mat3d turnOf(std::span<const Vec3f> rest, std::span<const Vec3f> posed) {
  Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(rest.size()));
  Eigen::Matrix3Xd to(3, static_cast<Eigen::Index>(rest.size()));
  for (std::size_t v = 0; v < rest.size(); ++v) {
    from.col(static_cast<Eigen::Index>(v)) = rest[v].cast<double>();
    to.col(static_cast<Eigen::Index>(v)) = posed[v].cast<double>();
  }
  return Eigen::umeyama(from, to, false).topLeftCorner<3, 3>();
}

constexpr std::array percentiles{0.05, 0.5, 0.95};

/// Type 7 of R. J. Hyndman and Y. Fan, "Sample quantiles in statistical packages" (1996). \param sorted rising
std::optional<double> quantile(const std::vector<double>& sorted, double probability) {
  if (sorted.empty()) {
    return std::nullopt;
  }
  const double place = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  return part == 0.0 ? sorted[below] : sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

/// Whether a row of the summary depends on where organs lie.
bool movesWithOrgans(const ResultRow& row) {
  return row.kind == "organ" || row.kind == "class" || row.structure == "organs";
}

/// One source and pose of a run as a run of its own, with other counts or none.
RunResult partOf(const RunResult& run, const SourcePoseResult& here, std::vector<shotline::Tally> trials) {
  RunResult part;
  part.sources = {run.sources[here.source]};
  part.poses = {run.poses[here.pose]};
  part.models = run.models;
  part.systems = run.systems;
  part.results = {{0, 0, std::move(trials), {}, {}}};
  return part;
}

/// The organs of one posed scene, moved draw by draw.
class Mover {
 public:
  Mover(const LoadedStudy& study, PosedScene& scene, base::Threads threads)
      : study_(study), scene_(scene), threads_(threads), skin_(raycast::SceneUse::manyRays) {
    skin_.add(scene.body().skin, study.body->skinTopology());
    skin_.build();
    for (std::size_t m = 0; m < scene.models().size(); ++m) {
      for (std::size_t o = 0; o < study.organs.size(); ++o) {
        placed_.push_back(scene.organ(o, m));
        turns_.push_back(turnOf(study.organs[o]->rig.rest.positions, placed_.back()));
      }
    }
  }

  /// \return whether each organ, model by model, was held back by the skin
  std::vector<bool> move(const std::vector<OrganJitter>& jitter, std::uint64_t seed, std::uint32_t draw,
                         const base::Progress& progress) {
    std::vector<Vec3d> shifts;
    std::vector<bool> heldBack;
    for (std::size_t slot = 0; slot < placed_.size(); ++slot) {
      progress.check();
      Vec3d shift = turns_[slot] * displacement(jitter[slot % study_.organs.size()], seed, draw);
      const double share = shift.isZero(0.0) ? 1.0 : shareInside(skin_, placed_[slot], shift, threads_);
      heldBack.push_back(share < 1.0);
      shifts.emplace_back(share * shift);
    }
    scene_.placeOrgans(placed_, shifts);
    return heldBack;
  }

 private:
  const LoadedStudy& study_;
  PosedScene& scene_;
  base::Threads threads_;
  raycast::Scene skin_;
  std::vector<geometry::Positions> placed_;  ///< where the pose put the organs, model by model
  std::vector<Mat3d> turns_;
};

/// Adds what one draw counted to the rows of its source and pose.
void addDraw(const LoadedStudy& study, const RunResult& part, std::span<AnatomyRow> rows,
             const std::vector<bool>& heldBack) {
  const std::vector<ResultRow> counted = summaryRows(study, part);
  for (AnatomyRow& row : rows) {
    const ResultRow& here = counted[row.row];
    if (const auto coverage = here.coverage()) {
      row.coverage.push_back(*coverage);
    }
    row.percentOfShots.push_back(here.percentOfShots());
    for (std::size_t slot = 0; slot < heldBack.size(); ++slot) {
      const bool its = here.kind == "organ" && study.organs[slot % study.organs.size()]->name == here.structure &&
                       viscera::name(part.models[slot / study.organs.size()]) == here.model;
      row.heldBack += its && heldBack[slot] ? 1 : 0;
    }
  }
}

}  // namespace

const char* nameOf(OrganJitter::Basis basis) {
  constexpr std::array<const char*, 4> names{"none", "unverified", "verified", "given"};
  return names.at(static_cast<std::size_t>(basis));
}

const std::vector<PublishedRange>& publishedRanges() {
  static const std::vector<PublishedRange> ranges = readRanges();
  return ranges;
}

Vec3d OrganJitter::deviation() const {
  Vec3d squares = Vec3d::Zero();
  for (const Component& component : components) {
    squares[component.axis] += component.deviation * component.deviation;
  }
  return squares.cwiseSqrt();
}

std::vector<OrganJitter> jitterOf(const LoadedStudy& study) {
  const study::AnatomySettings& wanted = *study.study.analyses.anatomy;
  std::vector<OrganJitter> all;
  for (const auto& organ : study.organs) {
    OrganJitter jitter;
    jitter.organ = organ->name;
    for (const PublishedRange& range : publishedRanges()) {
      if (wordsOf(range.organ) == wordsOf(organ->name) && (range.verified || !wanted.verifiedOnly)) {
        const auto basis = range.verified ? OrganJitter::Basis::verified : OrganJitter::Basis::unverified;
        jitter.basis = jitter.components.empty() ? basis : std::min(jitter.basis, basis);
        jitter.components.push_back({range.axis, wanted.scale * range.width / rangeWidth});
      }
    }
    all.push_back(std::move(jitter));
  }
  for (const study::AnatomySettings::Deviation& given : wanted.deviations) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const OrganJitter& jitter) { return jitter.organ == given.organ; });
    if (found == all.end()) {
      throw base::InputError(study.file.string(), "/analyses/anatomy/sd_mm",
                             fmt::format("the study has no organ named \"{}\"", given.organ));
    }
    found->basis = OrganJitter::Basis::given;
    found->components.clear();
    for (int axis = 0; axis < 3; ++axis) {
      found->components.push_back({axis, wanted.scale * given.metres[axis]});
    }
  }
  return all;
}

Vec3d displacement(const OrganJitter& jitter, std::uint64_t seed, std::uint32_t draw) {
  const stats::ShotKey key{seed, stats::sourceId("anatomy of " + jitter.organ), draw};
  Vec3d sum = Vec3d::Zero();
  for (std::size_t c = 0; c < jitter.components.size(); ++c) {
    const OrganJitter::Component& component = jitter.components[c];
    sum[component.axis] += component.deviation * cutNormal(stats::uniform2(key, c)[0]);
  }
  return sum;
}

double shareInside(const raycast::Scene& skin, std::span<const Vec3f> points, const Vec3d& shift,
                   base::Threads threads) {
  const double length = shift.norm();
  if (length == 0.0) {
    return 1.0;
  }
  const Vec3f direction = (shift / length).cast<float>();
  const double needed = length + leastDepth;
  double room = needed;
  std::mutex merging;
  base::parallelFor(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    raycast::Caster caster(skin);
    std::vector<raycast::Ray> rays;
    for (std::size_t v = begin; v < end; ++v) {
      rays.push_back({points[v], direction});
    }
    double nearest = needed;
    caster.castMany(rays, [&](std::size_t /*ray*/, std::span<const raycast::Hit> hits) {
      const auto first = std::find_if(hits.begin(), hits.end(),
                                      [&](const raycast::Hit& hit) { return hit.mesh == 0 && caster.isClosed(hit); });
      if (first != hits.end() && !first->entering) {
        nearest = std::min(nearest, first->t);
      }
    });
    const std::lock_guard lock(merging);
    room = std::min(room, nearest);
  });
  return room == needed ? 1.0 : std::clamp((room - leastDepth) / length, 0.0, 1.0);
}

AnatomyResult overAnatomies(const LoadedStudy& study, const RunResult& run, base::Threads threads,
                            const base::Progress& progress) {
  AnatomyResult result;
  result.jitter = jitterOf(study);
  result.draws = study.study.analyses.anatomy->draws;
  std::vector<std::vector<AnatomyRow>> blocks(run.results.size());
  const double steps = static_cast<double>(run.results.size()) * result.draws;
  double step = 0.0;
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    PosedScene scene(study, run.models, resolvePose(study, run.poses[p]).pose, raycast::SceneUse::manyFrames, threads);
    Mover mover(study, scene, threads);
    for (std::uint32_t draw = 0; draw < result.draws; ++draw) {
      const std::vector<bool> heldBack = mover.move(result.jitter, run.seed, draw, progress);
      for (std::size_t s = 0; s < run.sources.size(); ++s, step += 1.0) {
        const std::size_t index = s * run.poses.size() + p;
        const SourcePoseResult& here = run.results[index];
        std::vector<shotline::Tally> trials;
        for (std::uint32_t trial = 0; trial < here.trials.size(); ++trial) {
          const shotline::ShotGenerator shots(run.sources[s].source, run.seed, trial);
          const double whole = static_cast<double>(here.trials.size());
          trials.push_back(
              shotline::trace(scene.scene(), scene.layout(), shots, run.sources[s].shots, threads,
                              progress.part((step + trial / whole) / steps, (step + (trial + 1) / whole) / steps))
                  .tally);
        }
        const RunResult part = partOf(run, here, std::move(trials));
        if (draw == 0) {
          const std::vector<ResultRow> rows = summaryRows(study, part);
          for (std::size_t r = 0; r < rows.size(); ++r) {
            if (movesWithOrgans(rows[r])) {
              blocks[index].push_back({s, p, r, {}, {}});
            }
          }
        }
        addDraw(study, part, blocks[index], heldBack);
      }
    }
  }
  for (std::vector<AnatomyRow>& block : blocks) {
    for (AnatomyRow& row : block) {
      std::sort(row.coverage.begin(), row.coverage.end());
      std::sort(row.percentOfShots.begin(), row.percentOfShots.end());
      result.rows.push_back(std::move(row));
    }
  }
  return result;
}

std::vector<AnatomyRecord> anatomyRecords(const LoadedStudy& study, const RunResult& run, const AnatomyResult& result) {
  std::vector<AnatomyRecord> records;
  std::vector<ResultRow> counted;
  std::tuple<std::size_t, std::size_t> at{SIZE_MAX, SIZE_MAX};
  for (const AnatomyRow& row : result.rows) {
    if (at != std::tuple(row.source, row.pose)) {
      at = {row.source, row.pose};
      const SourcePoseResult& here = run.results[row.source * run.poses.size() + row.pose];
      counted = summaryRows(study, partOf(run, here, here.trials));
    }
    AnatomyRecord record{counted[row.row]};
    const auto jitter = std::find_if(result.jitter.begin(), result.jitter.end(), [&](const OrganJitter& candidate) {
      return record.run.kind == "organ" && candidate.organ == record.run.structure;
    });
    if (jitter != result.jitter.end()) {
      record.jitter = *jitter;
    }
    record.heldBack = row.heldBack;
    record.drawsHit = row.coverage.size();
    for (std::size_t p = 0; p < percentiles.size(); ++p) {
      record.coverage[p] = quantile(row.coverage, percentiles[p]);
      record.percentOfShots[p] = quantile(row.percentOfShots, percentiles[p]);
    }
    records.push_back(std::move(record));
  }
  return records;
}

std::string anatomyCsv(const LoadedStudy& study, const RunResult& run, const AnatomyResult& result) {
  std::string text =
      "source,system,model,pose,structure,kind,class,displacement,sd_left_mm,sd_up_mm,sd_forward_mm,draws,held_back,"
      "draws_hit,coverage,coverage_lo,coverage_hi,coverage_p05,coverage_p50,coverage_p95,pct_of_shots,"
      "pct_of_shots_p05,pct_of_shots_p50,pct_of_shots_p95,shots,any_hit,protected_hit\n";
  for (const AnatomyRecord& record : anatomyRecords(study, run, result)) {
    const ResultRow& here = record.run;
    std::vector<std::string> fields{here.source,    here.system, here.model,      here.pose,
                                    here.structure, here.kind,   here.injuryClass};
    if (record.jitter) {
      fields.emplace_back(nameOf(record.jitter->basis));
      for (const double deviation : record.jitter->deviation()) {
        fields.push_back(fmt::format("{:.1f}", 1000.0 * deviation));
      }
    } else {
      fields.insert(fields.end(), 4, "");
    }
    fields.push_back(std::to_string(result.draws));
    fields.push_back(record.jitter ? std::to_string(record.heldBack) : "");
    fields.push_back(std::to_string(record.drawsHit));
    const auto interval = here.coverageInterval();
    fields.push_back(io::csvNumber(here.coverage()));
    fields.push_back(interval ? io::csvNumber(interval->low) : "");
    fields.push_back(interval ? io::csvNumber(interval->high) : "");
    for (const std::optional<double>& coverage : record.coverage) {
      fields.push_back(io::csvNumber(coverage));
    }
    fields.push_back(io::csvNumber(here.percentOfShots()));
    for (const std::optional<double>& percent : record.percentOfShots) {
      fields.push_back(io::csvNumber(percent));
    }
    for (const std::uint64_t count : {here.shots, here.count.any, here.count.shielded}) {
      fields.push_back(std::to_string(count));
    }
    text += io::csvRow(fields);
  }
  return text;
}

}  // namespace lorica::analysis
