#include "lorica/panels/project_panel.h"

#include <QAction>
#include <QColorDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedWidget>
#include <QStyledItemDelegate>
#include <QToolTip>
#include <QTreeView>
#include <algorithm>

#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "lorica/models/model_texts.h"
#include "panel_parts.h"

namespace lorica::panels {

using document::ItemKind;
using document::ItemRef;
using models::ProjectModel;
using models::Section;

namespace {

std::array<std::uint8_t, 3> bytesOf(const QColor& colour) {
  return {static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
          static_cast<std::uint8_t>(colour.blue())};
}

/// Details are cut at their end; what matters most stands first.
class DetailsDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    option->textElideMode = Qt::ElideRight;
  }
};

/// Renames once the editor has closed: a new name makes the tree anew, and the editor with it.
class RenameDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
    const QVariant name = editor->property("text");
    QMetaObject::invokeMethod(
        model, [model, name, at = QPersistentModelIndex(index)] { model->setData(at, name); }, Qt::QueuedConnection);
  }
};

}  // namespace

ProjectPanel::ProjectPanel(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), model_(new ProjectModel(document, this)) {
  tree_ = new QTreeView(this);
  tree_->setObjectName(QStringLiteral("project"));
  tree_->setModel(model_);
  tree_->setUniformRowHeights(true);
  tree_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  tree_->setExpandsOnDoubleClick(false);
  tree_->setTextElideMode(Qt::ElideMiddle);
  tree_->setIndentation(fontMetrics().height());
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(ProjectModel::nameColumn, QHeaderView::Stretch);
  tree_->setColumnWidth(ProjectModel::detailsColumn, fontMetrics().averageCharWidth() * 18);

  rename_ = new QAction(tr("Rename"), this);
  rename_->setShortcut(Qt::Key_F2);
  remove_ = new QAction(tr("Remove"), this);
  remove_->setShortcut(QKeySequence::Delete);
  rename_->setShortcutContext(Qt::WidgetShortcut);
  remove_->setShortcutContext(Qt::WidgetShortcut);
  tree_->addAction(rename_);
  tree_->setItemDelegateForColumn(ProjectModel::nameColumn, new RenameDelegate(tree_));
  tree_->setItemDelegateForColumn(ProjectModel::detailsColumn, new DetailsDelegate(tree_));

  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(panelMargin);
  column->addWidget(tree_, 1);
  opacityRow_ = makeOpacityRow();
  column->addWidget(opacityRow_);
  pages_ = new QStackedWidget(this);
  pages_->addWidget(
      panels::makeEmptyPage(tr("No study is open.\nOpen a study, import your files, or start with the sample."), this));
  pages_->addWidget(content);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  layout->addWidget(pages_);

  connectAll();
  restoreExpansion();
  takeSelection();
  updateState();
}

QWidget* ProjectPanel::makeOpacityRow() {
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(panelMargin);
  auto* title = new QLabel(tr("Opacity"), row);
  opacity_ = new QSlider(Qt::Horizontal, row);
  opacity_->setObjectName(QStringLiteral("opacity"));
  opacity_->setRange(0, 100);
  opacity_->setPageStep(10);
  opacity_->setToolTip(tr("Opacity of the selected structure, in percent"));
  opacityValue_ = new QLabel(row);
  opacityValue_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  opacityValue_->setMinimumWidth(fontMetrics().horizontalAdvance(tr("%1 %").arg(100)));
  title->setBuddy(opacity_);
  layout->addWidget(title);
  layout->addWidget(opacity_, 1);
  layout->addWidget(opacityValue_);
  return row;
}

