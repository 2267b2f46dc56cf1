#pragma once

/// \file
/// Things of a study by their names.

#include <QCoreApplication>
#include <algorithm>
#include <string>

#include "lorica/base/error.h"
#include "lorica/study/study.h"

namespace lorica::commands {

/// Names of the edits, for the undo menu.
struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::commands)
};

inline QString shown(const std::string& name) {
  return QString::fromStdString(name);
}

/// The item of that name in a list, const or not. \pre there is one
template <class Items>
auto& named(Items& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  LORICA_CHECK(found != items.end(), "the study has nothing of this name");
  return *found;
}

template <class Items>
bool hasNamed(const Items& items, const std::string& name) {
  return std::any_of(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
}

/// The system with that piece. \pre there is one
template <class AnyStudy>
auto& systemWith(AnyStudy& study, const std::string& piece) {
  const auto found = std::find_if(study.systems.begin(), study.systems.end(),
                                  [&](const auto& system) { return hasNamed(system.pieces, piece); });
  LORICA_CHECK(found != study.systems.end(), "the study has no armor piece of this name");
  return *found;
}

/// Whether a study file takes the text for a name: UTF-8, not empty, without control characters.
bool isName(const std::string& text);

/// Displays in the order things are drawn, those of unknown structures last, without those that say nothing beyond
/// the default.
std::vector<study::Display> minimalDisplays(const study::Study& study, std::vector<study::Display> displays);

}  // namespace lorica::commands
