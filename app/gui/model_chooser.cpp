#include "model_chooser.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>

#include "lorica/models/model_texts.h"

namespace lorica::gui {

using viscera::OrganModel;

ModelChooser::ModelChooser(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), first_(new QComboBox), second_(new QComboBox) {
  second_->addItem(tr("Nothing"), -1);
  for (const models::ModelText& text : models::modelTexts()) {
    for (QComboBox* combo : {first_, second_}) {
      combo->addItem(text.label, static_cast<int>(text.model));
      combo->setItemData(combo->count() - 1, text.tip, Qt::ToolTipRole);
    }
  }
  first_->setToolTip(tr("How organs follow the body in the view"));
  second_->setToolTip(tr("A second picture with another model, seen from the same side"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 0, 6, 0);
  row->addWidget(new QLabel(tr("Organs")));
  row->addWidget(first_);
  row->addWidget(new QLabel(tr("beside")));
  row->addWidget(second_);
  connect(first_, &QComboBox::activated, this, &ModelChooser::choose);
  connect(second_, &QComboBox::activated, this, &ModelChooser::choose);
  connect(&document_, &document::StudyDocument::shownModelsChanged, this, &ModelChooser::follow);
  follow();
}

void ModelChooser::follow() {
  const auto& shown = document_.shownModels();
  const QSignalBlocker quietFirst(first_);
  const QSignalBlocker quietSecond(second_);
  first_->setCurrentIndex(first_->findData(static_cast<int>(shown.front())));
  second_->setCurrentIndex(second_->findData(shown.size() > 1 ? static_cast<int>(shown.back()) : -1));
}

void ModelChooser::choose() {
  std::vector<OrganModel> shown{static_cast<OrganModel>(first_->currentData().toInt())};
  const int other = second_->currentData().toInt();
  if (other >= 0 && other != static_cast<int>(shown.front())) {
    shown.push_back(static_cast<OrganModel>(other));
  }
  document_.showModels(std::move(shown));
  follow();
}

}  // namespace lorica::gui
