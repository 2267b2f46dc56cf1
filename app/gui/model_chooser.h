#pragma once

#include <QComboBox>
#include <QWidget>

#include "lorica/document/study_document.h"

namespace lorica::gui {

/// Which organ models the view shows: one, or two side by side.
class ModelChooser : public QWidget {
  Q_OBJECT

 public:
  explicit ModelChooser(document::StudyDocument& document, QWidget* parent = nullptr);

 private:
  void follow();
  void choose();

  document::StudyDocument& document_;
  QComboBox* first_;
  QComboBox* second_;
};

}  // namespace lorica::gui