void ProjectPanel::connectAll() {
  connect(tree_->selectionModel(), &QItemSelectionModel::currentChanged, this, &ProjectPanel::giveSelection);
  connect(&document_, &document::StudyDocument::selectionChanged, this, &ProjectPanel::takeSelection);
  connect(model_, &ProjectModel::modelAboutToBeReset, this, [this] { following_ = true; });
  connect(model_, &ProjectModel::modelReset, this, [this] {
    following_ = false;
    restoreExpansion();
    takeSelection();
    updateState();
  });
  connect(model_, &ProjectModel::dataChanged, this, &ProjectPanel::updateState);
  connect(model_, &ProjectModel::renameRefused, this, [this](const QString& text) {
    QToolTip::showText(tree_->viewport()->mapToGlobal(tree_->visualRect(current()).bottomLeft()), text, tree_);
  });
  const auto remember = [this](bool expanded) {
    return [this, expanded](const QModelIndex& index) {
      expanded_[index.data(ProjectModel::keyRole).toString()] = expanded;
    };
  };
  connect(tree_, &QTreeView::expanded, this, remember(true));
  connect(tree_, &QTreeView::collapsed, this, remember(false));
  connect(tree_, &QTreeView::doubleClicked, this, [this](const QModelIndex& index) {
    const std::optional<ItemRef> item = model_->itemAt(index);
    if (item && item->kind == ItemKind::pose) {
      document_.showPose(item->name);
    } else {
      tree_->setExpanded(index.siblingAtColumn(0), !tree_->isExpanded(index.siblingAtColumn(0)));
    }
  });
  connect(tree_, &QTreeView::customContextMenuRequested, this, [this](const QPoint& point) {
    QMenu menu;
    fillMenu(menu);
    if (!menu.isEmpty()) {
      menu.exec(tree_->viewport()->mapToGlobal(point));
    }
  });
  connect(opacity_, &QSlider::valueChanged, this, [this](int percent) {
    if (const std::optional<std::string> structure = currentStructure()) {
      commands::setOpacity(document_, *structure, percent / 100.0);
    }
  });
  connect(rename_, &QAction::triggered, this, [this] { tree_->edit(current()); });
  onKey(*tree_, QKeySequence::Delete, [this] { removeCurrent(); });
  connect(remove_, &QAction::triggered, this, &ProjectPanel::removeCurrent);
}

void ProjectPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // Where there is room for one column alone, that is the names; tool tips hold the details.
  tree_->setColumnHidden(ProjectModel::detailsColumn, width() < fontMetrics().averageCharWidth() * 38);
}

QModelIndex ProjectPanel::current() const {
  return tree_->currentIndex().siblingAtColumn(ProjectModel::nameColumn);
}

std::optional<ItemRef> ProjectPanel::currentItem() const {
  return model_->itemAt(current());
}

std::optional<std::string> ProjectPanel::currentStructure() const {
  const std::optional<ItemRef> item = currentItem();
  if (!item || (item->kind != ItemKind::body && item->kind != ItemKind::organ && item->kind != ItemKind::piece)) {
    return std::nullopt;
  }
  return model_->structuresAt(current()).front();
}

void ProjectPanel::takeSelection() {
  const std::optional<ItemRef>& item = document_.selection();
  const QModelIndex index = item ? model_->indexOf(*item) : QModelIndex();
  // A section's head is nothing the document could select: it may stay current.
  if (!index.isValid() && current().isValid() && !currentItem()) {
    return;
  }
  const QScopedValueRollback<bool> guard(following_, true);
  if (index.isValid()) {
    tree_->setCurrentIndex(index);
    tree_->scrollTo(index);
  } else {
    tree_->setCurrentIndex(QModelIndex());
    tree_->clearSelection();
  }
  updateState();
}

void ProjectPanel::giveSelection() {
  if (!following_) {
    document_.select(currentItem());
    updateState();
  }
}

/// Sections and systems are open unless they were closed; the body's regions are many and stay closed.
void ProjectPanel::restoreExpansion() {
  const QSignalBlocker quiet(tree_);
  const auto restore = [this](const QModelIndex& index, bool open) {
    tree_->setExpanded(index, expanded_.value(index.data(ProjectModel::keyRole).toString(), open));
  };
  for (int row = 0; row < model_->rowCount(); ++row) {
    const QModelIndex head = model_->index(row, 0);
    restore(head, model_->sectionAt(head) != Section::body);
    for (int child = 0; child < model_->rowCount(head); ++child) {
      const QModelIndex below = model_->index(child, 0, head);
      if (model_->rowCount(below) > 0) {
        restore(below, true);
      }
    }
  }
}

void ProjectPanel::updateState() {
  pages_->setCurrentIndex(document_.hasStudy() ? 1 : 0);
  const std::optional<ItemRef> item = currentItem();
  const bool canEdit = item && commands::canRemove(*item);
  rename_->setEnabled(canEdit);
  remove_->setEnabled(canEdit);
  const std::optional<std::string> structure = currentStructure();
  opacityRow_->setEnabled(structure.has_value());
  const QSignalBlocker quiet(opacity_);
  const int percent = structure ? qRound(100.0 * document::appearanceOf(document_.study(), *structure).opacity) : 100;
  opacity_->setValue(percent);
  opacityValue_->setText(structure ? tr("%1 %").arg(percent) : QString());
}

