#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lorica/analysis/directions.h"
#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/io/export.h"
#include "references.h"

namespace lorica::analysis {

namespace {

/// Times of the frames, the first and the last among them.
std::vector<double> frameTimes(const LoadedStudy& study, const study::MotionSettings& motion) {
  const auto clip =
      std::find_if(study.clips.begin(), study.clips.end(), [&](const human::Clip& c) { return c.name == motion.clip; });
  LORICA_CHECK(clip != study.clips.end(), "a clip of the body");
  const double duration = clip->duration();
  const double step = static_cast<double>(motion.every) / motion.framesPerSecond;
  std::vector<double> times;
  for (std::size_t frame = 0; static_cast<double>(frame) * step < duration; ++frame) {
    times.push_back(static_cast<double>(frame) * step);
  }
  // A last interval shorter than a thousandth of the others is rounding.
  if (!times.empty() && duration - times.back() < 1e-3 * step) {
    times.pop_back();
  }
  times.push_back(duration);
  return times;
}

/// The frames as a run, so that rows mean what they mean in the summary. One frame of one source.
RunResult asRun(const MotionResult& motion, const FrameResult& frame) {
  RunResult run;
  run.sources = {motion.plan.sources[frame.source]};
  run.poses = {motion.plan.poses[frame.frame]};
  run.models = motion.plan.models;
  run.systems = motion.plan.systems;
  run.results = {{0, 0, frame.trials, {}, {}}};
  return run;
}

}  // namespace

MotionResult overMotion(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress) {
  const study::MotionSettings& motion = *study.study.analyses.motion;
  requireReferences(study);
  const std::vector<double> times = frameTimes(study, motion);
  MotionResult result;
  RunOptions frames = options;
  frames.poses.clear();
  for (const double seconds : times) {
    frames.poses.push_back(fmt::format("{}@{}", motion.clip, seconds));
  }
  result.plan = planRun(study, frames, progress.part(0.0, 0.1));
  progress.check();
  result.plan.results.clear();
  const std::size_t sources = result.plan.sources.size();
  result.frames.resize(sources * times.size());
  PosedScene scene(study, result.plan.models, std::nullopt, raycast::SceneUse::manyFrames, options.threads);
  double steps = 0.0;
  for (std::size_t s = 0; s < sources; ++s) {
    steps += static_cast<double>(times.size()) * trialsOf(result.plan, s);
  }
  double step = 0.0;
  for (std::size_t frame = 0; frame < times.size(); ++frame) {
    scene.move(resolvePose(study, result.plan.poses[frame]).pose, options.threads);
    for (std::size_t s = 0; s < sources; ++s) {
      FrameResult& here = result.frames[s * times.size() + frame];
      here.source = s;
      here.frame = frame;
      here.seconds = times[frame];
      const ShotSource& source = result.plan.sources[s];
      for (std::uint32_t trial = 0; trial < trialsOf(result.plan, s); ++trial, step += 1.0) {
        here.trials.push_back(shotline::trace(scene.scene(), scene.layout(),
                                              shotline::ShotGenerator(source.source, result.plan.seed, trial),
                                              source.shots, options.threads,
                                              progress.part(0.1 + 0.9 * step / steps, 0.1 + 0.9 * (step + 1.0) / steps))
                                  .tally);
      }
    }
  }
  return result;
}

std::string motionCsv(const LoadedStudy& study, const MotionResult& result) {
  std::string text =
      "source,system,model,frame,time_s,structure,kind,class,shots,any_hit,protected_hit,pct_of_shots,coverage,"
      "coverage_lo,coverage_hi\n";
  for (const FrameResult& frame : result.frames) {
    for (const ResultRow& row : summaryRows(study, asRun(result, frame))) {
      const auto interval = row.coverageInterval();
      text += io::csvRow(std::array{
          row.source, row.system, row.model, std::to_string(frame.frame), fmt::format("{:.6f}", frame.seconds),
          row.structure, row.kind, row.injuryClass, std::to_string(row.shots), std::to_string(row.count.any),
          std::to_string(row.count.shielded), io::csvNumber(row.percentOfShots()), io::csvNumber(row.coverage()),
          interval ? io::csvNumber(interval->low) : std::string(),
          interval ? io::csvNumber(interval->high) : std::string()});
    }
  }
  return text;
}

namespace {

/// What one structure does over the frames.
struct Course {
  std::vector<std::array<double, 2>> points;  ///< seconds and coverage, of the frames that hit
  std::size_t frames = 0;
  std::size_t worst = 0;  ///< frame
  double worstTime = 0.0;
  std::optional<double> lowest;
  shotline::Count countOfWorst;
  std::uint64_t shots = 0;  ///< of all frames, like the count below
  shotline::Count count;

  void add(const FrameResult& frame, const ResultRow& row) {
    const std::optional<double> coverage = row.coverage();
    ++frames;
    shots += row.shots;
    count.any += row.count.any;
    count.shielded += row.count.shielded;
    if (!coverage) {
      return;
    }
    points.push_back({frame.seconds, *coverage});
    if (!lowest || *coverage < *lowest) {
      lowest = coverage;
      worst = frame.frame;
      countOfWorst = row.count;
      worstTime = frame.seconds;
    }
  }
  std::optional<double> mean() const {
    if (points.empty()) {
      return std::nullopt;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      sum += 0.5 * (points[i][1] + points[i + 1][1]) * (points[i + 1][0] - points[i][0]);
    }
    const double time = points.back()[0] - points.front()[0];
    return time > 0.0 ? sum / time : points.front()[1];
  }
};

}  // namespace

std::string motionSummaryCsv(const LoadedStudy& study, const MotionResult& result) {
  std::map<std::array<std::string, 5>, Course> courses;
  std::vector<std::array<std::string, 5>> order;
  for (const FrameResult& frame : result.frames) {
    for (const ResultRow& row : summaryRows(study, asRun(result, frame))) {
      const std::array<std::string, 5> key{row.source, row.system, row.model, row.structure, row.kind};
      Course& course = courses[key];
      if (course.frames == 0) {
        order.push_back(key);
      }
      course.add(frame, row);
    }
  }
  std::string text =
      "source,system,model,structure,kind,frames,frames_hit,coverage_time_mean,coverage_lowest,worst_frame,"
      "worst_time_s,shots,any_hit,protected_hit,worst_any_hit,worst_protected_hit\n";
  for (const auto& key : order) {
    const Course& course = courses[key];
    const bool hit = course.lowest.has_value();
    text += io::csvRow(std::array{
        key[0], key[1], key[2], key[3], key[4], std::to_string(course.frames), std::to_string(course.points.size()),
        io::csvNumber(course.mean()), io::csvNumber(course.lowest), hit ? std::to_string(course.worst) : std::string(),
        hit ? fmt::format("{:.6f}", course.worstTime) : std::string(), std::to_string(course.shots),
        std::to_string(course.count.any), std::to_string(course.count.shielded),
        std::to_string(course.countOfWorst.any), std::to_string(course.countOfWorst.shielded)});
  }
  return text;
}

}  // namespace lorica::analysis
