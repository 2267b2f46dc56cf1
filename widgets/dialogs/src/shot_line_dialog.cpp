#include "lorica/dialogs/shot_line_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QLabel>
#include <QListWidget>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollArea>
#include <QScrollBar>
#include <QSpinBox>
#include <QTabWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/models/numbers.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::dialogs {

using document::Change;
using document::ItemKind;
using document::ItemRef;
using document::StudyDocument;

namespace {

QString shown(const std::string& text) {
  return QString::fromStdString(text);
}

QString counted(std::size_t count, const QString& one, const QString& many) {
  return (count == 1 ? one : many).arg(models::grouped(count));
}

}  // namespace

ShotLineDialog::ShotLineDialog(document::StudyDocument& document, jobs::RunController& runs, QWidget* parent)
    : QDialog(parent), document_(document), runs_(runs) {
  setWindowTitle(tr("Shot-line analysis"));
  setModal(false);
  auto* column = new QVBoxLayout(this);
  auto* sides = new QHBoxLayout;
  column->addLayout(sides, 1);
  sourceSide_ = makeSourceSide();
  runSide_ = makeRunSide();
  sides->addWidget(sourceSide_, 1);
  sides->addWidget(runSide_, 1);
  column->addWidget(makeRunRow());

  connect(&document_, &StudyDocument::replaced, this, [this] {
    source_.clear();
    extraPoses_.clear();
    noPose_ = false;
    speed_.reset();
    measured_.clear();
    result_.clear();
  });
  connect(&document_, &StudyDocument::studyChanged, this, [this](document::Changes what) {
    if (what.testFlag(Change::poses)) {
      noPose_ = false;
    }
    refresh();
  });
  connect(&document_, &StudyDocument::loadedChanged, this, [this] {
    refresh();
    measure();
  });
  connect(&document_, &StudyDocument::planChanged, this, &ShotLineDialog::refresh);
  connect(&document_, &StudyDocument::selectionChanged, this, [this] {
    if (document_.selection() && document_.selection()->kind == ItemKind::source) {
      source_ = document_.selection()->name;
      refresh();
    }
  });
  connect(&runs_, &jobs::RunController::started, this, &ShotLineDialog::runStarted);
  connect(&runs_, &jobs::RunController::finished, this, [this](bool partial) {
    const double seconds = static_cast<double>(clock_.elapsed()) / 1000.0;
    result_ = partial ? tr("Stopped after %1; the partial result was kept.").arg(jobs::readableTime(seconds))
                      : tr("Finished in %1.").arg(jobs::readableTime(seconds));
    if (!partial && speed_) {
      // A whole run tells the speed better than a short burst does.
      const double shooting = std::max(seconds - posesAsked_ * speed_->secondsPerPose, 0.1 * seconds);
      speed_->shotsPerSecond = shotsAsked_ / std::max(shooting, 1e-3);
    }
  });
  connect(&runs_, &jobs::RunController::failed, this, [this](const QString& text) { result_ = text; });
  connect(&runs_, &jobs::RunController::ended, this, &ShotLineDialog::runEnded);
  refresh();
}

ShotLineDialog::~ShotLineDialog() = default;

