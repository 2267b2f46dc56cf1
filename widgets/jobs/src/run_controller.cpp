#include "lorica/jobs/run_controller.h"

#include <algorithm>
#include <chrono>

#include "lorica/analysis/shot_paths.h"
#include "lorica/shotline/trace.h"

namespace lorica::jobs {

namespace {

/// What of the study keeps a run from being planned.
QString whereOf(const document::RunPlan& plan) {
  const QString place = QString::fromStdString(plan.trouble->place);
  const auto& sources = plan.study->study.sources;
  const std::size_t index = place.section(u'/', 2, 2).toULongLong();
  return place.startsWith(u"/sources/") && index < sources.size()
             ? RunController::tr("Source %1").arg(QString::fromStdString(sources[index].name))
             : RunController::tr("The run cannot be planned");
}

}  // namespace

RunController::RunController(document::StudyDocument& document, QObject* parent)
    : QObject(parent), document_(document) {
  // A run of a study that is gone is of no use to anybody.
  connect(&document_, &document::StudyDocument::replaced, this, [this] {
    if (job_ != nullptr) {
      job_.reset();
      Q_EMIT ended();
    }
  });
}

QString RunController::trouble() const {
  if (job_ != nullptr) {
    return tr("A run is going on.");
  }
  if (!document_.hasStudy()) {
    return tr("There is no study to run; open one first.");
  }
  const auto& loaded = document_.loaded();
  if (loaded == nullptr) {
    return tr("The study is not read yet; the problems panel says why when it cannot be.");
  }
  const study::Study& study = document_.study();
  if (!document::sameNumbers(loaded->study, study)) {
    return tr("The last edits are not read yet; the problems panel says why when they cannot be.");
  }
  if (study.sources.empty()) {
    return tr("The study has no source to shoot from; add one.");
  }
  if (study.models.empty()) {
    return tr("No organ model is chosen; choose at least one.");
  }
  if (const auto& plan = document_.plan(); plan != nullptr && plan->study == loaded && plan->trouble) {
    return tr("%1: %2.").arg(whereOf(*plan), QString::fromStdString(plan->trouble->text));
  }
  return {};
}

QString RunController::start() {
  if (const QString why = trouble(); !why.isEmpty()) {
    return why;
  }
  // The run keeps the study as it is now, with its present names and look.
  auto study = std::make_shared<analysis::LoadedStudy>(*document_.loaded());
  study->study = document_.study();
  auto result = std::make_shared<analysis::RunResult>();
  job_ = std::make_unique<Job>(tr("Shooting"), [study, result](const base::Progress& progress) {
    *result = analysis::run(*study, {}, progress);
  });
  connect(job_.get(), &Job::finished, this, [this, study, result] {
    const bool partial = result->partial;
    document_.addRun(study, std::move(*result));
    Q_EMIT finished(partial);
  });
  connect(job_.get(), &Job::failed, this, &RunController::failed);
  connect(job_.get(), &Job::ended, this, [this] {
    job_.release()->deleteLater();
    Q_EMIT ended();
  });
  job_->start();
  Q_EMIT started();
  return {};
}

void RunController::cancel() {
  if (job_ != nullptr) {
    job_->cancel();
  }
}

double RunController::totalShots(const study::Study& study, const document::RunPlan* plan) {
  double perPose = 0.0;
  for (std::size_t i = 0; i < study.sources.size(); ++i) {
    const study::Source& source = study.sources[i];
    const bool ownNumber = source.type == study::SourceType::list || source.sequence == study::Sequence::grid;
    const bool planned = plan != nullptr && i < plan->result.sources.size();
    const double shots = static_cast<double>(ownNumber && planned ? plan->result.sources[i].shots : source.shots);
    // A list is the same in every trial, so it is shot once.
    perPose += source.type == study::SourceType::list ? shots : shots * study.trials;
  }
  return perPose * static_cast<double>(analysis::defaultPoses(study).size());
}

SpeedEstimate measureSpeed(const analysis::LoadedStudy& study, const base::Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  SpeedEstimate estimate;
  Clock::time_point start = Clock::now();
  const analysis::PosedScene scene(study, study.study.models, std::nullopt, raycast::SceneUse::manyRays, {});
  estimate.secondsPerPose = since(start);
  if (study.study.sources.empty()) {
    return estimate;
  }
  const analysis::ShotSource source = analysis::shotSourceFor(study, 0, scene);
  const shotline::ShotGenerator shots(source.source, study.study.seed, 0);
  // Longer bursts until one is long enough to trust.
  for (std::uint64_t count = 20000; count <= 2000000; count *= 4) {
    progress.check();
    start = Clock::now();
    shotline::trace(scene.scene(), scene.layout(), shots, count, {}, progress);
    const double seconds = since(start);
    estimate.shotsPerSecond = static_cast<double>(count) / std::max(seconds, 1e-6);
    if (seconds > 0.15) {
      break;
    }
  }
  return estimate;
}

}  // namespace lorica::jobs
