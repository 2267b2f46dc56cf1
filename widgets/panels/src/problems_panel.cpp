#include "lorica/panels/problems_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QTableView>
#include <algorithm>

#include "panel_parts.h"

namespace lorica::panels {

ProblemsPanel::ProblemsPanel(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), model_(new models::ProblemsModel(this)) {
  pages_ = new QStackedWidget(this);
  table_ = makeTable(this);
  table_->setObjectName(QStringLiteral("problems"));
  table_->setModel(model_);
  table_->horizontalHeader()->setSectionResizeMode(models::ProblemsModel::severityColumn,
                                                   QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->setColumnWidth(models::ProblemsModel::whereColumn, fontMetrics().averageCharWidth() * 36);
  table_->setTextElideMode(Qt::ElideMiddle);  // the end of a path tells more than its start
  pages_->addWidget(makeEmptyPage(tr("No problems found."), this));
  pages_->addWidget(table_);

  summary_ = new QLabel(this);
  copy_ = new QPushButton(tr("Copy"), this);
  copy_->setToolTip(tr("Copy the selected problems, or all of them, as text"));
  connect(copy_, &QPushButton::clicked, this, &ProblemsPanel::copy);
  auto* copyAction = new QAction(tr("Copy"), table_);
  copyAction->setShortcut(QKeySequence::Copy);
  copyAction->setShortcutContext(Qt::WidgetShortcut);
  onKey(*table_, QKeySequence::Copy, [this] { copy(); });
  connect(copyAction, &QAction::triggered, this, &ProblemsPanel::copy);
  table_->addAction(copyAction);
  table_->setContextMenuPolicy(Qt::ActionsContextMenu);

  auto* bar = new QHBoxLayout;
  bar->addWidget(summary_, 1);
  bar->addWidget(copy_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  layout->setSpacing(panelMargin);
  layout->addWidget(pages_, 1);
  layout->addLayout(bar);

  connect(&document_, &document::StudyDocument::problemsChanged, this, &ProblemsPanel::follow);
  follow();
}

void ProblemsPanel::follow() {
  model_->setIssues(document_.problems());
  const int notes = model_->count(base::Severity::note);
  const auto counted = [](int count, const QString& one, const QString& many) {
    return count == 1 ? one : many.arg(count);
  };
  summary_->setText(counted(errors(), tr("1 error"), tr("%1 errors")) + ", " +
                    counted(warnings(), tr("1 warning"), tr("%1 warnings")) + ", " +
                    counted(notes, tr("1 note"), tr("%1 notes")));
  const bool any = model_->rowCount() > 0;
  pages_->setCurrentIndex(any ? 1 : 0);
  summary_->setVisible(any);
  copy_->setVisible(any);
  Q_EMIT countChanged(errors(), warnings());
}

void ProblemsPanel::copy() const {
  std::vector<int> rows;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows()) {
    rows.push_back(index.row());
  }
  if (rows.empty()) {
    for (int row = 0; row < model_->rowCount(); ++row) {
      rows.push_back(row);
    }
  }
  std::sort(rows.begin(), rows.end());
  QApplication::clipboard()->setText(model_->lines(rows));
}

}  // namespace lorica::panels
