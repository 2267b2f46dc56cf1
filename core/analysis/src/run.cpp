#include "lorica/analysis/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "lorica/analysis/posed_scene.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/reserved_names.h"
#include "prepare_source.h"

namespace lorica::analysis {

using geometry::Vec3f;

ShotSource prepareSource(const LoadedStudy& study, std::size_t source, std::span<const std::span<const Vec3f>> skins,
                         base::Issues& issues) {
  geometry::Box3d box;
  for (const std::span<const Vec3f> skin : skins) {
    box.extend(geometry::bounds(skin));
  }
  const study::Source& wanted = study.study.sources[source];
  ShotSource made;
  made.source.name = wanted.name;
  made.source.position = wanted.position;
  made.source.target = wanted.target.value_or(box.center());
  made.source.sampler = wanted.sampler;
  made.shots = wanted.shots;
  if (made.source.position == made.source.target) {
    throw base::InputError(study.file.string(), fmt::format("/sources/{}", source),
                           "the source stands on its target; move one of them");
  }
  if (wanted.sampler == shotline::Sampler::thesis) {
    issues.push_back({base::Severity::warning, "", wanted.name,
                      "the thesis' sampler (Eq 15) sends half of its shots backwards and its hit rate depends on the "
                      "world's axes; use it for comparison only"});
    return made;
  }
  made.source.halfAngle = shotline::boundingHalfAngle(made.source.position, made.source.target, skins);
  made.solidAngle = shotline::solidAngle(made.source.halfAngle);
  if (made.source.halfAngle == std::numbers::pi) {
    issues.push_back({base::Severity::warning, "", wanted.name,
                      "the source stands so near the body, or in it, that no cone bounds the body; its shots go in "
                      "every direction"});
  }
  return made;
}

namespace {

/// Sources with targets and cones that bound the posed skins of all poses compared.
std::vector<ShotSource> prepareSources(const LoadedStudy& study, const RunOptions& options,
                                       const std::vector<geometry::Positions>& skins, base::Issues& issues) {
  const std::vector<std::span<const Vec3f>> spans(skins.begin(), skins.end());
  std::vector<ShotSource> sources;
  for (std::size_t i = 0; i < study.study.sources.size(); ++i) {
    sources.push_back(prepareSource(study, i, spans, issues));
    sources.back().shots = options.shots.value_or(sources.back().shots);
  }
  return sources;
}

struct Plan {
  std::vector<NamedPose> poses;
  std::vector<geometry::Positions> skins;  // posed, one per pose
};

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

/// \throw base::Cancelled; what was finished stays in the result
void shootPose(const PosedScene& scene, std::size_t pose, const RunOptions& options, RunResult& result,
               const base::Progress& progress) {
  const double steps = static_cast<double>(result.sources.size()) * result.trials;
  double step = 0.0;
  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    SourcePoseResult& here = result.results[s * result.poses.size() + pose];
    for (std::uint32_t trial = 0; trial < result.trials; ++trial) {
      const shotline::ShotGenerator shots(result.sources[s].source, result.seed, trial);
      const shotline::TraceResult traced =
          shotline::trace(scene.scene(), scene.layout(), shots, result.sources[s].shots, options.threads,
                          progress.part(step / steps, (step + 1.0) / steps));
      here.trials.push_back(traced.tally);
      here.counts.add(traced.counts);
      step += 1.0;
    }
  }
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
  result.sources = prepareSources(study, options, plan.skins, result.issues);

  for (std::size_t s = 0; s < result.sources.size(); ++s) {
    for (std::size_t p = 0; p < plan.poses.size(); ++p) {
      result.results.push_back({s, p, {}, {}});
    }
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
  const double poses = static_cast<double>(plan.poses.size());
  for (std::size_t p = 0; p < plan.poses.size() && !result.partial; ++p) {
    const PosedScene scene(study, result.models, plan.poses[p].pose, raycast::SceneUse::manyRays, options.threads);
    const double begin = audited + (1.0 - audited) * static_cast<double>(p) / poses;
    const double end = audited + (1.0 - audited) * static_cast<double>(p + 1) / poses;
    const double middle = begin + 0.25 * (end - begin);
    try {
      auditPose(*audit, scene, p, options.threads, result, progress.part(begin, middle));
      shootPose(scene, p, options, result, progress.part(middle, end));
    } catch (const base::Cancelled&) {
      result.partial = true;
    }
  }
  return result;
}

}  // namespace lorica::analysis