QWidget* ShotLineDialog::makeSourceSide() {
  auto* group = new QGroupBox(tr("Source"), this);
  auto* column = new QVBoxLayout(group);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  sources_ = new QComboBox(group);
  sources_->setObjectName(QStringLiteral("source"));
  sources_->setAccessibleName(tr("Source"));
  sources_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  sources_->setMinimumContentsLength(10);
  row->addWidget(sources_, 1);
  const auto button = [&](const QString& text, const char* id, const QString& tip) {
    auto* made = new QToolButton(group);
    made->setText(text);
    made->setObjectName(QString::fromLatin1(id));
    made->setToolTip(tip);
    row->addWidget(made);
    return made;
  };
  QToolButton* add = button(tr("Add"), "add_source", tr("Add a source 5 m ahead of the body"));
  duplicateSource_ = button(tr("Duplicate"), "duplicate_source", tr("Add a copy of this source"));
  removeSource_ = button(tr("Remove"), "remove_source", tr("Remove this source"));
  renameSource_ = button(tr("Rename..."), "rename_source", tr("Give this source another name"));
  connect(sources_, &QComboBox::activated, this, [this](int index) {
    source_ = sources_->itemText(index).toStdString();
    refresh();
  });
  connect(add, &QToolButton::clicked, this, [this] {
    if (document_.hasStudy()) {
      source_ = commands::addSource(document_);
      refresh();
    }
  });
  connect(duplicateSource_, &QToolButton::clicked, this, [this] {
    if (!source_.empty()) {
      source_ = commands::duplicateSource(document_, source_);
      refresh();
    }
  });
  connect(removeSource_, &QToolButton::clicked, this, [this] {
    if (!source_.empty()) {
      commands::removeItem(document_, {ItemKind::source, source_});
    }
  });
  connect(renameSource_, &QToolButton::clicked, this, &ShotLineDialog::renameSource);

  sourceForm_ = new panels::PropertyForm(document_, group);
  draft_ = std::make_shared<panels::SourceDraft>(document_, [this] { return source_; });
  draft_->onEdit([this] { refresh(); });
  panels::addSourceRows(*sourceForm_, draft_);
  column->addWidget(sourceForm_);
  pick_ = new QPushButton(tr("Pick in view"), group);
  pick_->setObjectName(QStringLiteral("pick"));
  pick_->setCheckable(true);
  pick_->setToolTip(tr("Click in the view to place the source there"));
  connect(pick_, &QPushButton::toggled, this, &ShotLineDialog::pickRequested);
  pick_->setAutoDefault(false);
  pick_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  sourceForm_->row(QLatin1String(""), pick_);
  sourceForm_->showRowWhile(pick_, [this] { return draft_->source().type == study::SourceType::point; });
  column->addStretch(1);
  column->addWidget(makeViewRows());
  return group;
}

QWidget* ShotLineDialog::makeRunSide() {
  auto* tabs = new QTabWidget(this);
  tabs->setObjectName(QStringLiteral("run_tabs"));
  tabs->addTab(makeRunPage(), tr("Run"));
  analysesForm_ = new panels::PropertyForm(document_);
  panels::addAnalysesRows(*analysesForm_);
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->addWidget(analysesForm_);
  column->addStretch(1);
  // With all of it asked for, it is taller than a small screen.
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(page);
  // The tab's own background, not that of a view.
  scroll->viewport()->setAutoFillBackground(false);
  page->setAutoFillBackground(false);
  analysesForm_->onRefresh([scroll, page] {
    scroll->setMinimumWidth(page->minimumSizeHint().width() + scroll->verticalScrollBar()->sizeHint().width());
  });
  tabs->addTab(scroll, tr("Analyses"));
  return tabs;
}

QWidget* ShotLineDialog::makeRunPage() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  auto* label = new QLabel(tr("Poses"), group);
  row->addWidget(label, 1);
  for (const bool on : {true, false}) {
    auto* button = new QToolButton(group);
    button->setText(on ? tr("All") : tr("None"));
    button->setObjectName(on ? QStringLiteral("all_poses") : QStringLiteral("no_poses"));
    button->setAutoRaise(true);
    connect(button, &QToolButton::clicked, this, [this, on] { checkAllPoses(on); });
    row->addWidget(button);
  }
  poses_ = new QListWidget(group);
  poses_->setObjectName(QStringLiteral("poses"));
  poses_->setAccessibleName(tr("Poses"));
  poses_->setTextElideMode(Qt::ElideMiddle);
  poses_->setSpacing(1);
  poses_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  poses_->setMinimumHeight(poses_->fontMetrics().height() * 6);
  label->setBuddy(poses_);
  connect(poses_, &QListWidget::itemChanged, this, [this] {
    if (!refreshing_) {
      writePoses();
    }
  });
  column->addWidget(poses_, 1);
  runForm_ = new panels::PropertyForm(document_, group);
  panels::addRunRows(*runForm_);
  panels::addStopRows(*runForm_);
  runForm_->note({"systems", tr("Armor")}, [this] {
    QStringList names{tr("unarmored")};
    for (const study::ArmorSystem& system : document_.study().systems) {
      names.append(shown(system.name));
    }
    return names.join(QStringLiteral(", "));
  });
  column->addWidget(runForm_);
  return group;
}

