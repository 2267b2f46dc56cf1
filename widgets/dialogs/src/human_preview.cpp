#include "human_preview.h"

#include <QCoreApplication>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QVBoxLayout>
#include <algorithm>

#include "lorica/dialogs/human_dialog.h"
#include "lorica/manikin/body_measures.h"
#include "lorica/manikin/human.h"
#include "lorica/models/numbers.h"
#include "lorica/viewport/person_view.h"

namespace lorica::dialogs {

namespace {

constexpr int delayMs = 300;  ///< without a change until a person is made

/// What is shown of the measures, stature and mass first.
constexpr std::array girths{"chest_girth", "waist_girth", "hip_girth"};

QString centimetres(double metres) {
  return HumanDialog::tr("%1 cm").arg(models::fixed(100.0 * metres, 1));
}

QString kilograms(double mass) {
  return HumanDialog::tr("%1 kg").arg(models::fixed(mass, 1));
}

}  // namespace

struct HumanPreview::Made {
  human::Person person;
  std::shared_ptr<const geometry::TriangleMesh> skin;
  std::vector<manikin::BodyMeasure> measures;
  double mass = 0.0;
};

HumanPreview::HumanPreview(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  view_ = new viewport::PersonView(this);
  view_->setObjectName(QStringLiteral("person_view"));
  view_->setMinimumSize(fontMetrics().averageCharWidth() * 56, fontMetrics().height() * 25);
  column->addWidget(view_, 1);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  state_ = new QLabel(this);
  state_->setObjectName(QStringLiteral("preview_state"));
  state_->setTextFormat(Qt::PlainText);
  row->addWidget(state_, 1);
  progress_ = new QProgressBar(this);
  progress_->setObjectName(QStringLiteral("preview_progress"));
  // How long it takes depends on what else the machine does: it only says that something is going on.
  progress_->setRange(0, 0);
  progress_->setTextVisible(false);
  progress_->setMaximumWidth(fontMetrics().averageCharWidth() * 20);
  QSizePolicy kept = progress_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);
  progress_->setSizePolicy(kept);
  row->addWidget(progress_);
  facts_ = makeFacts();
  column->addWidget(facts_);
  delay_.setSingleShot(true);
  delay_.setInterval(delayMs);
  connect(&delay_, &QTimer::timeout, this, &HumanPreview::start);
  showState();
}

HumanPreview::~HumanPreview() {
  abandon();
}

QWidget* HumanPreview::makeFacts() {
  auto* group = new QWidget(this);
  auto* grid = new QGridLayout(group);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(2);
  grid->setHorizontalSpacing(fontMetrics().averageCharWidth() * 3);
  const auto label = [&](const QString& text, int line, int place) {
    auto* made = new QLabel(text, group);
    made->setAlignment((place == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    grid->addWidget(made, line, place);
    return made;
  };
  label(HumanDialog::tr("Wanted"), 0, 1)
      ->setToolTip(HumanDialog::tr("Stature and mass as chosen; girths as the survey (ANSUR II) has them for this "
                                   "build"));
  label(HumanDialog::tr("Measured"), 0, 2)
      ->setToolTip(HumanDialog::tr("On the body that was made: its height, the mass its volume gives, and what a tape "
                                   "reads around it"));
  const std::array<QString, 5> names{HumanDialog::tr("Stature"), HumanDialog::tr("Mass"),
                                     HumanDialog::tr("Chest girth"), HumanDialog::tr("Waist girth"),
                                     HumanDialog::tr("Hip girth")};
  const std::array ids{"stature", "mass", girths[0], girths[1], girths[2]};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int line = static_cast<int>(i) + 1;
    label(names[i], line, 0);
    rows_[i] = {label({}, line, 1), label({}, line, 2)};
    rows_[i].survey->setObjectName(QLatin1String("wanted_") + QLatin1String(ids[i]));
    rows_[i].made->setObjectName(QLatin1String("measured_") + QLatin1String(ids[i]));
  }
  grid->setColumnStretch(3, 1);
  return group;
}

void HumanPreview::ask(const human::Person& person) {
  wanted_ = person;
  if (job_ != nullptr) {
    job_->cancel();
  }
  if (shown_ == wanted_) {
    // It is there already.
    again_ = false;
    delay_.stop();
  } else {
    again_ = job_ != nullptr;
    delay_.start();
  }
  showState();
}

void HumanPreview::stop() {
  delay_.stop();
  abandon();
  showState();
}

void HumanPreview::abandon() {
  again_ = false;
  if (job_ == nullptr) {
    return;
  }
  // Nobody waits for it: it ends when it next looks at its token. Until then the program keeps it.
  jobs::Job* job = job_.release();
  job->disconnect(this);
  job->setParent(QCoreApplication::instance());
  connect(job, &jobs::Job::ended, job, &QObject::deleteLater);
  job->cancel();
}

void HumanPreview::start() {
  if (job_ != nullptr) {
    again_ = true;
    return;
  }
  again_ = false;
  if (shown_ == wanted_) {
    return;  // it came after all
  }
  auto made = std::make_shared<Made>();
  job_ = std::make_unique<jobs::Job>(
      HumanDialog::tr("Making the person"), [made, person = wanted_](const base::Progress& progress) {
        std::optional<manikin::Human> kept = manikin::humanIfKept(person);
        progress.check();
        const manikin::Body body = kept ? std::move(kept->body) : manikin::makeBody(person, {}, progress);
        progress.check();
        made->person = person;
        made->measures = manikin::measureBody(body);
        made->mass = manikin::measuredMass(body);
        made->skin = std::make_shared<const geometry::TriangleMesh>(body.skin);
      });
  connect(job_.get(), &jobs::Job::finished, this, [this, made] {
    if (made->person == wanted_) {
      take(*made);
    }
  });
  connect(job_.get(), &jobs::Job::failed, this, [this](const QString& text) { failure_ = text; });
  connect(job_.get(), &jobs::Job::ended, this, [this] {
    job_.release()->deleteLater();
    if (again_ && !delay_.isActive()) {
      start();
    }
    showState();
  });
  failure_.clear();
  job_->start();
  showState();
}

void HumanPreview::take(const Made& made) {
  shown_ = made.person;
  view_->showSkin(made.skin);
  const auto measure = [&made](const char* name) -> const manikin::BodyMeasure* {
    const auto found =
        std::find_if(made.measures.begin(), made.measures.end(), [&](const auto& m) { return m.name == name; });
    return found == made.measures.end() ? nullptr : &*found;
  };
  rows_[0].survey->setText(centimetres(made.person.stature));
  if (const auto* stature = measure("stature")) {
    rows_[0].made->setText(centimetres(stature->value));
  }
  rows_[1].survey->setText(kilograms(made.person.mass));
  rows_[1].made->setText(kilograms(made.mass));
  for (std::size_t i = 0; i < girths.size(); ++i) {
    if (const auto* girth = measure(girths[i])) {
      rows_[i + 2].survey->setText(centimetres(girth->target));
      rows_[i + 2].made->setText(centimetres(girth->value));
    }
  }
  Q_EMIT arrived();
}

void HumanPreview::showState() {
  const bool current = shown_ == wanted_;
  view_->setDimmed(!current);
  facts_->setEnabled(current);
  progress_->setVisible(isBusy());
  state_->setText(isBusy() ? HumanDialog::tr("Making this person...") : failure_);
}

}  // namespace lorica::dialogs
