#include "lorica/jobs/run_survey.h"

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
  return asked.directions || asked.motion;
}

RunSurvey surveyOf(const std::shared_ptr<const document::RunRecord>& run, const base::Progress& progress) {
  const analysis::LoadedStudy& study = *run->study;
  const study::Analyses& asked = study.study.analyses;
  const double middle = !asked.motion ? 1.0 : asked.directions ? 0.5 : 0.0;
  RunSurvey survey;
  survey.run = run;
  if (asked.directions) {
    for (auto& here : analysis::byDirection(study, run->result, {}, progress.part(0.0, middle))) {
      analysis::ShotSource source;
      source.source.shape = shotline::ParallelBeam{};
      survey.directions.push_back(
          {here.pose, here.azimuth, here.elevation, here.area,
           analysis::summaryRows(study, single(run->result, source, run->result.poses[here.pose], {here.tally}))});
    }
  }
  if (asked.motion) {
    const analysis::MotionResult motion = analysis::overMotion(study, {}, progress.part(middle, 1.0));
    for (const analysis::FrameResult& here : motion.frames) {
      survey.frames.push_back(
          {here.seconds, analysis::summaryRows(study, single(motion.plan, motion.plan.sources[here.source],
                                                             motion.plan.poses[here.frame], here.trials))});
    }
  }
  return survey;
}

}  // namespace lorica::jobs
