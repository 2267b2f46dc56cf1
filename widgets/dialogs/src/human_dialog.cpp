#include "lorica/dialogs/human_dialog.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>
#include <cmath>

#include "human_preview.h"
#include "lorica/base/error.h"
#include "lorica/manikin/body.h"
#include "lorica/models/numbers.h"

namespace lorica::dialogs {

namespace {

constexpr manikin::PersonLimits limits;

double toMillimetre(double metres) {
  return std::round(1000.0 * metres) / 1000.0;
}
double toTenth(double value) {
  return std::round(10.0 * value) / 10.0;
}
/// The lightest and the heaviest person of a stature, tenths of a kilogram.
double leastMass(human::Sex sex, double stature) {
  const double least = limits.leastBmi(sex, stature) * (stature * stature);
  const double tenths = std::ceil(10.0 * least);
  // A tenth is no binary fraction: what is a limit by its digits may lie just beyond it.
  return (tenths / 10.0 < least ? tenths + 1.0 : tenths) / 10.0;
}
double greatestMass(double stature) {
  const double greatest = limits.greatestBmi * (stature * stature);
  const double tenths = std::floor(10.0 * greatest);
  return (tenths / 10.0 > greatest ? tenths - 1.0 : tenths) / 10.0;
}

human::Person rounded(const human::Person& person) {
  return {person.sex, toMillimetre(person.stature), toTenth(person.mass)};
}

/// The person at a whole percentile, as the dialog has it.
human::Person at(human::Sex sex, int percentile) {
  return rounded(manikin::personAtPercentile(sex, percentile));
}

std::optional<int> percentileOf(const human::Person& person) {
  for (int percentile = 1; percentile <= 99; ++percentile) {
    if (at(person.sex, percentile) == person) {
      return percentile;
    }
  }
  return std::nullopt;
}

bool canBeMade(const human::Person& person) {
  try {
    manikin::checkPerson(person);
  } catch (const base::InputError&) {
    return false;
  }
  return true;
}

}  // namespace

HumanDialog::HumanDialog(Purpose purpose, const human::Person& person, QWidget* parent)
    : QDialog(parent), purpose_(purpose), person_(person) {
  const bool isNew = purpose == Purpose::newStudy;
  setWindowTitle(isNew ? tr("New study with the built-in human") : tr("Change the person"));
  setModal(true);
  auto* column = new QVBoxLayout(this);
  auto* row = new QHBoxLayout;
  column->addLayout(row, 1);
  auto* forms = new QVBoxLayout;
  row->addLayout(forms);
  forms->addWidget(makePersonForm());
  if (isNew) {
    forms->addWidget(makeStudyForm());
  }
  forms->addStretch(1);
  preview_ = new HumanPreview(this);
  preview_->setObjectName(QStringLiteral("preview"));
  connect(preview_, &HumanPreview::arrived, this, &HumanDialog::previewArrived);
  row->addWidget(preview_, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  QPushButton* accept = buttons->button(QDialogButtonBox::Ok);
  accept->setObjectName(QStringLiteral("accept"));
  accept->setText(isNew ? tr("Create study") : tr("Change"));
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);

  const std::optional<int> percentile = percentileOf(person_);
  (percentile ? byPercentile_ : bySizes_)->setChecked(true);
  (person_.sex == human::Sex::male ? male_ : female_)->setChecked(true);
  slider_->setValue(percentile.value_or(50));
  percentile_->setValue(percentile.value_or(50));
  if (!canBeMade(person_)) {
    stature_->setValue(100.0 * person_.stature);
    limitMass();
    mass_->setValue(person_.mass);
    takeSizes();
  }
  showState();
  preview_->ask(person_);

  connect(male_, &QRadioButton::toggled, this, [this] { byPercentile_->isChecked() ? takePercentile() : takeSizes(); });
  connect(byPercentile_, &QRadioButton::toggled, this, [this](bool on) { on ? takePercentile() : takeSizes(); });
  connect(slider_, &QSlider::valueChanged, percentile_, &QSpinBox::setValue);
  connect(percentile_, &QSpinBox::valueChanged, this, [this](int value) {
    const QSignalBlocker quiet(slider_);
    slider_->setValue(value);
    takePercentile();
  });
  connect(stature_, &QDoubleSpinBox::valueChanged, this, &HumanDialog::takeSizes);
  connect(mass_, &QDoubleSpinBox::valueChanged, this, &HumanDialog::takeSizes);
}

HumanDialog::~HumanDialog() = default;

QWidget* HumanDialog::makePersonForm() {
  auto* group = new QGroupBox(tr("Person"), this);
  auto* column = new QVBoxLayout(group);
  auto* sexes = new QHBoxLayout;
  column->addLayout(sexes);
  auto* sex = new QButtonGroup(this);
  male_ = new QRadioButton(tr("Man"), group);
  male_->setObjectName(QStringLiteral("male"));
  female_ = new QRadioButton(tr("Woman"), group);
  female_->setObjectName(QStringLiteral("female"));
  sex->addButton(male_);
  sex->addButton(female_);
  sexes->addWidget(male_);
  sexes->addWidget(female_);
  sexes->addStretch(1);

  auto* size = new QButtonGroup(this);
  byPercentile_ = new QRadioButton(tr("By percentile of their sex"), group);
  byPercentile_->setObjectName(QStringLiteral("by_percentile"));
  byPercentile_->setToolTip(tr("Stature and mass at the same percentile of US Army personnel (ANSUR II)"));
  bySizes_ = new QRadioButton(tr("By stature and mass"), group);
  bySizes_->setObjectName(QStringLiteral("by_sizes"));
  size->addButton(byPercentile_);
  size->addButton(bySizes_);
  column->addSpacing(fontMetrics().height() / 2);
  column->addWidget(byPercentile_);
  auto* slide = new QHBoxLayout;
  column->addLayout(slide);
  slider_ = new QSlider(Qt::Horizontal, group);
  slider_->setObjectName(QStringLiteral("percentile_slider"));
  slider_->setAccessibleName(tr("Percentile"));
  slider_->setRange(1, 99);
  slider_->setPageStep(5);
  slide->addWidget(slider_, 1);
  percentile_ = new QSpinBox(group);
  percentile_->setObjectName(QStringLiteral("percentile"));
  percentile_->setAccessibleName(tr("Percentile"));
  percentile_->setRange(1, 99);
  slide->addWidget(percentile_);

  column->addSpacing(fontMetrics().height() / 2);
  column->addWidget(bySizes_);
  auto* form = new QFormLayout;
  column->addLayout(form);
  const auto spin = [&](const char* name, const QString& label, const QString& unit, double step) {
    auto* made = new QDoubleSpinBox(group);
    made->setObjectName(QLatin1String(name));
    made->setDecimals(1);
    made->setSingleStep(step);
    made->setSuffix(QLatin1Char(' ') + unit);
    made->setKeyboardTracking(false);
    made->setMinimumWidth(fontMetrics().averageCharWidth() * 16);
    form->addRow(label, made);
    return made;
  };
  const auto note = [&](const char* name) {
    auto* made = new QLabel(group);
    made->setObjectName(QLatin1String(name));
    made->setForegroundRole(QPalette::PlaceholderText);
    form->addRow(QString(), made);
    return made;
  };
  stature_ = spin("stature", tr("Stature"), tr("cm"), 1.0);
  stature_->setRange(100.0 * limits.leastStature, 100.0 * limits.greatestStature);
  note("stature_limits")
      ->setText(tr("%1 to %2 cm").arg(models::fixed(stature_->minimum(), 0), models::fixed(stature_->maximum(), 0)));
  mass_ = spin("mass", tr("Mass"), tr("kg"), 1.0);
  mass_->setRange(leastMass(human::Sex::male, limits.leastStature), greatestMass(limits.greatestStature));
  massLimits_ = note("mass_limits");
  bmi_ = new QLabel(group);
  bmi_->setObjectName(QStringLiteral("bmi"));
  form->addRow(tr("Body mass index"), bmi_);
  return group;
}

QWidget* HumanDialog::makeStudyForm() {
  auto* group = new QGroupBox(tr("Study"), this);
  auto* form = new QFormLayout(group);
  auto* column = new QVBoxLayout;
  column->setSpacing(2);
  const auto system = [&](const char* name, const QString& text, const QString& tip, bool on) {
    auto* box = new QCheckBox(text, group);
    box->setObjectName(QLatin1String(name));
    box->setToolTip(tip);
    box->setChecked(on);
    column->addWidget(box);
    systems_.append(box);
  };
  const QString vest = tr("Soft vest with collar, shoulder and groin pieces; front, back and side plates");
  const QString plates = tr("Front and back plate; what carries them does not protect and is left out");
  system("full_torso", tr("Full torso"), vest, true);
  system("plate_carrier", tr("Plate carrier"), plates, true);
  system("helmet", tr("Helmet"), tr("The helmet alone"), false);
  system("full_torso_helmet", tr("Full torso with helmet"), vest + tr("; helmet"), false);
  system("plate_carrier_helmet", tr("Plate carrier with helmet"), plates + tr("; helmet"), false);
  form->addRow(tr("Armor systems"), column);
  organs_ = new QComboBox(group);
  organs_->setObjectName(QStringLiteral("organs"));
  organs_->addItem(tr("All organs and vessels"), static_cast<int>(study::OrganChoice::all));
  organs_->addItem(tr("Organs of the torso"), static_cast<int>(study::OrganChoice::torso));
  organs_->addItem(tr("None"), static_cast<int>(study::OrganChoice::none));
  form->addRow(tr("Organs"), organs_);
  return group;
}

void HumanDialog::setPercentile(int percentile) {
  byPercentile_->setChecked(true);
  percentile_->setValue(percentile);
}

void HumanDialog::setSizes(double stature, double mass) {
  bySizes_->setChecked(true);
  stature_->setValue(100.0 * stature);
  mass_->setValue(mass);
}

void HumanDialog::setSex(human::Sex sex) {
  (sex == human::Sex::male ? male_ : female_)->setChecked(true);
}

void HumanDialog::takePercentile() {
  if (!taking_) {
    person_ = at(male_->isChecked() ? human::Sex::male : human::Sex::female, percentile_->value());
    changed();
  }
}

void HumanDialog::takeSizes() {
  if (taking_) {
    return;
  }
  limitMass();
  const human::Person chosen =
      rounded({male_->isChecked() ? human::Sex::male : human::Sex::female, 0.01 * stature_->value(), mass_->value()});
  // Looking at the fields changes nobody: the first choice may be finer than they are.
  if (chosen != rounded(person_)) {
    person_ = chosen;
  }
  changed();
}

void HumanDialog::limitMass() {
  const double stature = toMillimetre(0.01 * stature_->value());
  const QSignalBlocker quiet(mass_);
  mass_->setRange(leastMass(male_->isChecked() ? human::Sex::male : human::Sex::female, stature),
                  greatestMass(stature));
}

void HumanDialog::changed() {
  showState();
  preview_->ask(person_);
}

void HumanDialog::showState() {
  const bool percentile = byPercentile_->isChecked();
  slider_->setEnabled(percentile);
  percentile_->setEnabled(percentile);
  stature_->setEnabled(!percentile);
  mass_->setEnabled(!percentile);
  taking_ = true;
  stature_->setValue(100.0 * person_.stature);
  limitMass();
  mass_->setValue(person_.mass);
  taking_ = false;
  massLimits_->setText(
      tr("%1 to %2 kg at this stature").arg(models::fixed(mass_->minimum(), 1), models::fixed(mass_->maximum(), 1)));
  bmi_->setText(tr("%1 kg/m²").arg(models::fixed(person_.mass / (person_.stature * person_.stature), 1)));
}

study::Study HumanDialog::study() const {
  LORICA_CHECK(purpose_ == Purpose::newStudy, "the dialog makes a new study");
  study::HumanStudyOptions options;
  options.person = person_;
  options.organs = static_cast<study::OrganChoice>(organs_->currentData().toInt());
  options.systems.clear();
  for (const QCheckBox* box : systems_) {
    if (box->isChecked()) {
      options.systems.push_back(box->objectName().toStdString());
    }
  }
  return study::humanStudy(options);
}

std::optional<human::Person> HumanDialog::shownPerson() const {
  return preview_->shown();
}

void HumanDialog::done(int result) {
  preview_->stop();
  QDialog::done(result);
}

}  // namespace lorica::dialogs
