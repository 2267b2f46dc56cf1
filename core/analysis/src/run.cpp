#include "lorica/analysis/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/reserved_names.h"
#include "prepare_source.h"
#include "references.h"

namespace lorica::analysis {

namespace {

struct Plan {
  PosedSkins skins;
  std::map<std::string, geometry::Box3d> boxes;  // of structures that sources are aimed at, over all poses
};

/// Extends the boxes of the structures that sources are aimed at by a pose.
void extendBoxes(const LoadedStudy& study, const std::vector<viscera::OrganModel>& models,
                 const parenting::PosedBody& body, base::Threads threads, Plan& plan) {
  const auto aimedAt = [&](const std::string& name) {
    return std::any_of(study.study.sources.begin(), study.study.sources.end(),
                       [&](const study::Source& source) { return source.targetStructure == name; });
  };
  std::vector<geometry::Vec3f> softBody;
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    const LoadedOrgan& organ = *study.organs[o];
    geometry::Positions posed(organ.rig.rest.positions.size());
    for (std::size_t m = 0; aimedAt(organ.name) && m < models.size(); ++m) {
      if (usesSoftBody(study, models[m]) && softBody.empty()) {
        softBody = study.softBody->settle(body, threads);
      }
      placeOrgan(study, o, models[m], body, softBody, posed, threads);
      plan.boxes[organ.name].extend(geometry::bounds(posed));
    }
  }
  for (const auto& piece : study.pieces) {
    if (aimedAt(piece->name)) {
      geometry::Positions posed(piece->rig.rest.positions.size());
      armor::posePiece(piece->rig, body, posed, threads);
      plan.boxes[piece->name].extend(geometry::bounds(posed));
    }
  }
}

/// Sources with targets, cones and disks that bound the posed skins of all poses compared.
std::vector<ShotSource> prepareSources(const LoadedStudy& study, const RunOptions& options, Plan plan,
                                       base::Issues& issues) {
  const Aim aim{std::move(plan.skins), [&](const std::string& structure) {
                  const auto found = plan.boxes.find(structure);
                  return found == plan.boxes.end() ? geometry::Box3d() : found->second;
                }};
  std::vector<ShotSource> sources;
  for (std::size_t i = 0; i < study.study.sources.size(); ++i) {
    sources.push_back(prepareSource(study, i, aim, issues));
    const study::Source& wanted = study.study.sources[i];
    if (wanted.type != study::SourceType::list && wanted.sequence != study::Sequence::grid) {
      sources.back().shots = options.shots.value_or(sources.back().shots);
    }
  }
  return sources;
}

Plan planPoses(const LoadedStudy& study, const RunOptions& options, RunResult& result, const base::Progress& progress) {
  std::vector<NamedPose> poses;
  for (const std::string& name : options.poses.empty() ? defaultPoses(study.study) : options.poses) {
    if (std::find(result.poses.begin(), result.poses.end(), name) != result.poses.end()) {
      continue;
    }
    poses.push_back(resolvePose(study, name));
    result.poses.push_back(name);
  }
  Plan plan{PosedSkins([&study, &options, &progress, names = result.poses](std::size_t pose) {
              progress.check();
              return study.body->pose(resolvePose(study, names[pose]).pose, options.threads).skin;
            }),
            {}};
  for (const NamedPose& pose : poses) {
    progress.check();
    parenting::PosedBody posed = study.body->pose(pose.pose, options.threads);
    const bool thesis = std::find(result.models.begin(), result.models.end(), viscera::OrganModel::dynamicThesis) !=
                        result.models.end();
    const std::size_t collapsed = posed.sites.collapsed.size() + (thesis ? posed.thesisSites.collapsed.size() : 0);
    result.collapsedSites.push_back(collapsed);
    if (collapsed > 0) {
      result.issues.push_back({base::Severity::warning, "", pose.name,
                               fmt::format("the anchors of {} interior site(s) collapsed; the nearest sound site "
                                           "stands in for each",
                                           collapsed)});
    }
    extendBoxes(study, result.models, posed, options.threads, plan);
    plan.skins.add(std::move(posed.skin));
  }
  return plan;
}

/// \throw base::Cancelled; what was finished stays in the result
void auditPose(const StudyAudit& audit, const PosedScene& scene, std::size_t pose, base::Threads threads,
               RunResult& result, const base::Progress& progress) {
  result.rooms.push_back(audit.room(scene));
  const double models = static_cast<double>(result.models.size());
  for (std::size_t m = 0; m < result.models.size(); ++m) {
    ModelDeformation made = audit.measure(
        scene, m, threads, progress.part(static_cast<double>(m) / models, static_cast<double>(m + 1) / models));
    made.pose = pose;
    result.deformations.push_back(std::move(made));
  }
}

/// Half the width of the widest interval that the rule for stopping is about, with the trials so far.
struct WidestInterval {
  double half = 0.0;
  std::string of;
};

WidestInterval widestInterval(const LoadedStudy& study, const RunResult& result, const SourcePoseResult& here) {
  const study::StopRule& stop = *study.study.stop;
  RunResult soFar;
  soFar.sources = {result.sources[here.source]};
  soFar.poses = {result.poses[here.pose]};
  soFar.models = result.models;
  soFar.systems = result.systems;
  soFar.results = {here};
  soFar.results[0].source = 0;
  soFar.results[0].pose = 0;
  const bool unarmoredOnly = result.systems.size() == 1;
  WidestInterval widest;
  for (const ResultRow& row : summaryRows(study, soFar)) {
    const bool chosen =
        row.kind == "organ" && (unarmoredOnly || row.system != study::unarmored) &&
        std::find(stop.structures.begin(), stop.structures.end(), row.structure) != stop.structures.end();
    if (!chosen) {
      continue;
    }
    std::optional<stats::Interval> interval = unarmoredOnly ? row.shareInterval() : row.coverageInterval();
    if (!interval) {
      // Trials that do not differ leave no spread to measure by. Their shots are spread more evenly than random ones,
      // so Wilson's interval is on the safe side.
      interval =
          unarmoredOnly ? stats::wilson(row.count.any, row.shots) : stats::wilson(row.count.shielded, row.count.any);
    }
    const double half = 0.5 * (interval->high - interval->low);
    if (half > widest.half) {
      widest = {half, fmt::format("{} under {} in {}", row.structure, row.system, row.model)};
    }
  }
  return widest;
}

/// \throw base::Cancelled; what was finished stays in the result
void shootPose(const LoadedStudy& study, const PosedScene& scene, std::size_t pose, base::Threads threads,
               RunResult& result, const base::Progress& progress) {
  const double sources = static_cast<double>(result.sources.size());
  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    SourcePoseResult& here = result.results[s * result.poses.size() + pose];
    const std::uint32_t least = trialsOf(result, s);
    const bool goesOn = study.study.stop && shotline::isDrawn(result.sources[s].source);
    const std::uint32_t most = goesOn ? std::max(least, study.study.stop->maxTrials) : least;
    for (std::uint32_t trial = 0; trial < most; ++trial) {
      if (trial >= least && widestInterval(study, result, here).half <= study.study.stop->halfWidth) {
        break;
      }
      const shotline::ShotGenerator shots(result.sources[s].source, result.seed, trial);
      shotline::CountAndCompare counted(scene.layout(), study.study.analyses.compare);
      const auto share = [&](double trials) { return (static_cast<double>(s) + trials / most) / sources; };
      const raycast::CastCounts counts =
          shotline::observeShots(scene.scene(), shots, rangeOf(result.part, result.sources[s].shots), threads,
                                 progress.part(share(trial), share(trial + 1.0)), counted);
      here.trials.push_back(counted.tally());
      here.pairs.add(counted.pairs());
      here.counts.add(counts);
    }
    if (goesOn) {
      const WidestInterval widest = widestInterval(study, result, here);
      here.goalReached = widest.half <= study.study.stop->halfWidth;
      if (!*here.goalReached) {
        result.issues.push_back({base::Severity::warning, "",
                                 fmt::format("source {}, pose {}", result.sources[s].source.name, result.poses[pose]),
                                 fmt::format("the rule for stopping was not met after {} trials: half the interval of "
                                             "{} is {:.3f}, the goal {:.3f}; "
                                             "take more shots a trial or raise max_trials",
                                             here.trials.size(), widest.of, widest.half, study.study.stop->halfWidth)});
      }
    }
  }
}

}  // namespace

