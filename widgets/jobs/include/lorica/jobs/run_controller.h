#pragma once

/// \file
/// Runs the document's study and keeps the result in the document.

#include <QObject>
#include <memory>

#include "lorica/document/study_document.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

class RunController : public QObject {
  Q_OBJECT

 public:
  explicit RunController(document::StudyDocument& document, QObject* parent = nullptr);

  /// Starts a run of all the study says. \return empty, or one sentence that says why it cannot be run
  QString start();
  /// Why a run cannot start now, one sentence; empty when it can.
  QString trouble() const;
  /// The run that goes on; null when none does.
  Job* job() const { return job_.get(); }
  void cancel();
  /// All shots of a run: sources, poses and trials together, without those that a rule for stopping adds. Grids and
  /// lists have their own numbers, which a plan knows. \param plan may be null
  static double totalShots(const study::Study& study, const document::RunPlan* plan);

 Q_SIGNALS:
  void started();
  /// A run was added to the document, whole or partial.
  void finished(bool partial);
  void failed(QString text);
  /// Nothing runs any more, whatever the outcome.
  void ended();

 private:
  document::StudyDocument& document_;
  std::unique_ptr<Job> job_;
};

/// Measures how fast shots are traced here, on a copy of nothing: a short burst at one pose.
struct SpeedEstimate {
  double shotsPerSecond = 0.0;
  double secondsPerPose = 0.0;  ///< posing and building the scene
};
/// \throw base::InputError, base::Cancelled. Takes about a second; not for the window's thread.
SpeedEstimate measureSpeed(const analysis::LoadedStudy& study, const base::Progress& progress);

}  // namespace lorica::jobs
