#pragma once

/// \file
/// What the forms of things have in common: finding a thing by its name, how it is written, rows that several have.

#include <QCoreApplication>
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lorica/panels/property_form.h"

namespace lorica::panels {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::panels::PropertiesPanel)
};

template <class Named>
const Named* findNamed(const std::vector<Named>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const Named& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

template <class Named>
const Named* findNamed(const std::vector<std::shared_ptr<const Named>>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item->name == name; });
  return found == items.end() ? nullptr : found->get();
}

/// The thing of that name, or an empty one: forms are drawn once more after their thing is gone.
template <class Named>
const Named& namedOrNone(const std::vector<Named>& items, const std::string& name) {
  static const Named none;
  const Named* found = findNamed(items, name);
  return found == nullptr ? none : *found;
}

inline QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

/// Stands for a value that is not known.
QString unknown();
/// Where a mesh comes from, and which parts of it are taken.
QString sourceText(const study::MeshSource& mesh);
QString partsText(const study::MeshSource& mesh);
/// \param squareMetres shown in cm²
QString areaText(double squareMetres);

/// A mesh at rest with its topology; null: not loaded.
using FindMesh = std::function<std::pair<const geometry::TriangleMesh*, const raycast::MeshTopology*>()>;
/// Triangles, closed or open, volume, area. Computed once for every mesh, not for every refresh.
void addMeshRows(PropertyForm& form, FindMesh find);
/// Visible, colour, opacity. \param structure "body", an organ or a piece
void addLookRows(PropertyForm& form, const std::string& structure);
/// The name: to edit where it can be changed. What is wrong with a name is said below it.
void addNameRow(PropertyForm& form, const document::ItemRef& item);
void addDescriptionRow(PropertyForm& form, const document::ItemRef& item, const std::function<std::string()>& get);

}  // namespace lorica::panels