shotline::ShotRange rangeOf(const RunPart& part, std::uint64_t shots) {
  // By quotient and remainder: shots * index may be more than 64 bits hold.
  const auto border = [&](std::uint64_t index) {
    return shots / part.count * index + shots % part.count * index / part.count;
  };
  return {border(part.index), border(part.index + std::uint64_t{1}) - border(part.index)};
}

std::uint32_t trialsOf(const RunResult& result, std::size_t source) {
  return shotline::isDrawn(result.sources.at(source).source) ? result.trials : std::min(1U, result.trials);
}

RunResult planRun(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress) {
  RunResult result;
  result.issues = study.issues;
  result.models = study.study.models;
  result.systems.emplace_back(study::unarmored);
  for (const study::ArmorSystem& system : study.study.systems) {
    result.systems.push_back(system.name);
  }
  LORICA_CHECK(options.part.index < options.part.count, "a part of the run");
  result.part = options.part;
  if (study.study.stop && options.part.count > 1) {
    throw base::InputError(study.file.string(), "/stop",
                           "the rule for stopping asks for all shots of a trial, so such a run cannot be cut in parts");
  }
  result.seed = options.seed.value_or(study.study.seed);
  result.trials = options.trials.value_or(study.study.trials);
  requireReferences(study);
  try {
    result.sources = prepareSources(study, options, planPoses(study, options, result, progress), result.issues);
  } catch (const base::Cancelled&) {
    result.partial = true;
    return result;
  }
  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    for (std::size_t p = 0; p < result.poses.size(); ++p) {
      result.results.push_back({s, p, {}, {}, {}});
    }
  }
  return result;
}

