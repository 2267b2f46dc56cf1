#include "lorica/analysis/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "lorica/analysis/posed_scene.h"
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

}  // namespace

RunResult run(const LoadedStudy& study, const RunOptions& options, const base::Progress& progress) {
  RunResult result;
  result.issues = study.issues;
  result.models = study.study.models;
  result.systems.emplace_back(study::unarmored);
  for (const study::ArmorSystem& system : study.study.systems) {
    result.systems.push_back(system.name);
  }
  result.seed = options.seed.value_or(study.study.seed);
  result.trials = options.trials.value_or(study.study.trials);
  const Plan plan = planPoses(study, options, result, progress);
  if (progress.cancelled()) {
    result.partial = true;
    return result;
  }
  result.sources = prepareSources(study, options, plan, result.issues);

  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    for (std::size_t p = 0; p < plan.poses.size(); ++p) {
      result.results.push_back({s, p, {}, {}});
    }
  }
  const double steps = static_cast<double>(plan.poses.size() * result.sources.size() * result.trials);
  double step = 0.0;
  // Pose by pose, so that only one scene is in memory.
  for (std::size_t p = 0; p < plan.poses.size() && !result.partial; ++p) {
    const PosedScene scene(study, result.models, plan.poses[p].pose, raycast::SceneUse::manyRays, options.threads);
    for (std::size_t s = 0; s < result.sources.size() && !result.partial; ++s) {
      SourcePoseResult& here = result.results[s * plan.poses.size() + p];
      for (std::uint32_t trial = 0; trial < result.trials && !result.partial; ++trial) {
        const shotline::ShotGenerator shots(result.sources[s].source, result.seed, trial);
        try {
          const shotline::TraceResult traced =
              shotline::trace(scene.scene(), scene.layout(), shots, result.sources[s].shots, options.threads,
                              progress.part(step / steps, (step + 1.0) / steps));
          here.trials.push_back(traced.tally);
          here.counts.add(traced.counts);
        } catch (const base::Cancelled&) {
          result.partial = true;
        }
        step += 1.0;
      }
    }
  }
  return result;
}

}  // namespace lorica::analysis
