#pragma once

/// \file
/// Looks into single shots of the planned run, off the window's thread.

#include <QObject>
#include <memory>

#include "lorica/analysis/shot_report.h"
#include "lorica/document/study_document.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

/// All that one shot goes through in one pose.
struct ShotInspection {
  std::shared_ptr<const document::RunPlan> plan;
  analysis::ShotName name;
  analysis::ShotDetails details;
};

class ShotInspector : public QObject {
  Q_OBJECT

 public:
  explicit ShotInspector(QObject* parent = nullptr);
  /// Looks into a shot at a pose; what was asked for before is given up. \pre the plan has no trouble
  void request(std::shared_ptr<const document::RunPlan> plan, const analysis::ShotName& name, const std::string& pose);
  /// ready() comes for nothing that was asked for before.
  void abandon();
  bool isBusy() const { return job_ != nullptr; }

 Q_SIGNALS:
  void ready(std::shared_ptr<const lorica::jobs::ShotInspection> inspection);
  /// There is no such shot, or no such pose; one sentence.
  void failed(QString text);

 private:
  std::unique_ptr<Job> job_;
};

}  // namespace lorica::jobs
