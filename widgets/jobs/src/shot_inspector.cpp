#include "lorica/jobs/shot_inspector.h"

#include "lorica/base/error.h"

namespace lorica::jobs {

ShotInspector::ShotInspector(QObject* parent) : QObject(parent) {
  qRegisterMetaType<std::shared_ptr<const lorica::jobs::ShotInspection>>();
}

void ShotInspector::abandon() {
  jobs::abandon(job_, this);
}

void ShotInspector::request(std::shared_ptr<const document::RunPlan> plan, const analysis::ShotName& name,
                            const std::string& pose) {
  LORICA_CHECK(plan != nullptr && !plan->trouble, "a run that can be");
  abandon();
  struct Outcome {
    std::shared_ptr<ShotInspection> inspection;
    QString trouble;
  };
  auto outcome = std::make_shared<Outcome>();
  job_ = std::make_unique<Job>(tr("Looking into a shot"), [outcome, plan, name, pose](const base::Progress& progress) {
    try {
      analysis::RunResult here = plan->result;
      here.poses = {pose};
      const std::vector<analysis::ShotDetails> found = analysis::shotDetails(*plan->study, here, name, base::Threads{});
      progress.check();
      outcome->inspection = std::make_shared<ShotInspection>(ShotInspection{plan, name, found.front()});
    } catch (const base::InputError& error) {
      outcome->trouble = QString::fromStdString(error.text());
    }
  });
  connect(job_.get(), &Job::finished, this, [this, outcome] {
    if (outcome->inspection != nullptr) {
      Q_EMIT ready(outcome->inspection);
    } else {
      Q_EMIT failed(outcome->trouble);
    }
  });
  connect(job_.get(), &Job::failed, this, &ShotInspector::failed);
  connect(job_.get(), &Job::ended, this, [this, job = job_.get()] {
    if (job_.get() == job) {
      job_.release()->deleteLater();
    }
  });
  job_->start();
}

}  // namespace lorica::jobs
