#pragma once

/// \file
/// What the forms of analyses have in common: lists of structures to tick, and edits that a study can hold.

#include "item_form_parts.h"

class QListWidget;

namespace lorica::panels {

using Names = std::vector<std::string>;

bool holdsName(const Names& names, const std::string& name);
Names namesOf(const std::vector<study::Organ>& organs);
/// The organs that matter most: those of the class `essential`, else the first.
Names organsToWatch(const study::Study& study);

/// A short list. \param label what a screen reader says of it
QListWidget* makeNameList(PropertyForm& form, const char* id, const QString& label);
/// A row of names to tick; while there is only one, it cannot be unticked. Names that are chosen and not offered are
/// marked as such. \param set given what is ticked, in the order of the list
QListWidget* addTickedNames(PropertyForm& form, const Field& field, std::function<Names()> offered,
                            std::function<Names()> chosen, std::function<void(const Names&)> set);

/// Changes a copy of the analyses; what no study can hold is the row's to prevent.
void editAnalyses(document::StudyDocument& document, const std::function<void(study::Analyses&)>& change);

/// Where shots get past the armor.
void addGapRows(PropertyForm& form);
/// How far coverage is open because nobody knows where organs lie.
void addAnatomyRows(PropertyForm& form);

}  // namespace lorica::panels
