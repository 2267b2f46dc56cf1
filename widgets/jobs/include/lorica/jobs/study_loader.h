#pragma once

/// \file
/// Keeps the document's loaded study in step with its study: reads and binds again what an edit changed, off the
/// window's thread.

#include <QObject>
#include <QTimer>
#include <memory>

#include "lorica/document/study_document.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

class StudyLoader : public QObject {
  Q_OBJECT

 public:
  explicit StudyLoader(document::StudyDocument& document, QObject* parent = nullptr);

  /// The job that loads; null when the loaded study is in step.
  Job* job() const { return job_.get(); }
  /// Stops reading; the problems then say that the study is not read, until an edit or another study is.
  void cancel();
  bool isInStep() const { return job_ == nullptr && !again_ && !timer_.isActive(); }

 Q_SIGNALS:
  void started();
  void ended();

 private:
  void schedule();
  void start();
  void abandon();

  document::StudyDocument& document_;
  QTimer timer_;
  std::unique_ptr<Job> job_;
  bool again_ = false;
};

}  // namespace lorica::jobs
