#include "lorica/panels/shot_panel.h"

#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include "flow_layout.h"
#include "lorica/base/error.h"
#include "lorica/models/model_texts.h"
#include "panel_parts.h"

namespace lorica::panels {

using document::StudyDocument;

ShotPanel::ShotPanel(StudyDocument& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      table_(new models::ShotTable(this)),
      edit_(new QLineEdit(this)),
      systems_(makeChoice(tr("Armor system whose pieces are listed"), this)),
      models_(makeChoice(tr("Model whose organs are listed"), this)),
      copy_(new QToolButton(this)),
      summary_(new QLabel(this)),
      view_(makeTable(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  auto* bar = new QWidget(this);
  auto* row = new FlowLayout(bar);
  auto* label = new QLabel(tr("Shot"), bar);
  row->addWidget(label);
  edit_->setObjectName(QStringLiteral("shot_name"));
  edit_->setAccessibleName(tr("Shot"));
  edit_->setPlaceholderText(tr("SOURCE:TRIAL:SHOT"));
  edit_->setToolTip(tr("A shot of the run: its source, its trial counted from 1, its number counted from 0"));
  edit_->setMinimumWidth(fontMetrics().averageCharWidth() * 26);
  label->setBuddy(edit_);
  systems_->setObjectName(QStringLiteral("shot_system"));
  models_->setObjectName(QStringLiteral("shot_model"));
  copy_->setObjectName(QStringLiteral("shot_copy"));
  copy_->setText(tr("Copy as CSV"));
  for (QWidget* widget : std::initializer_list<QWidget*>{edit_, systems_, models_, copy_}) {
    row->addWidget(widget);
  }
  column->addWidget(bar);
  summary_->setObjectName(QStringLiteral("shot_summary"));
  summary_->setWordWrap(true);
  summary_->setTextFormat(Qt::PlainText);
  column->addWidget(summary_);
  view_->setObjectName(QStringLiteral("shot_table"));
  view_->setModel(table_);
  column->addWidget(view_, 1);

  connect(edit_, &QLineEdit::returnPressed, this, [this] { inspect(edit_->text()); });
  connect(systems_, &QComboBox::currentIndexChanged, this, &ShotPanel::refreshTable);
  connect(models_, &QComboBox::currentIndexChanged, this, &ShotPanel::refreshTable);
  const auto copy = [this] { QGuiApplication::clipboard()->setText(table_->csv()); };
  connect(copy_, &QToolButton::clicked, this, copy);
  onKey(*view_, QKeySequence::Copy, copy);
  connect(&document_, &StudyDocument::replaced, this, [this] { inspect({}); });
  connect(&document_, &StudyDocument::planChanged, this, &ShotPanel::ask);
  connect(&document_, &StudyDocument::shownPoseChanged, this, &ShotPanel::ask);
  connect(&inspector_, &jobs::ShotInspector::ready, this,
          [this](const std::shared_ptr<const jobs::ShotInspection>& inspection) { present(inspection, {}); });
  connect(&inspector_, &jobs::ShotInspector::failed, this, [this](const QString& text) { present(nullptr, text); });
  present(nullptr, {});
}

void ShotPanel::inspect(const QString& name) {
  name_ = name.trimmed();
  edit_->setText(name_);
  ask();
}

void ShotPanel::ask() {
  inspector_.abandon();
  if (name_.isEmpty()) {
    present(nullptr, {});
    return;
  }
  const auto& plan = document_.plan();
  if (plan == nullptr) {
    present(nullptr, tr("the study is not read yet"));
  } else if (plan->trouble) {
    present(nullptr, QString::fromStdString(plan->trouble->text));
  } else {
    try {
      inspector_.request(plan, analysis::shotNamed(name_.toStdString()), document_.shownPose());
    } catch (const base::InputError& error) {
      present(nullptr, QString::fromStdString(error.text()));
    }
  }
}

void ShotPanel::present(std::shared_ptr<const jobs::ShotInspection> inspection, const QString& trouble) {
  const bool changed = inspection_ != inspection;
  inspection_ = std::move(inspection);
  refreshChoices();
  refreshTable();
  if (inspection_ == nullptr) {
    QString text = trouble;
    if (!text.isEmpty()) {
      text[0] = text[0].toUpper();
      text += text.endsWith(u'.') ? QString() : QStringLiteral(".");
    }
    summary_->setText(!text.isEmpty() ? text
                                      : tr("Click a shot in the view (Analysis > Shot lines shows them), or type the "
                                           "name of one."));
  }
  if (changed) {
    Q_EMIT inspected(inspection_);
  }
}

void ShotPanel::refreshChoices() {
  const QSignalBlocker quietSystems(systems_);
  const QSignalBlocker quietModels(models_);
  QStringList systems;
  if (inspection_ != nullptr) {
    for (const std::string& system : inspection_->plan->result.systems) {
      systems.append(QString::fromStdString(system));
    }
  }
  const bool first = systems_->count() == 0;
  refill(*systems_, systems);
  if (first && systems.size() > 1) {
    systems_->setCurrentIndex(1);  // armor is what one asks about
  }
  const QVariant model = models_->currentData();
  models_->clear();
  if (inspection_ != nullptr) {
    for (const models::ModelText& text : models::modelTexts()) {
      const auto& all = inspection_->plan->result.models;
      if (std::find(all.begin(), all.end(), text.model) != all.end()) {
        models_->addItem(text.label, QString::fromStdString(viscera::name(text.model)));
      }
    }
    models_->setCurrentIndex(std::max(model.isValid() ? models_->findData(model) : models_->count() - 1, 0));
  }
}

void ShotPanel::refreshTable() {
  const bool any = inspection_ != nullptr;
  for (QWidget* widget : std::initializer_list<QWidget*>{systems_, models_, copy_}) {
    widget->setEnabled(any);
  }
  if (!any) {
    table_->setRows({});
    view_->resizeColumnsToContents();
    return;
  }
  const std::string system = systems_->currentText().toStdString();
  const std::string model = models_->currentData().toString().toStdString();
  const analysis::ShotDetails& shot = inspection_->details;
  table_->setRows(models::shotRows(shot, inspection_->plan->study->study.overlap, system, model));
  summary_->setText(tr("Pose %1. %2").arg(QString::fromStdString(shot.pose), models::shotSummary(shot, system, model)));
  view_->resizeColumnsToContents();
}

}  // namespace lorica::panels
