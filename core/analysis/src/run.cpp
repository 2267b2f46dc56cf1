#include "lorica/analysis/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check_analyses.h"
#include "lorica/analysis/anatomy.h"
#include "lorica/analysis/gaps.h"
#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/reserved_names.h"
#include "prepare_source.h"

namespace lorica::analysis {

namespace {

struct Plan {
  std::vector<NamedPose> poses;
  std::vector<geometry::Positions> skins;        // posed, one per pose
  std::map<std::string, geometry::Box3d> boxes;  // of structures that sources are aimed at, over all poses
};

/// Extends the boxes of the structures that sources are aimed at by a pose.
void extendBoxes(const LoadedStudy& study, const std::vector<viscera::OrganModel>& models, const NamedPose& pose,
                 const parenting::PosedBody& body, base::Threads threads, Plan& plan) {
  const auto aimedAt = [&](const std::string& name) {
    return std::any_of(study.study.sources.begin(), study.study.sources.end(),
                       [&](const study::Source& source) { return source.targetStructure == name; });
  };
  for (const auto& organ : study.organs) {
    geometry::Positions posed(organ->rig.rest.positions.size());
    for (std::size_t m = 0; aimedAt(organ->name) && m < models.size(); ++m) {
      viscera::poseOrgan(organ->rig, models[m], *study.body, body, posed, threads);
      plan.boxes[organ->name].extend(geometry::bounds(posed));
    }
  }
  for (const auto& piece : study.pieces) {
    if (aimedAt(piece->name)) {
      geometry::Positions posed(piece->rig.rest.positions.size());
      armor::posePiece(piece->rig, body, armor::pieceDeltas(*study.body, pose.pose), posed, threads);
      plan.boxes[piece->name].extend(geometry::bounds(posed));
    }
  }
}

/// Sources with targets, cones and disks that bound the posed skins of all poses compared.
std::vector<ShotSource> prepareSources(const LoadedStudy& study, const RunOptions& options, const Plan& plan,
                                       base::Issues& issues) {
  Aim aim;
  aim.skins.assign(plan.skins.begin(), plan.skins.end());
  aim.boxOf = [&](const std::string& structure) {
    const auto found = plan.boxes.find(structure);
    return found == plan.boxes.end() ? geometry::Box3d() : found->second;
  };
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
  Plan plan;
  for (const std::string& name : options.poses.empty() ? defaultPoses(study.study) : options.poses) {
    if (std::find(result.poses.begin(), result.poses.end(), name) != result.poses.end()) {
      continue;
    }
    plan.poses.push_back(resolvePose(study, name));
    result.poses.push_back(name);
  }
  for (const NamedPose& pose : plan.poses) {
    if (progress.cancelled()) {
      break;
    }
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
    extendBoxes(study, result.models, pose, posed, options.threads, plan);
    plan.skins.push_back(std::move(posed.skin));
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

/// Fails when the rule for stopping names something that is no organ.
void checkStopRule(const LoadedStudy& study) {
  const std::optional<study::StopRule>& stop = study.study.stop;
  for (std::size_t i = 0; stop && i < stop->structures.size(); ++i) {
    const bool known = std::any_of(study.organs.begin(), study.organs.end(),
                                   [&](const auto& organ) { return organ->name == stop->structures[i]; });
    if (!known) {
      throw base::InputError(study.file.string(), fmt::format("/stop/structures/{}", i),
                             fmt::format("the study has no organ named \"{}\"", stop->structures[i]));
    }
  }
}

/// Whether the intervals the rule is about are narrow enough with these trials.
bool narrowEnough(const LoadedStudy& study, const RunResult& result, const SourcePoseResult& here) {
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
  const std::vector<ResultRow> rows = summaryRows(study, soFar);
  return std::all_of(rows.begin(), rows.end(), [&](const ResultRow& row) {
    const bool chosen =
        row.kind == "organ" && (unarmoredOnly || row.system != study::unarmored) &&
        std::find(stop.structures.begin(), stop.structures.end(), row.structure) != stop.structures.end();
    const auto interval = unarmoredOnly ? row.shareInterval() : row.coverageInterval();
    return !chosen || (interval && 0.5 * (interval->high - interval->low) <= stop.halfWidth);
  });
}

/// \throw base::Cancelled; what was finished stays in the result
void shootPose(const LoadedStudy& study, const PosedScene& scene, std::size_t pose, base::Threads threads,
               RunResult& result, const base::Progress& progress) {
  const std::uint32_t most = study.study.stop ? std::max(result.trials, study.study.stop->maxTrials) : result.trials;
  const double steps = static_cast<double>(result.sources.size()) * most;
  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    SourcePoseResult& here = result.results[s * result.poses.size() + pose];
    for (std::uint32_t trial = 0; trial < most; ++trial) {
      if (trial >= result.trials && narrowEnough(study, result, here)) {
        break;
      }
      const shotline::ShotGenerator shots(result.sources[s].source, result.seed, trial);
      shotline::CountAndCompare counted(scene.layout(), study.study.analyses.compare);
      const double step = static_cast<double>(s) * most + trial;
      const raycast::CastCounts counts =
          shotline::observeShots(scene.scene(), shots, {0, result.sources[s].shots}, threads,
                                 progress.part(step / steps, (step + 1.0) / steps), counted);
      here.trials.push_back(counted.tally());
      here.pairs.add(counted.pairs());
      here.counts.add(counts);
    }
  }
}

}  // namespace

void checkAnalyses(const LoadedStudy& study) {
  if (study.study.analyses.gaps) {
    checkGaps(study);
  }
  if (study.study.analyses.anatomy) {
    jitterOf(study);
  }
}

RunResult planRun(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress) {
  RunResult result;
  result.issues = study.issues;
  result.models = study.study.models;
  result.systems.emplace_back(study::unarmored);
  for (const study::ArmorSystem& system : study.study.systems) {
    result.systems.push_back(system.name);
  }
  result.seed = options.seed.value_or(study.study.seed);
  result.trials = options.trials.value_or(study.study.trials);
  checkStopRule(study);
  checkAnalyses(study);
  const Plan plan = planPoses(study, options, result, progress);
  if (progress.cancelled()) {
    result.partial = true;
    return result;
  }
  result.sources = prepareSources(study, options, plan, result.issues);
  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    for (std::size_t p = 0; p < plan.poses.size(); ++p) {
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
  std::optional<StudyAudit> audit;
  try {
    audit.emplace(study, options.threads, progress.part(0.0, audited));
  } catch (const base::Cancelled&) {
    result.partial = true;
    return result;
  }
  base::append(result.issues, audit->meshes().issues());
  result.restRoom = audit->restRoom();
  // Pose by pose, so that only one scene is in memory.
  const double poses = static_cast<double>(result.poses.size());
  for (std::size_t p = 0; p < result.poses.size() && !result.partial; ++p) {
    const PosedScene scene(study, result.models, resolvePose(study, result.poses[p]).pose, raycast::SceneUse::manyRays,
                           options.threads);
    const double begin = audited + (1.0 - audited) * static_cast<double>(p) / poses;
    const double end = audited + (1.0 - audited) * static_cast<double>(p + 1) / poses;
    const double middle = begin + 0.25 * (end - begin);
    try {
      auditPose(*audit, scene, p, options.threads, result, progress.part(begin, middle));
      shootPose(study, scene, p, options.threads, result, progress.part(middle, end));
    } catch (const base::Cancelled&) {
      result.partial = true;
    }
  }
  return result;
}

}  // namespace lorica::analysis
