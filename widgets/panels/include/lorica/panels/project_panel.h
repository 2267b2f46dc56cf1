#pragma once

/// \file
/// The project's tree in a dock.

#include <QHash>
#include <QWidget>

#include "lorica/models/project_model.h"

class QAction;
class QLabel;
class QMenu;
class QSlider;
class QStackedWidget;
class QTreeView;

namespace lorica::panels {

/// Shows, selects, renames and removes what the study holds; its selection is the document's.
class ProjectPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ProjectPanel(document::StudyDocument& document, QWidget* parent = nullptr);

  QTreeView& tree() const { return *tree_; }
  models::ProjectModel& model() const { return *model_; }
  /// Fills a menu with what can be done to the current row.
  void fillMenu(QMenu& menu);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* makeOpacityRow();
  void connectAll();

  QModelIndex current() const;
  std::optional<document::ItemRef> currentItem() const;
  /// The body, organ or piece of the current row.
  std::optional<std::string> currentStructure() const;

  void takeSelection();
  void giveSelection();
  void restoreExpansion();
  void updateState();
  void fillDriverMenu(QMenu& menu, const std::string& organ);
  void showOnlyCurrent();
  void chooseColour();
  void resetLook();
  void removeCurrent();

  document::StudyDocument& document_;
  models::ProjectModel* model_;
  QTreeView* tree_;
  QStackedWidget* pages_;
  QSlider* opacity_ = nullptr;
  QLabel* opacityValue_ = nullptr;
  QWidget* opacityRow_ = nullptr;
  QAction* rename_;
  QAction* remove_;
  QHash<QString, bool> expanded_;  ///< by ProjectModel::keyRole
  bool following_ = false;         ///< the selection comes from the document
};

}  // namespace lorica::panels
