#include "panel_parts.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QFontMetrics>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QSignalBlocker>
#include <QStyleOptionComboBox>
#include <QStylePainter>
#include <QTableView>
#include <QVBoxLayout>

#include "lorica/models/model_texts.h"

namespace lorica::panels {

namespace {

/// Cuts what it has no room for in the middle, where names differ least.
class ElidedCombo : public QComboBox {
 public:
  using QComboBox::QComboBox;

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QStylePainter painter(this);
    QStyleOptionComboBox option;
    initStyleOption(&option);
    painter.drawComplexControl(QStyle::CC_ComboBox, option);
    const QRect room =
        style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this).adjusted(2, 0, -2, 0);
    option.currentText = fontMetrics().elidedText(option.currentText, Qt::ElideMiddle, room.width());
    painter.drawControl(QStyle::CE_ComboBoxLabel, option);
  }
};

class KeyWatch : public QObject {
 public:
  KeyWatch(QWidget& widget, QKeySequence::StandardKey key, std::function<void()> action)
      : QObject(&widget), key_(key), action_(std::move(action)) {
    widget.installEventFilter(this);
  }

  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) {
      return false;
    }
    if (!static_cast<QKeyEvent*>(event)->matches(key_)) {
      return false;
    }
    event->accept();
    if (event->type() == QEvent::KeyPress) {
      action_();
    }
    return true;
  }

 private:
  QKeySequence::StandardKey key_;
  std::function<void()> action_;
};

}  // namespace

void onKey(QWidget& widget, QKeySequence::StandardKey key, std::function<void()> action) {
  new KeyWatch(widget, key, std::move(action));
}

QWidget* makeEmptyPage(const QString& text, QWidget* parent) {
  auto* page = new QWidget(parent);
  auto* layout = new QVBoxLayout(page);
  auto* label = new QLabel(text, page);
  label->setAlignment(Qt::AlignCenter);
  label->setWordWrap(true);
  label->setForegroundRole(QPalette::PlaceholderText);
  layout->addWidget(label);
  return page;
}

QComboBox* makeChoice(const QString& tip, QWidget* parent) {
  auto* combo = new ElidedCombo(parent);
  combo->setToolTip(tip);
  combo->setAccessibleName(tip);
  combo->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  combo->setMinimumContentsLength(8);
  combo->setMaximumWidth(combo->fontMetrics().averageCharWidth() * 34);
  return combo;
}

QTableView* makeTable(QWidget* parent) {
  auto* table = new QTableView(parent);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setShowGrid(false);
  table->setAlternatingRowColors(true);
  table->setWordWrap(false);
  table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  table->verticalHeader()->hide();
  table->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  table->verticalHeader()->setDefaultSectionSize(table->fontMetrics().height() + panelMargin);
  table->horizontalHeader()->setHighlightSections(false);
  return table;
}

void refillModels(QComboBox& combo, const QStringList& names, const QString& all) {
  refill(combo, names, all);
  for (int i = all.isEmpty() ? 0 : 1; i < combo.count(); ++i) {
    const QString label = models::modelFromFile(combo.itemData(i).toString().toStdString());
    combo.setItemText(i, label);
    combo.setItemData(i, label, Qt::ToolTipRole);
  }
}

void refill(QComboBox& combo, const QStringList& entries, const QString& all) {
  const QSignalBlocker quiet(combo);
  const QString chosen = combo.currentData().toString();
  combo.clear();
  if (!all.isEmpty()) {
    combo.addItem(all, QString());
  }
  int widest = 0;
  for (const QString& entry : entries) {
    combo.addItem(entry, entry);
    combo.setItemData(combo.count() - 1, entry, Qt::ToolTipRole);
    widest = std::max(widest, combo.fontMetrics().horizontalAdvance(entry));
  }
  combo.view()->setMinimumWidth(widest + 4 * combo.fontMetrics().averageCharWidth());
  combo.setCurrentIndex(std::max(0, combo.findData(chosen)));
}

}  // namespace lorica::panels