QWidget* ShotLineDialog::makeViewRows() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  column->setContentsMargins(0, 0, 0, 0);
  showShots_ = new QCheckBox(tr("Show shots in the view"), group);
  showShots_->setObjectName(QStringLiteral("show_shots"));
  auto* upper = new QHBoxLayout;
  column->addLayout(upper);
  upper->addWidget(showShots_, 1);
  limit_ = new QSpinBox(group);
  limit_->setObjectName(QStringLiteral("limit"));
  limit_->setAccessibleName(tr("How many shots are shown"));
  limit_->setToolTip(tr("The first shots of the first trial, exactly as in a run"));
  limit_->setRange(1, 5000);
  limit_->setSingleStep(100);
  limit_->setValue(300);
  limit_->setPrefix(tr("first "));
  limit_->setSuffix(tr(" shots"));
  limit_->setKeyboardTracking(false);
  upper->addWidget(limit_);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  auto* label = new QLabel(tr("Only those that first meet"), group);
  row->addWidget(label);
  firstHit_ = new QComboBox(group);
  firstHit_->setObjectName(QStringLiteral("first_hit"));
  firstHit_->setAccessibleName(tr("Show only shots that meet this first"));
  firstHit_->setToolTip(tr("Shots are coloured by what they meet first"));
  firstHit_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  firstHit_->setMinimumContentsLength(14);
  row->addWidget(firstHit_, 1);
  connect(showShots_, &QCheckBox::toggled, this, &ShotLineDialog::updateDisplay);
  connect(limit_, &QSpinBox::valueChanged, this, &ShotLineDialog::updateDisplay);
  connect(firstHit_, &QComboBox::currentIndexChanged, this, &ShotLineDialog::updateDisplay);
  for (QWidget* widget : std::initializer_list<QWidget*>{limit_, label, firstHit_}) {
    widget->setEnabled(false);
    connect(showShots_, &QCheckBox::toggled, widget, &QWidget::setEnabled);
  }
  return group;
}

