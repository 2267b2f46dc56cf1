#pragma once

/// \file
/// What the window works on: the study, its file, the undo stack, the selection, what is shown, and the runs made of
/// it. Views read it and listen; only commands (lorica/commands) change the study. Everything here belongs to the
/// window's thread.

#include <QFlags>
#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lorica/analysis/results.h"
#include "lorica/document/inspection.h"
#include "lorica/document/item_ref.h"
#include "lorica/study/study.h"

class QUndoStack;

namespace lorica::commands {
class StudyCommand;
}

namespace lorica::document {

/// What of the study an edit touched.
enum class Change : unsigned {
  general = 1,   ///< name, description
  human = 2,     ///< the body, spacing of interior sites
  organs = 4,    ///< meshes, lattices, joints, classes, names
  armor = 8,     ///< systems and pieces
  poses = 16,    ///< poses and which of them are run
  sources = 32,  ///< sources of shots
  run = 64,      ///< models, trials, seed, rule for stopping, overlaps, analyses
  display = 128  ///< visibility, colour, opacity
};
Q_DECLARE_FLAGS(Changes, Change)
Q_DECLARE_OPERATORS_FOR_FLAGS(Changes)
inline constexpr Changes everything = Changes(QFlag(255));

/// A run made in this window, with the study it was made of.
struct RunRecord {
  std::string name;  ///< "Run 1", "Run 2", ...
  std::shared_ptr<const analysis::LoadedStudy> study;
  analysis::RunResult result;
  std::vector<analysis::ResultRow> summary;  ///< analysis::summaryRows()
};

/// What a run of a loaded study would shoot from, or why there can be none.
struct RunPlan {
  std::shared_ptr<const analysis::LoadedStudy> study;
  analysis::RunResult result;          ///< without trials; empty when there is trouble
  std::optional<base::Issue> trouble;  ///< with its place in the study file
};

/// Only commands can make one.
class EditKey {
  friend class commands::StudyCommand;
  EditKey() = default;
};

class StudyDocument : public QObject {
  Q_OBJECT

 public:
  explicit StudyDocument(QObject* parent = nullptr);
  ~StudyDocument() override;

  /// False in the empty state, before anything was opened.
  bool hasStudy() const { return hasStudy_; }
  const study::Study& study() const { return study_; }
  /// Where relative inputs start: the file the study was read from, or the one suggested for it. Stays the same until
  /// another study comes, wherever this one is saved, so that undo never brings back paths of another folder.
  const std::filesystem::path& file() const { return file_; }
  /// The file on disk that holds (or held) this study, absolute; empty when it has none yet.
  const std::filesystem::path& savedFile() const { return savedFile_; }
  /// Whether there is a savedFile(), so that `save` needs no name.
  bool hasFile() const { return !savedFile_.empty(); }
  /// The undo stack is not where it was saved, or the study was never saved. Up to date when fileChanged() is emitted;
  /// studyChanged() comes earlier.
  bool isModified() const;
  /// What the window's title says of the document: the file's name, or the study's, or "untitled". Empty without a
  /// study.
  QString displayName() const;
  QUndoStack& undoStack() const { return *undoStack_; }

  /// Takes a study that has no file yet. \param suggestedFile where relative inputs start
  void setStudy(study::Study study, const std::filesystem::path& suggestedFile);
  /// Reads a study file. \throw base::InputError; then the document stays as it was
  void open(const std::filesystem::path& file);
  /// The same for a study that a crash left behind: it is modified, and `file` may not exist.
  /// \param hadFile `save` writes to that file
  void restore(study::Study study, const std::filesystem::path& file, bool hadFile);
  /// Writes to savedFile(). \pre hasFile() \throw base::InputError; then the document stays modified
  void save();
  /// Writes to another file, which becomes savedFile(). What is written has paths of inputs relative to its folder.
  /// \throw base::InputError; then the document stays as it was
  void saveAs(const std::filesystem::path& file);
  void close();

  const std::optional<ItemRef>& selection() const { return selection_; }
  void select(std::optional<ItemRef> item);

  /// Name of the pose that is shown: "rest", a pose of the study, or CLIP@SECONDS.
  const std::string& shownPose() const { return shownPose_; }
  /// \pre one of these
  void showPose(std::string pose);
  /// Organ models that are shown: one, or two side by side.
  const std::vector<viscera::OrganModel>& shownModels() const { return shownModels_; }
  /// \pre one or two different models
  void showModels(std::vector<viscera::OrganModel> models);
  /// What is looked at of how organs deform. A removed organ is looked into no more, a renamed one still is.
  const Inspection& inspection() const { return inspection_; }
  /// \pre the organ is one of the study's, or none
  void inspect(Inspection inspection);

  /// The study read and bound, as last it could be; null before. May lag behind study() while it is read again.
  const std::shared_ptr<const analysis::LoadedStudy>& loaded() const { return loaded_; }
  void setLoaded(std::shared_ptr<const analysis::LoadedStudy> loaded);
  /// How the loaded study would be run, as last it was found out; null before. May lag behind loaded().
  const std::shared_ptr<const RunPlan>& plan() const { return plan_; }
  void setPlan(std::shared_ptr<const RunPlan> plan);
  /// What is odd or wrong with the study: issues of loading, or the error that kept it from being loaded.
  const base::Issues& problems() const { return problems_; }
  void setProblems(base::Issues problems);

  const std::vector<std::shared_ptr<const RunRecord>>& runs() const { return runs_; }
  /// Names the run and keeps it.
  void addRun(std::shared_ptr<const analysis::LoadedStudy> study, analysis::RunResult result);

  /// Changes the study and tells everybody. A selection, shown pose or inspected organ that is gone is dropped before
  /// anybody is told.
  void edit(EditKey, Changes what, const std::function<void(study::Study&)>& change);

 Q_SIGNALS:
  /// Another study is here, or none: forget everything about the last one. `studyChanged(everything)` follows.
  void replaced();
  void studyChanged(lorica::document::Changes what);
  /// The file's name or isModified() changed.
  void fileChanged();
  void selectionChanged();
  void shownPoseChanged();
  void shownModelsChanged();
  void inspectionChanged();
  void loadedChanged();
  void planChanged();
  void problemsChanged();
  void runsChanged();

 private:
  void replace(std::optional<study::Study> study, const std::filesystem::path& file, bool hasFile, bool neverSaved);
  void writeTo(const std::filesystem::path& file);
  bool dropStaleSelection();

  study::Study study_;
  std::filesystem::path file_;
  std::filesystem::path savedFile_;
  bool hasStudy_ = false;
  bool neverSaved_ = false;
  QUndoStack* undoStack_;
  std::optional<ItemRef> selection_;
  std::string shownPose_ = "rest";
  std::vector<viscera::OrganModel> shownModels_{viscera::OrganModel::dynamic};
  Inspection inspection_;
  std::shared_ptr<const analysis::LoadedStudy> loaded_;
  std::shared_ptr<const RunPlan> plan_;
  base::Issues problems_;
  std::vector<std::shared_ptr<const RunRecord>> runs_;
};

/// Whether two studies give the same tables: the name of the whole, descriptions, what armor is made of, and how things
/// are drawn, change no number.
bool sameNumbers(const study::Study& a, const study::Study& b);

/// Whether the study (or the body, or the runs) has such an item. Regions are known while a study is loaded.
bool exists(const StudyDocument& document, const ItemRef& item);

}  // namespace lorica::document