RunResult run(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress) {
  RunResult result = planRun(study, options, progress);
  if (result.partial) {
    return result;
  }
  constexpr double audited = 0.05;
  std::optional<StudyAudit> audit;  // the first part's
  if (options.part.index == 0 && options.audit) {
    try {
      audit.emplace(study, options.threads, progress.part(0.0, audited));
    } catch (const base::Cancelled&) {
      result.partial = true;
      return result;
    }
    base::append(result.issues, audit->meshes().issues());
    result.restRoom = audit->restRoom();
  }
  // Pose by pose, so that only one scene is in memory.
  const double poses = static_cast<double>(result.poses.size());
  for (std::size_t p = 0; p < result.poses.size() && !result.partial; ++p) {
    const PosedScene scene(study, result.models, resolvePose(study, result.poses[p]).pose, raycast::SceneUse::manyRays,
                           options.threads);
    const double begin = audited + (1.0 - audited) * static_cast<double>(p) / poses;
    const double end = audited + (1.0 - audited) * static_cast<double>(p + 1) / poses;
    const double middle = begin + 0.25 * (end - begin);
    try {
      if (audit) {
        auditPose(*audit, scene, p, options.threads, result, progress.part(begin, middle));
      }
      if (options.shoot) {
        shootPose(study, scene, p, options.threads, result, progress.part(middle, end));
      }
    } catch (const base::Cancelled&) {
      result.partial = true;
    }
  }
  return result;
}

RunResult merge(std::span<const RunResult> parts) {
  LORICA_CHECK(!parts.empty(), "a run has a part");
  RunResult whole = parts[0];
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const RunResult& part = parts[p];
    LORICA_CHECK(!part.partial &&
                     part.part == (RunPart{static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(parts.size())}),
                 "all parts of a run in their order");
    LORICA_CHECK(part.seed == whole.seed && part.poses == whole.poses && part.models == whole.models &&
                     part.systems == whole.systems && part.results.size() == whole.results.size(),
                 "parts of one run");
    for (std::size_t r = 0; p > 0 && r < whole.results.size(); ++r) {
      const SourcePoseResult& more = part.results[r];
      SourcePoseResult& sum = whole.results[r];
      LORICA_CHECK(more.trials.size() == sum.trials.size(), "parts of one run");
      for (std::size_t trial = 0; trial < sum.trials.size(); ++trial) {
        sum.trials[trial].add(more.trials[trial]);
      }
      sum.counts.add(more.counts);
      sum.pairs.add(more.pairs);
    }
  }
  whole.part = {};
  return whole;
}

}  // namespace lorica::analysis
