#include "lorica/panels/inspection_panel.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QRadioButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "lorica/models/model_texts.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

QLabel* heading(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  QFont bold = label->font();
  bold.setBold(true);
  label->setFont(bold);
  return label;
}

}  // namespace

InspectionPanel::InspectionPanel(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), pages_(new QStackedWidget(this)) {
  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  column->addWidget(makeDrivers());
  column->addSpacing(panelMargin);
  column->addWidget(makeColours());
  column->addStretch(1);
  auto* scroll = new QScrollArea(this);
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  pages_->addWidget(makeEmptyPage(tr("The study has no organ to look into."), this));
  pages_->addWidget(scroll);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(pages_);

  using document::StudyDocument;
  connect(&document_, &StudyDocument::studyChanged, this, [this](document::Changes what) {
    if (what.testFlag(document::Change::organs)) {
      refillOrgans();
    }
  });
  connect(&document_, &StudyDocument::inspectionChanged, this, &InspectionPanel::follow);
  refillOrgans();
}

QWidget* InspectionPanel::makeDrivers() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(panelMargin);
  column->addWidget(heading(tr("What drives an organ"), this));
  organ_ = makeChoice(tr("The organ that is looked into"), this);
  organ_->setObjectName(QStringLiteral("inspected_organ"));
  column->addWidget(organ_);
  connect(organ_, &QComboBox::currentIndexChanged, this, &InspectionPanel::take);
  auto* boxes = new QGridLayout;
  boxes->setHorizontalSpacing(2 * panelMargin);
  boxes->setVerticalSpacing(panelMargin / 2);
  column->addLayout(boxes);
  const auto texts = models::driverTexts();
  for (std::size_t d = 0; d < texts.size(); ++d) {
    drivers_[d] = new QCheckBox(texts[d].label, this);
    drivers_[d]->setToolTip(texts[d].tip);
    const int at = static_cast<int>(d);
    boxes->addWidget(drivers_[d], at / 2, at % 2);
    connect(drivers_[d], &QCheckBox::toggled, this, &InspectionPanel::take);
  }
  return group;
}

QWidget* InspectionPanel::makeColours() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(panelMargin);
  column->addWidget(heading(tr("What the colours of organs say"), this));
  column->setSpacing(panelMargin / 2);
  colours_ = new QButtonGroup(this);
  for (const models::ColouringText& text : models::colouringTexts()) {
    auto* button = new QRadioButton(text.label, this);
    button->setToolTip(text.tip);
    colours_->addButton(button, static_cast<int>(text.colouring));
    column->addWidget(button);
  }
  connect(colours_, &QButtonGroup::idToggled, this, [this](int, bool on) {
    if (on) {
      take();
    }
  });
  return group;
}

void InspectionPanel::refillOrgans() {
  QStringList names;
  for (const study::Organ& organ : document_.study().organs) {
    names.append(QString::fromStdString(organ.name));
  }
  refill(*organ_, names, tr("No organ"));
  pages_->setCurrentIndex(names.isEmpty() ? 0 : 1);
  follow();
}

void InspectionPanel::follow() {
  const document::Inspection& now = document_.inspection();
  const QSignalBlocker quietOrgan(organ_);
  const int index = organ_->findData(QString::fromStdString(now.organ));
  organ_->setCurrentIndex(std::max(0, index));
  const auto texts = models::driverTexts();
  for (std::size_t d = 0; d < texts.size(); ++d) {
    const QSignalBlocker quiet(drivers_[d]);
    drivers_[d]->setChecked(now.drivers.testFlag(texts[d].driver));
    drivers_[d]->setEnabled(!now.organ.empty());
  }
  const QSignalBlocker quietColours(colours_);
  colours_->button(static_cast<int>(now.colouring))->setChecked(true);
}

void InspectionPanel::take() {
  document::Inspection wanted = document_.inspection();
  const std::string organ = organ_->currentData().toString().toStdString();
  const auto texts = models::driverTexts();
  for (std::size_t d = 0; d < texts.size(); ++d) {
    wanted.drivers.setFlag(texts[d].driver, drivers_[d]->isChecked());
  }
  if (wanted.organ.empty() && !organ.empty() && wanted.drivers == document::Drivers()) {
    // Whoever chooses an organ wants to see something.
    wanted.drivers = document::Driver::lattice | document::Driver::controlPoints;
  }
  wanted.organ = organ;
  wanted.colouring = static_cast<document::Colouring>(colours_->checkedId());
  document_.inspect(wanted);
}

}  // namespace lorica::panels
