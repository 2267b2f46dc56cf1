#include "lorica/jobs/study_loader.h"

#include "lorica/base/error.h"

namespace lorica::jobs {

StudyLoader::StudyLoader(document::StudyDocument& document, QObject* parent) : QObject(parent), document_(document) {
  timer_.setSingleShot(true);
  timer_.setInterval(0);
  connect(&timer_, &QTimer::timeout, this, &StudyLoader::start);
  connect(&document_, &document::StudyDocument::replaced, this, [this] {
    abandon();
    again_ = false;
    schedule();
  });
  connect(&document_, &document::StudyDocument::studyChanged, this, [this](document::Changes what) {
    // How things are drawn changes nothing that is loaded.
    if ((what & ~document::Changes(document::Change::display)) != document::Changes()) {
      schedule();
    }
  });
}

void StudyLoader::abandon() {
  if (job_ == nullptr) {
    return;
  }
  jobs::abandon(job_, this);
  Q_EMIT ended();
}

void StudyLoader::cancel() {
  if (job_ != nullptr) {
    job_->cancel();
  }
}

void StudyLoader::schedule() {
  if (job_ != nullptr) {
    again_ = true;
    return;
  }
  timer_.start();
}

void StudyLoader::start() {
  again_ = false;
  if (!document_.hasStudy()) {
    return;
  }
  struct Outcome {
    std::shared_ptr<const analysis::LoadedStudy> loaded;
    base::Issues trouble;
  };
  auto outcome = std::make_shared<Outcome>();
  job_ = std::make_unique<Job>(
      tr("Reading %1").arg(document_.displayName()), [outcome, study = document_.study(), file = document_.file(),
                                                      previous = document_.loaded()](const base::Progress& progress) {
        try {
          analysis::LoadOptions options;
          options.allModels = true;
          options.previous = previous.get();
          outcome->loaded =
              std::make_shared<const analysis::LoadedStudy>(analysis::load(study, file, {}, progress, options));
        } catch (const base::InputError& error) {
          outcome->trouble = {{base::Severity::error, error.file(), error.place(), error.text()}};
        }
      });
  connect(job_.get(), &Job::finished, this, [this, outcome] {
    if (outcome->loaded != nullptr) {
      document_.setProblems(outcome->loaded->issues);
      document_.setLoaded(outcome->loaded);
    } else {
      document_.setProblems(outcome->trouble);
    }
  });
  connect(job_.get(), &Job::cancelled, this, [this] {
    document_.setProblems(
        {{base::Severity::error, document_.file().string(), "",
          tr("reading was stopped; undo the last edit, or edit the study, to read it again").toStdString()}});
  });
  connect(job_.get(), &Job::failed, this, [this](const QString& text) {
    document_.setProblems({{base::Severity::error, document_.file().string(), "", text.toStdString()}});
  });
  connect(job_.get(), &Job::ended, this, [this] {
    job_.release()->deleteLater();
    if (again_) {
      schedule();
    }
    Q_EMIT ended();
  });
  job_->start();
  Q_EMIT started();
}

}  // namespace lorica::jobs
