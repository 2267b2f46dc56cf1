#pragma once

/// \file
/// How organs deform, in the view: what drives one of them, and what their colours say.

#include <QWidget>
#include <array>

#include "lorica/document/study_document.h"

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QStackedWidget;

namespace lorica::panels {

class InspectionPanel : public QWidget {
  Q_OBJECT

 public:
  explicit InspectionPanel(document::StudyDocument& document, QWidget* parent = nullptr);

 private:
  QWidget* makeDrivers();
  QWidget* makeColours();
  void refillOrgans();
  void follow();
  void take();

  document::StudyDocument& document_;
  QStackedWidget* pages_;
  QComboBox* organ_ = nullptr;
  std::array<QCheckBox*, 5> drivers_{};
  QButtonGroup* colours_ = nullptr;
};

}  // namespace lorica::panels
