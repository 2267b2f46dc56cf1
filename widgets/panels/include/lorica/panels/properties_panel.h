#pragma once

/// \file
/// What is selected, as a form: its facts, and editors for what can be changed.

#include <QScrollArea>
#include <optional>

#include "lorica/document/study_document.h"

namespace lorica::panels {

class PropertyForm;

class PropertiesPanel : public QScrollArea {
  Q_OBJECT

 public:
  explicit PropertiesPanel(document::StudyDocument& document, QWidget* parent = nullptr);
  /// The form that is shown; null while nothing is selected.
  PropertyForm* form() const { return form_; }
  QSize sizeHint() const override;

 Q_SIGNALS:
  /// Another person is wanted for the built-in human.
  void personRequested();

 private:
  void rebuild();
  void refresh();

  document::StudyDocument& document_;
  std::optional<document::ItemRef> item_;  ///< what the form is for
  PropertyForm* form_ = nullptr;
};

}  // namespace lorica::panels