QWidget* ShotLineDialog::makeRunRow() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  column->setContentsMargins(0, 0, 0, 0);
  estimate_ = new QLabel(group);
  estimate_->setObjectName(QStringLiteral("estimate"));
  estimate_->setWordWrap(true);
  column->addWidget(estimate_);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  outcome_ = new QLabel(group);
  outcome_->setObjectName(QStringLiteral("outcome"));
  outcome_->setWordWrap(true);
  outcome_->setTextFormat(Qt::PlainText);
  row->addWidget(outcome_, 1);
  progress_ = new QProgressBar(group);
  progress_->setObjectName(QStringLiteral("progress"));
  progress_->setRange(0, 1000);
  progress_->hide();
  row->addWidget(progress_, 1);
  auto* buttons = new QDialogButtonBox(group);
  run_ = buttons->addButton(tr("Run"), QDialogButtonBox::ActionRole);
  run_->setObjectName(QStringLiteral("run"));
  run_->setDefault(true);
  cancel_ = buttons->addButton(tr("Cancel run"), QDialogButtonBox::ActionRole);
  cancel_->setObjectName(QStringLiteral("cancel"));
  cancel_->hide();
  QPushButton* close = buttons->addButton(QDialogButtonBox::Close);
  close->setAutoDefault(false);
  row->addWidget(buttons);
  connect(run_, &QPushButton::clicked, this, [this] {
    if (const QString why = runs_.start(); !why.isEmpty()) {
      outcome_->setText(why);
    }
  });
  connect(cancel_, &QPushButton::clicked, this, [this] {
    cancel_->setEnabled(false);
    progress_->setFormat(tr("Stopping..."));
    runs_.cancel();
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  return group;
}

void ShotLineDialog::refresh() {
  const auto& sources = document_.study().sources;
  const bool there = std::any_of(sources.begin(), sources.end(),
                                 [this](const study::Source& source) { return source.name == source_; });
  if (!there) {
    source_ = sources.empty() ? std::string() : sources.front().name;
  }
  {
    const QScopedValueRollback quiet(refreshing_, true);
    refreshSources();
    refreshPoses();
    refreshStructures();
  }
  for (QWidget* part : std::initializer_list<QWidget*>{sourceSide_, runSide_}) {
    part->setEnabled(document_.hasStudy());
  }
  for (panels::PropertyForm* form : {sourceForm_, runForm_, analysesForm_}) {
    form->refresh();
  }
  refreshRun();
  updateDisplay();
}

void ShotLineDialog::refreshSources() {
  sources_->clear();
  for (const study::Source& source : document_.study().sources) {
    sources_->addItem(shown(source.name));
  }
  sources_->setCurrentIndex(sources_->findText(shown(source_), Qt::MatchExactly | Qt::MatchCaseSensitive));
  sources_->setToolTip(shown(source_));
  const bool any = !source_.empty();
  for (QWidget* widget :
       std::initializer_list<QWidget*>{sources_, duplicateSource_, removeSource_, renameSource_, sourceForm_}) {
    widget->setEnabled(any);
  }
}

void ShotLineDialog::refreshPoses() {
  const study::Study& study = document_.study();
  std::vector<std::string> names{"rest"};
  for (const study::Pose& pose : study.poses) {
    names.push_back(pose.name);
  }
  for (const std::string& pose : study.runPoses) {
    if (std::find(names.begin(), names.end(), pose) == names.end()) {
      extraPoses_.insert(pose);
    }
  }
  for (const std::string& pose : extraPoses_) {
    if (std::find(names.begin(), names.end(), pose) == names.end()) {
      names.push_back(pose);
    }
  }
  if (!document_.hasStudy()) {
    names.clear();
  }
  const std::vector<std::string> run = noPose_ ? std::vector<std::string>() : analysis::defaultPoses(study);
  while (poses_->count() > static_cast<int>(names.size())) {
    delete poses_->takeItem(poses_->count() - 1);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int at = static_cast<int>(i);
    QListWidgetItem* item = at < poses_->count() ? poses_->item(at) : new QListWidgetItem(poses_);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setText(shown(names[i]));
    item->setToolTip(shown(names[i]));
    item->setCheckState(std::find(run.begin(), run.end(), names[i]) != run.end() ? Qt::Checked : Qt::Unchecked);
  }
}

void ShotLineDialog::writePoses() {
  std::vector<std::string> chosen;
  bool allOfStudy = true;
  bool extras = false;
  const std::size_t own = document_.study().poses.size() + 1;
  for (int i = 0; i < poses_->count(); ++i) {
    const bool on = poses_->item(i)->checkState() == Qt::Checked;
    const bool extra = static_cast<std::size_t>(i) >= own;
    allOfStudy = allOfStudy && (on || extra);
    extras = extras || (on && extra);
    if (on) {
      chosen.push_back(poses_->item(i)->text().toStdString());
    }
  }
  noPose_ = chosen.empty();
  if (!noPose_) {
    // No list means rest and every pose, also those that come later.
    commands::setRunPoses(document_, allOfStudy && !extras ? std::vector<std::string>() : chosen);
  }
  refresh();
}

void ShotLineDialog::checkAllPoses(bool on) {
  {
    const QScopedValueRollback quiet(refreshing_, true);
    for (int i = 0; i < poses_->count(); ++i) {
      poses_->item(i)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
    }
  }
  writePoses();
}

void ShotLineDialog::refreshStructures() {
  const QString chosen =
      firstHit_->count() > 0 ? firstHit_->currentData().toString() : QString::fromStdString(ShotDisplay().onlyFirstHit);
  firstHit_->clear();
  firstHit_->addItem(tr("anything"), QStringLiteral("hits"));
  firstHit_->addItem(tr("anything or nothing"), QString());
  firstHit_->insertSeparator(2);
  firstHit_->addItem(tr("the body"), QStringLiteral("body"));
  firstHit_->addItem(tr("any armor"), QStringLiteral("armor"));
  firstHit_->addItem(tr("any organ"), QStringLiteral("organs"));
  firstHit_->insertSeparator(firstHit_->count());
  for (const std::string& structure : document::drawnStructures(document_.study())) {
    if (structure != "body") {
      firstHit_->addItem(shown(structure), shown(structure));
    }
  }
  firstHit_->setCurrentIndex(std::max(0, firstHit_->findData(chosen)));
}

void ShotLineDialog::renameSource() {
  const ItemRef item{ItemKind::source, source_};
  QString name = shown(source_);
  for (;;) {
    bool taken = false;
    name = QInputDialog::getText(this, tr("Rename source"), tr("Name of the source"), QLineEdit::Normal, name, &taken);
    if (!taken) {
      return;
    }
    const QString trouble = commands::renameTrouble(document_, item, name.toStdString());
    if (trouble.isEmpty()) {
      break;
    }
    QMessageBox::warning(this, tr("Rename source"), trouble);
  }
  source_ = name.toStdString();
  commands::renameItem(document_, item, source_);
  refresh();
}

void ShotLineDialog::setPickedPoint(const geometry::Vec3d& point) {
  if (!source_.empty()) {
    commands::setSourcePosition(document_, source_, point);
  }
  endPicking();
}

void ShotLineDialog::endPicking() {
  pick_->setChecked(false);
}

void ShotLineDialog::updateDisplay() {
  if (refreshing_) {
    return;
  }
  const auto& sources = document_.study().sources;
  ShotDisplay wanted;
  wanted.on = showShots_->isChecked() && !sources.empty();
  wanted.limit = static_cast<std::size_t>(limit_->value());
  wanted.onlyFirstHit = firstHit_->currentData().toString().toStdString();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].name == source_) {
      wanted.source = i;
    }
  }
  if (wanted != display_) {
    display_ = wanted;
    Q_EMIT shotDisplayChanged(display_);
  }
}

void ShotLineDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  measure();
}

void ShotLineDialog::hideEvent(QHideEvent* event) {
  QDialog::hideEvent(event);
  endPicking();
}

void ShotLineDialog::measure() {
  const auto loaded = document_.loaded();
  if (!isVisible() || loaded == nullptr || loaded->study.sources.empty() || loaded->study.models.empty() ||
      runs_.job() != nullptr || measuring_ != nullptr) {
    return;
  }
  // What decides how long a shot takes.
  QStringList deciding;
  for (const study::OrganModel model : loaded->study.models) {
    deciding.append(shown(viscera::name(model)));
  }
  deciding.append(QStringLiteral("%1 %2").arg(loaded->organs.size()).arg(loaded->pieces.size()));
  if (deciding.join(u' ') == measured_) {
    return;
  }
  measured_ = deciding.join(u' ');
  auto estimate = std::make_shared<jobs::SpeedEstimate>();
  measuring_ = std::make_unique<jobs::Job>(
      tr("Estimating the time"),
      [loaded, estimate](const base::Progress& progress) { *estimate = jobs::measureSpeed(*loaded, progress); });
  connect(measuring_.get(), &jobs::Job::finished, this, [this, estimate, of = document_.loaded()] {
    if (estimate->shotsPerSecond > 0.0) {
      speed_ = *estimate;
    }
  });
  connect(measuring_.get(), &jobs::Job::ended, this, [this] {
    measuring_.release()->deleteLater();
    refreshRun();
    measure();
  });
  measuring_->start();
  refreshRun();
}

