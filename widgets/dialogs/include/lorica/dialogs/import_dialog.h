#pragma once

/// \file
/// Makes a study of mesh files, or adds them to the open one. Files are read beside the window as they are chosen, so
/// that what was understood is seen before it is accepted.

#include <QDialog>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "lorica/analysis/import_study.h"
#include "lorica/dialogs/file_kinds.h"
#include "lorica/document/study_document.h"
#include "lorica/jobs/job.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QRadioButton;

namespace lorica::dialogs {

class ImportFileTable;
class ImportPreview;

class ImportDialog : public QDialog {
  Q_OBJECT

 public:
  /// \pre document outlives the dialog and is not changed while it is open
  explicit ImportDialog(const document::StudyDocument& document, QWidget* parent = nullptr);
  ~ImportDialog() override;

  /// Adds files and guesses what they hold. Those of unknown kinds are refused with a sentence.
  void addFiles(const std::vector<std::filesystem::path>& files);
  /// What the files are taken for, in the order of the list.
  std::vector<FileRole> roles() const;
  void setRole(std::size_t file, FileRole role);

  bool addsToOpenStudy() const;
  /// What was read. \pre the dialog was accepted
  study::Study study() const;
  /// Where a new study's inputs start, a name that is free: beside the skin. For additions, the document's file.
  std::filesystem::path suggestedFile() const { return studyFile_; }
  /// Name of the edit, e.g. "Add 2 organs and 1 armor piece". \pre the dialog was accepted and addsToOpenStudy()
  QString addText() const;

 public Q_SLOTS:
  void accept() override;

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QWidget* makeModeRow();
  QWidget* makeFileTable();
  QWidget* makeOptions();
  QWidget* makePreview();
  void guess();
  void changed();
  QString trouble() const;
  analysis::ImportRequest request() const;
  void read();
  void readEnded();
  void showState();
  void chooseFiles();
  void removeChosen();

  const document::StudyDocument& document_;
  QString refused_;
  std::filesystem::path studyFile_;
  std::optional<analysis::ImportedStudy> imported_;
  QString failure_;  ///< why the last reading ended without a study
  std::unique_ptr<jobs::Job> job_;
  QTimer delay_;
  bool again_ = false;

  QRadioButton* newStudy_ = nullptr;
  QRadioButton* openStudy_ = nullptr;
  ImportFileTable* files_ = nullptr;
  QPushButton* remove_ = nullptr;
  QCheckBox* plates_ = nullptr;
  QCheckBox* split_ = nullptr;
  QComboBox* units_ = nullptr;
  QComboBox* up_ = nullptr;
  ImportPreview* preview_ = nullptr;
  QLabel* message_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QPushButton* cancelReading_ = nullptr;
  QPushButton* read_ = nullptr;
  QPushButton* accept_ = nullptr;
};

}  // namespace lorica::dialogs
