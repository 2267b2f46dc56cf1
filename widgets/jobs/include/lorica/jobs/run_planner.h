#pragma once

/// \file
/// Finds out what a run of the loaded study would shoot from, whenever that changes, and gives it to the document.

#include <QObject>
#include <memory>

#include "lorica/document/study_document.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

class RunPlanner : public QObject {
  Q_OBJECT

 public:
  /// \pre the document outlives it
  explicit RunPlanner(document::StudyDocument& document, QObject* parent = nullptr);
  /// Whether the plan of the loaded study is still being made.
  bool isBusy() const { return job_ != nullptr; }

 private:
  void start();

  document::StudyDocument& document_;
  std::unique_ptr<Job> job_;
};

/// The plan of a study, or what keeps it from being run. \throw base::Cancelled
document::RunPlan planOf(const std::shared_ptr<const analysis::LoadedStudy>& study, const base::Progress& progress);

}  // namespace lorica::jobs