void ProjectPanel::fillMenu(QMenu& menu) {
  const QModelIndex index = current();
  const std::optional<ItemRef> item = currentItem();
  if (!model_->structuresAt(index).empty()) {
    const bool shown = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    if (item) {
      menu.addAction(tr("Show only this"), this, &ProjectPanel::showOnlyCurrent);
    }
    menu.addAction(shown ? tr("Hide") : tr("Show"), this, [this, shown] {
      model_->setData(current(), shown ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
    });
    if (currentStructure()) {
      menu.addAction(tr("Colour..."), this, &ProjectPanel::chooseColour);
    }
    menu.addAction(tr("Reset look"), this, &ProjectPanel::resetLook);
  }
  if (item && item->kind == ItemKind::organ) {
    fillDriverMenu(*menu.addMenu(tr("What drives it")), item->name);
  }
  if (item && item->kind == ItemKind::pose) {
    QAction* show = menu.addAction(tr("Show this pose"), this, [this, name = item->name] { document_.showPose(name); });
    show->setEnabled(item->name != document_.shownPose());
    menu.setDefaultAction(show);
  }
  if (index.isValid() && model_->sectionAt(index) == Section::sources) {
    menu.addAction(tr("Add source"), this, [this] { commands::addSource(document_); });
  }
  if (item && commands::canRemove(*item)) {
    menu.addSeparator();
    menu.addAction(rename_);
    menu.addAction(remove_);
  }
}

void ProjectPanel::fillDriverMenu(QMenu& menu, const std::string& organ) {
  const document::Inspection& now = document_.inspection();
  const bool here = now.organ == organ;
  for (const models::DriverText& text : models::driverTexts()) {
    QAction* action = menu.addAction(text.label, this, [this, organ, here, driver = text.driver](bool on) {
      document::Inspection wanted = document_.inspection();
      // Another organ starts with what was asked for.
      wanted.drivers = here ? wanted.drivers : document::Drivers();
      wanted.organ = organ;
      wanted.drivers.setFlag(driver, on);
      document_.inspect(wanted);
    });
    action->setCheckable(true);
    action->setChecked(here && now.drivers.testFlag(text.driver));
    action->setToolTip(text.tip);
  }
  menu.addSeparator();
  QAction* nothing = menu.addAction(tr("Nothing"), this, [this] {
    document::Inspection wanted = document_.inspection();
    wanted.drivers = {};
    document_.inspect(wanted);
  });
  nothing->setEnabled(here && now.showsDrivers());
}

void ProjectPanel::showOnlyCurrent() {
  const std::vector<std::string> wanted = model_->structuresAt(current());
  std::vector<std::string> others = document::drawnStructures(document_.study());
  std::erase_if(others,
                [&](const std::string& name) { return std::find(wanted.begin(), wanted.end(), name) != wanted.end(); });
  const QString text = tr("Show only %1").arg(current().data().toString());
  document_.undoStack().beginMacro(text);
  commands::setAllVisible(document_, wanted, true, text);
  commands::setAllVisible(document_, others, false, text);
  document_.undoStack().endMacro();
}

void ProjectPanel::chooseColour() {
  const std::string structure = currentStructure().value();
  const QColor chosen = QColorDialog::getColor(document::appearanceOf(document_.study(), structure).colour, this,
                                               tr("Colour of %1").arg(QString::fromStdString(structure)));
  if (chosen.isValid()) {
    commands::setColour(document_, structure, bytesOf(chosen));
  }
}

void ProjectPanel::resetLook() {
  const std::vector<std::string> structures = model_->structuresAt(current());
  document_.undoStack().beginMacro(tr("Reset look of %1").arg(current().data().toString()));
  for (const std::string& structure : structures) {
    commands::setColour(document_, structure, std::nullopt);
    commands::setOpacity(document_, structure, std::nullopt);
    commands::setVisible(document_, structure, document::defaultAppearance(document_.study(), structure).visible);
  }
  document_.undoStack().endMacro();
}

void ProjectPanel::removeCurrent() {
  if (const std::optional<ItemRef> item = currentItem(); item && commands::canRemove(*item)) {
    commands::removeItem(document_, *item);
  }
}

}  // namespace lorica::panels
