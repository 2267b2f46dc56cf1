#pragma once

/// \file
/// Forms of what a run shoots from, and of what it works out.

#include <map>
#include <optional>

#include "lorica/panels/property_form.h"

namespace lorica::panels {

/// A source as its form has it. What a study can hold goes to the study at once, by a command; what it cannot stays
/// here, with a sentence that says why, until it is mended or the study's source changes otherwise.
class SourceDraft {
 public:
  /// \param name of the source, asked for at every use \pre the document outlives it
  SourceDraft(document::StudyDocument& document, std::function<std::string()> name);

  const study::Source& source();
  /// What is wrong with a field, or with what a run would make of it; empty: nothing.
  QString troubleOf(const QString& field);
  /// Whether the study does not have what the form shows.
  bool isPending();
  enum class Drag { no, yes };
  /// \param field as in commands::sourceTroubles(), or any other name \param label of it, for the undo menu
  /// \param drag whether edits of the field in a row are one step
  void edit(const QString& field, const QString& label, const std::function<void(study::Source&)>& change,
            Drag drag = Drag::no);
  /// Takes the shots of a file, or says why not.
  void setFile(const QString& file);
  /// Called after every edit, taken or not.
  void onEdit(std::function<void()> told) { told_ = std::move(told); }

 private:
  void settle();

  document::StudyDocument& document_;
  std::function<std::string()> name_;
  study::Source base_;  ///< the study's, when the draft began
  std::optional<study::Source> draft_;
  std::map<QString, QString> troubles_;
  std::function<void()> told_;
};

/// Rows of a source of any type. \param draft lives as long as the form
void addSourceRows(PropertyForm& form, const std::shared_ptr<SourceDraft>& draft);
/// Rows of a run: trials, seed, organ models.
void addRunRows(PropertyForm& form);
/// Rows of when trials are enough.
void addStopRows(PropertyForm& form);
/// Rows of what a run works out beside the coverage, and of who owns what structures share.
void addAnalysesRows(PropertyForm& form);

/// What all shots of a source make, in words: "0.0213 sr of solid angle".
QString measureText(const shotline::Measure& measure);
/// A source as a run will use it, when that is known of the study as it is now.
const analysis::ShotSource* plannedSource(const document::StudyDocument& document, const std::string& name);

}  // namespace lorica::panels
