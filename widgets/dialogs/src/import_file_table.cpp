#include "import_file_table.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <algorithm>

#include "import_parts.h"

namespace lorica::dialogs {

namespace fs = std::filesystem;

ImportFileTable::ImportFileTable(QWidget* parent) : QTableWidget(0, 3, parent) {
  setAccessibleName(tr("Files"));
  setHorizontalHeaderLabels({tr("File"), tr("Holds"), tr("Armor system")});
  makeCalm(*this);
  horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (const int section : {1, 2}) {
    horizontalHeader()->setSectionResizeMode(section, QHeaderView::Fixed);
    setColumnWidth(section, fontMetrics().averageCharWidth() * 22);
  }
}

void ImportFileTable::add(const fs::path& file) {
  const auto same = [&](const Entry& entry) { return entry.file == file; };
  if (std::none_of(entries_.begin(), entries_.end(), same)) {
    entries_.push_back({file});
  }
}

void ImportFileTable::setRole(std::size_t file, FileRole role) {
  entries_.at(file).role = role;
  entries_.at(file).chosen = true;
  rebuild();
}

void ImportFileTable::removeSelected() {
  std::vector<int> rows;
  for (const QModelIndex& index : selectionModel()->selectedRows()) {
    rows.push_back(index.row());
  }
  std::sort(rows.rbegin(), rows.rend());
  for (const int row : rows) {
    entries_.erase(entries_.begin() + row);
  }
}

void ImportFileTable::guess(bool withSkin) {
  std::vector<fs::path> files;
  std::transform(entries_.begin(), entries_.end(), std::back_inserter(files), [](const Entry& e) { return e.file; });
  const std::vector<FileRole> guessed = guessRoles(files, withSkin);
  const bool skinChosen = std::any_of(entries_.begin(), entries_.end(),
                                      [](const Entry& e) { return e.chosen && e.role == FileRole::skin; });
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!entries_[i].chosen) {
      entries_[i].role = skinChosen && guessed[i] == FileRole::skin ? FileRole::organ : guessed[i];
    }
  }
  withSkin_ = withSkin;
  rebuild();
}

void ImportFileTable::rebuild() {
  setRowCount(0);
  setRowCount(static_cast<int>(entries_.size()));
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int row = static_cast<int>(i);
    auto* name = new QTableWidgetItem(textOf(entries_[i].file.filename()));
    name->setToolTip(textOf(entries_[i].file));
    setItem(row, 0, name);
    auto* role = new QComboBox(this);
    role->setFrame(false);
    role->setAccessibleName(tr("What %1 holds").arg(name->text()));
    if (withSkin_) {
      role->addItem(tr("Body skin"), static_cast<int>(FileRole::skin));
    }
    role->addItem(tr("Organ"), static_cast<int>(FileRole::organ));
    role->addItem(tr("Armor piece"), static_cast<int>(FileRole::armor));
    role->addItem(tr("Ignore"), static_cast<int>(FileRole::ignore));
    role->setCurrentIndex(role->findData(static_cast<int>(entries_[i].role)));
    auto* system = new QLineEdit(QString::fromStdString(entries_[i].system), this);
    system->setFrame(false);
    system->setAccessibleName(tr("Armor system of %1").arg(name->text()));
    system->setVisible(entries_[i].role == FileRole::armor);
    connect(role, &QComboBox::activated, this, [this, i, role, system] {
      entries_[i].role = static_cast<FileRole>(role->currentData().toInt());
      entries_[i].chosen = true;
      system->setVisible(entries_[i].role == FileRole::armor);
      Q_EMIT edited();
    });
    connect(system, &QLineEdit::textEdited, this, [this, i](const QString& text) {
      entries_[i].system = text.trimmed().toStdString();
      Q_EMIT edited();
    });
    setCellWidget(row, 1, role);
    // The table shows a widget it is given; one around it keeps the editor's own say.
    auto* cell = new QWidget(this);
    auto* layout = new QHBoxLayout(cell);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(system);
    setCellWidget(row, 2, cell);
  }
  resizeRowsToContents();
}

}  // namespace lorica::dialogs
