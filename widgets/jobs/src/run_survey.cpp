#include "lorica/jobs/run_survey.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "lorica/analysis/directions.h"

namespace lorica::jobs {

namespace {

/// One source at one pose as a run of its own, so that rows mean what they mean in the summary.
analysis::RunResult single(const analysis::RunResult& of, const analysis::ShotSource& source, const std::string& pose,
                           std::vector<shotline::Tally> trials) {
  analysis::RunResult made;
  made.sources = {source};
  made.poses = {pose};
  made.models = of.models;
  made.systems = of.systems;
  made.results = {{0, 0, std::move(trials), {}, {}}};
  return made;
}

}  // namespace

bool asksForSurvey(const document::RunRecord& run) {
  const study::Analyses& asked = run.study->study.analyses;
  return asked.directions || asked.motion || asked.gaps || asked.anatomy;
}

RunSurvey surveyOf(const std::shared_ptr<const document::RunRecord>& run, const base::Progress& progress) {
  const analysis::LoadedStudy& study = *run->study;
  const study::Analyses& asked = study.study.analyses;
  // Each part has the share of the time that it seems to take: gaps are the run once more, draws are many runs.
  const std::array<double, 4> weights{asked.gaps ? 1.0 : 0.0, asked.anatomy ? 0.5 * asked.anatomy->draws : 0.0,
                                      asked.directions ? 5.0 : 0.0, asked.motion ? 5.0 : 0.0};
  const double whole = std::max(1.0, std::accumulate(weights.begin(), weights.end(), 0.0));
  std::array<base::Progress, 4> parts;
  for (double done = 0.0; const std::size_t p : {0U, 1U, 2U, 3U}) {
    parts[p] = progress.part(done / whole, (done + weights[p]) / whole);
    done += weights[p];
  }
  RunSurvey survey;
  survey.run = run;
  if (asked.gaps) {
    survey.gaps = analysis::findGaps(study, run->result, {}, parts[0]);
  }
  if (asked.anatomy) {
    survey.anatomy = analysis::overAnatomies(study, run->result, {}, parts[1]);
  }
  if (asked.directions) {
    for (auto& here : analysis::byDirection(study, run->result, {}, parts[2])) {
      analysis::ShotSource source;
      source.source.shape = shotline::ParallelBeam{};
      survey.directions.push_back(
          {here.pose, here.azimuth, here.elevation, here.area,
           analysis::summaryRows(study, single(run->result, source, run->result.poses[here.pose], {here.tally}))});
    }
  }
  if (asked.motion) {
    const analysis::MotionResult motion = analysis::overMotion(study, {}, parts[3]);
    for (const analysis::FrameResult& here : motion.frames) {
      survey.frames.push_back(
          {here.seconds, analysis::summaryRows(study, single(motion.plan, motion.plan.sources[here.source],
                                                             motion.plan.poses[here.frame], here.trials))});
    }
  }
  return survey;
}

}  // namespace lorica::jobs
