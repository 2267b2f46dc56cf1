#pragma once

/// \file
/// Edits of where shots come from and of what a run works out: undoable steps, as those of lorica/commands/edits.h.

#include <QString>
#include <vector>

#include "lorica/commands/edits.h"

namespace lorica::commands {

/// Why a value cannot be taken: the field of the form it belongs to, and one sentence.
struct FieldTrouble {
  QString field;
  QString sentence;
};

// --- sources --------------------------------------------------------------------------------------------------------

/// The source as a study file holds it: what its type and its sampler do not use is as in a new one.
study::Source asWritten(study::Source source);
/// What of it a study cannot hold; fields are named shots, width, height, radius, azimuth, elevation, cell
/// and file.
std::vector<FieldTrouble> sourceTroubles(const study::Source& source);
/// Sets the whole of a source but its name.
/// \param field what is edited: edits of one in a row may merge
/// \param text for the undo menu, e.g. "Width of source front"
/// \pre no sourceTroubles
void setSource(StudyDocument& document, const std::string& name, const study::Source& source, const QString& field,
               const QString& text, Merge merge);
/// The source as another type, with sizes, angles and a place to start from.
study::Source asType(study::Source source, study::SourceType type);
/// Adds a copy under a name of its own, selects and returns it.
std::string duplicateSource(StudyDocument& document, const std::string& name);
/// A file of shots as the study names it, with the hash it has now. \throw base::InputError when it holds no shots
study::InputFile shotListInput(const StudyDocument& document, const std::filesystem::path& file);

// --- runs -----------------------------------------------------------------------------------------------------------

std::vector<FieldTrouble> stopTroubles(const study::StopRule& stop);
/// None: as many trials as the study says. \pre no stopTroubles
void setStop(StudyDocument& document, const std::optional<study::StopRule>& stop);
/// The order is kept for the policy `priority` alone. \pre each name once
void setOverlap(StudyDocument& document, const study::Overlap& overlap);
std::vector<FieldTrouble> analysesTroubles(const study::Analyses& analyses);
/// \pre no analysesTroubles
void setAnalyses(StudyDocument& document, const study::Analyses& analyses);

}  // namespace lorica::commands
