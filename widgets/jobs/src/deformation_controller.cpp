#include "lorica/jobs/deformation_controller.h"

#include <mutex>
#include <optional>

namespace lorica::jobs {

/// A study and what is known of its rest state. Jobs follow one another, but one that was given up may still be in it.
struct DeformationController::Audit {
  std::shared_ptr<const analysis::LoadedStudy> study;
  std::mutex mutex;
  std::optional<analysis::StudyAudit> audit;

  bool isKnown() {
    const std::lock_guard lock(mutex);
    return audit.has_value();
  }
  const analysis::StudyAudit& get(const base::Progress& progress) {
    const std::lock_guard lock(mutex);
    if (!audit) {
      progress.check();
      audit.emplace(*study, base::Threads{}, progress);
    }
    return *audit;
  }
};

namespace {

/// Share of the whole that the rest state takes when it is not known yet.
constexpr double restShare = 0.5;

analysis::DeformationTables measure(const analysis::LoadedStudy& study, const analysis::StudyAudit& audit,
                                    std::vector<std::string> poses, std::vector<viscera::OrganModel> models,
                                    const base::Progress& progress) {
  analysis::DeformationTables tables;
  for (const auto& organ : study.organs) {
    tables.organs.push_back(organ->name);
  }
  tables.poses = std::move(poses);
  tables.models = std::move(models);
  tables.restRoom = audit.restRoom();
  std::optional<analysis::PosedScene> scene;
  const double steps = static_cast<double>(tables.poses.size() * tables.models.size());
  for (std::size_t p = 0; p < tables.poses.size(); ++p) {
    progress.check();
    const analysis::NamedPose pose = analysis::resolvePose(study, tables.poses[p]);
    if (scene) {
      scene->move(pose.pose, base::Threads{});
    } else {
      scene.emplace(study, tables.models, pose.pose, raycast::SceneUse::manyFrames, base::Threads{});
    }
    for (std::size_t m = 0; m < tables.models.size(); ++m) {
      const auto step = static_cast<double>(p * tables.models.size() + m);
      tables.rows.push_back(
          audit.measure(*scene, m, base::Threads{}, progress.part(step / steps, (step + 1.0) / steps)));
      tables.rows.back().pose = p;
      progress.report((step + 1.0) / steps);
    }
    tables.rooms.push_back(audit.room(*scene));
  }
  return tables;
}

}  // namespace

DeformationController::DeformationController(document::StudyDocument& document, QObject* parent)
    : QObject(parent), document_(document) {
  qRegisterMetaType<std::shared_ptr<const lorica::jobs::DeformationReport>>();
  // Numbers of a study that is gone are of no use to anybody.
  connect(&document_, &document::StudyDocument::replaced, this, [this] {
    audit_.reset();
    if (job_ != nullptr) {
      abandon(job_, this);
      Q_EMIT ended();
    }
  });
}

DeformationController::~DeformationController() = default;

void DeformationController::start(std::vector<std::string> poses, std::vector<viscera::OrganModel> models) {
  const auto& study = document_.loaded();
  LORICA_CHECK(study != nullptr && !models.empty(), "a loaded study and a model");
  abandon(job_, this);
  if (audit_ == nullptr || audit_->study != study) {
    audit_ = std::make_shared<Audit>();
    audit_->study = study;
  }
  auto report = std::make_shared<DeformationReport>();
  report->study = study;
  const QString title =
      poses.size() == 1 ? tr("Measuring deformation") : tr("Measuring deformation in %1 poses").arg(poses.size());
  job_ = std::make_unique<Job>(title, [report, audit = audit_, poses = std::move(poses),
                                       models = std::move(models)](const base::Progress& progress) {
    const double begin = audit->isKnown() ? 0.0 : restShare;
    const analysis::StudyAudit& known = audit->get(progress.part(0.0, begin));
    report->tables = measure(*report->study, known, poses, models, progress.part(begin, 1.0));
  });
  connect(job_.get(), &Job::finished, this, [this, report] { Q_EMIT finished(report); });
  connect(job_.get(), &Job::failed, this, &DeformationController::failed);
  connect(job_.get(), &Job::ended, this, [this, job = job_.get()] {
    if (job_.get() == job) {
      job_.release()->deleteLater();
      Q_EMIT ended();
    }
  });
  job_->start();
  Q_EMIT started();
}

void DeformationController::cancel() {
  if (job_ != nullptr) {
    job_->cancel();
  }
}

}  // namespace lorica::jobs
