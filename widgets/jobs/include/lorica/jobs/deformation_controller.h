#pragma once

/// \file
/// Measures how the organs of the document's loaded study deform.

#include <QObject>
#include <memory>
#include <string>
#include <vector>

#include "lorica/analysis/deformation.h"
#include "lorica/document/study_document.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

/// What was measured, with the study it was measured on.
struct DeformationReport {
  std::shared_ptr<const analysis::LoadedStudy> study;
  analysis::DeformationTables tables;
};

class DeformationController : public QObject {
  Q_OBJECT

 public:
  explicit DeformationController(document::StudyDocument& document, QObject* parent = nullptr);
  ~DeformationController() override;

  /// Measures these poses and models; what goes on is given up. The rest state of a study is measured once.
  /// \pre the document's study is loaded, models is not empty
  void start(std::vector<std::string> poses, std::vector<viscera::OrganModel> models);
  /// The job that measures; null when none does.
  Job* job() const { return job_.get(); }
  /// Asks it to stop; what it had found is dropped.
  void cancel();

 Q_SIGNALS:
  void started();
  void finished(std::shared_ptr<const lorica::jobs::DeformationReport> report);
  void failed(QString text);
  /// Nothing is measured any more, whatever the outcome.
  void ended();

 private:
  struct Audit;

  document::StudyDocument& document_;
  std::shared_ptr<Audit> audit_;  ///< of the last study
  std::unique_ptr<Job> job_;
};

}  // namespace lorica::jobs
