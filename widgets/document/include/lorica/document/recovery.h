#pragma once

/// \file
/// Autosave and recovery. While a document has unsaved edits its study is written to a recovery file of its own, at
/// most `delay` after an edit; saving or closing removes it. A file whose program is gone is what a crash left behind.
/// To take one over without a gap: StudyDocument::restore(), Autosave::writeNow(), discardRecovered().

#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "lorica/document/study_document.h"

namespace lorica::document {

class Autosave : public QObject {
  Q_OBJECT

 public:
  /// \param folder holds recovery files of all windows; made when it is missing
  Autosave(StudyDocument& document, const std::filesystem::path& folder, QObject* parent = nullptr);
  ~Autosave() override;

  /// The user's folder for recovery files.
  static std::filesystem::path defaultFolder();
  /// How long an edit may stay unwritten; 5 s unless it is set.
  void setDelay(std::chrono::milliseconds delay);
  /// Writes now, if there is something to lose.
  void writeNow();

 Q_SIGNALS:
  /// The recovery file could not be written; one sentence. Tried again after every delay, but said only once until it
  /// works again or another study comes.
  void failed(QString text);

 private:
  void documentChanged();
  void write();
  void remove();

  StudyDocument& document_;
  std::filesystem::path file_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  bool failing_ = false;
};

/// A study that a crash left behind.
struct Recovered {
  std::filesystem::path recoveryFile;
  study::Study study;
  std::filesystem::path file;  ///< where relative inputs start
  bool hadFile = false;        ///< `file` was the document's file on disk
  std::string when;            ///< of the last write, local time, readable
  /// While it is held no other window is offered the same file.
  std::shared_ptr<QLockFile> claim;
};

/// Recovery files in the folder whose program is gone and that nobody has claimed, newest first. Damaged ones are
/// skipped.
std::vector<Recovered> findRecovered(const std::filesystem::path& folder);
/// Removes a recovery file and its lock.
void discardRecovered(const Recovered& recovered);

}  // namespace lorica::document
