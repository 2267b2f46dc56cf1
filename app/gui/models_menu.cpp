#include "models_menu.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>
#include <array>

namespace lorica::gui {

namespace {

using viscera::OrganModel;

constexpr std::array models = {OrganModel::staticJoint, OrganModel::staticSkin, OrganModel::dynamicThesis,
                               OrganModel::dynamic};

QString label(OrganModel model) {
  switch (model) {
    case OrganModel::staticJoint:
      return ModelChooser::tr("static, by joint");
    case OrganModel::staticSkin:
      return ModelChooser::tr("static, by skin");
    case OrganModel::dynamicThesis:
      return ModelChooser::tr("dynamic, thesis");
    case OrganModel::dynamic:
      return ModelChooser::tr("dynamic");
  }
  return {};
}

}  // namespace

ModelChooser::ModelChooser(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), first_(new QComboBox), second_(new QComboBox) {
  second_->addItem(tr("nothing"), -1);
  for (const OrganModel model : models) {
    first_->addItem(label(model), static_cast<int>(model));
    second_->addItem(label(model), static_cast<int>(model));
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