QString ShotLineDialog::estimateText() const {
  const study::Study& study = document_.study();
  if (!document_.hasStudy()) {
    return {};
  }
  if (noPose_ || study.sources.empty()) {
    return {};
  }
  const std::size_t poses = analysis::defaultPoses(study).size();
  const double total = jobs::RunController::totalShots(study, document_.plan().get());
  const bool alike = std::all_of(study.sources.begin(), study.sources.end(), [&](const study::Source& source) {
    return source.shots == study.sources.front().shots && source.type != study::SourceType::list &&
           source.sequence != study::Sequence::grid;
  });
  QString text = tr("%1 × %2 × %3")
                     .arg(counted(poses, tr("%1 pose"), tr("%1 poses")),
                          counted(study.sources.size(), tr("%1 source"), tr("%1 sources")),
                          counted(study.trials, tr("%1 trial"), tr("%1 trials")));
  const QString all = models::grouped(static_cast<std::uint64_t>(std::min(total, 1e18)));
  text += alike ? tr(" × %1 shots = %2 shots").arg(models::grouped(study.sources.front().shots), all)
                : tr(", %1 shots in all").arg(all);
  if (study.stop && study.stop->maxTrials > study.trials) {
    text += tr(", and up to %1 trials where intervals are wide").arg(models::grouped(study.stop->maxTrials));
  }
  if (speed_) {
    const double seconds = total / speed_->shotsPerSecond + static_cast<double>(poses) * speed_->secondsPerPose;
    text += tr("; about %1 on this machine").arg(jobs::readableTime(seconds));
  } else if (measuring_ != nullptr) {
    text += tr("; estimating the time...");
  }
  return text;
}

QString ShotLineDialog::whyNotRun() const {
  if (runs_.job() != nullptr) {
    return {};
  }
  if (document_.hasStudy() && noPose_) {
    return tr("Choose at least one pose.");
  }
  if (draft_->isPending()) {
    return tr("Mend what is marked in the source first.");
  }
  return runs_.trouble();
}

void ShotLineDialog::refreshRun() {
  const bool running = runs_.job() != nullptr;
  const QString why = whyNotRun();
  estimate_->setText(estimateText());
  outcome_->setText(why.isEmpty() ? result_ : why);
  outcome_->setVisible(!running);
  progress_->setVisible(running);
  run_->setVisible(!running);
  cancel_->setVisible(running);
  run_->setEnabled(why.isEmpty());
}

void ShotLineDialog::runStarted() {
  clock_.start();
  shotsAsked_ = jobs::RunController::totalShots(document_.study(), document_.plan().get());
  posesAsked_ = static_cast<double>(analysis::defaultPoses(document_.study()).size());
  result_ = tr("Stopped.");
  cancel_->setEnabled(true);
  progress_->setValue(0);
  progress_->setFormat(QStringLiteral("%p %"));
  jobs::Job* job = runs_.job();
  connect(job, &jobs::Job::progressed, this, [this, job](double share) {
    progress_->setValue(static_cast<int>(std::lround(1000.0 * share)));
    if (!job->isCancelled()) {
      const QString left = job->timeLeft();
      progress_->setFormat(left.isEmpty() ? QStringLiteral("%p %") : QStringLiteral("%p %, ") + left);
    }
  });
  refreshRun();
}

void ShotLineDialog::runEnded() {
  refreshRun();
  measure();
}

}  // namespace lorica::dialogs
