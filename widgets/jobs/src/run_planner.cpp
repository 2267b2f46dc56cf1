#include "lorica/jobs/run_planner.h"

#include "lorica/base/error.h"

namespace lorica::jobs {

document::RunPlan planOf(const std::shared_ptr<const analysis::LoadedStudy>& study, const base::Progress& progress) {
  document::RunPlan plan;
  plan.study = study;
  try {
    plan.result = analysis::planRun(*study, {}, progress);
  } catch (const base::InputError& error) {
    plan.trouble = base::Issue{base::Severity::error, error.file(), error.place(), error.text()};
  }
  progress.check();
  return plan;
}

RunPlanner::RunPlanner(document::StudyDocument& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document_, &document::StudyDocument::replaced, this, [this] { abandon(job_, this); });
  connect(&document_, &document::StudyDocument::loadedChanged, this, &RunPlanner::start);
}

void RunPlanner::start() {
  abandon(job_, this);
  const auto loaded = document_.loaded();
  if (loaded == nullptr) {
    return;
  }
  auto plan = std::make_shared<document::RunPlan>();
  job_ = std::make_unique<Job>(tr("Planning the run"),
                               [plan, loaded](const base::Progress& progress) { *plan = planOf(loaded, progress); });
  connect(job_.get(), &Job::finished, this, [this, plan] { document_.setPlan(plan); });
  connect(job_.get(), &Job::ended, this, [this] { job_.release()->deleteLater(); });
  job_->start();
}

}  // namespace lorica::jobs
