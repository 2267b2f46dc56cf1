#include "lorica/panels/survey_panel.h"

#include <QChart>
#include <QChartView>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "flow_layout.h"
#include "panel_parts.h"

namespace lorica::panels {

namespace {

using analysis::ResultRow;

using What = SurveyWhat;
constexpr int progressSteps = 1000;

QStringList listOf(const std::vector<std::string>& names) {
  QStringList list;
  for (const std::string& name : names) {
    list.append(QString::fromStdString(name));
  }
  return list;
}

}  // namespace

SurveyPanel::SurveyPanel(QWidget* parent) : QWidget(parent), pages_(new QStackedWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  layout->addWidget(pages_);
  pages_->addWidget(makeEmptyPage(
      tr("Gaps in the armor, coverage by direction, over a motion and over the places where organs may lie are shown "
         "here for a run whose study asks for them: Analysis > Shot lines, page Analyses."),
      this));
  auto* ask = new QWidget(this);
  auto* column = new QVBoxLayout(ask);
  words_ = new QLabel(ask);
  words_->setObjectName(QStringLiteral("survey_words"));
  words_->setWordWrap(true);
  words_->setAlignment(Qt::AlignCenter);
  words_->setTextFormat(Qt::PlainText);
  column->addStretch(1);
  column->addWidget(words_);
  auto* row = new QHBoxLayout;
  column->addLayout(row);
  column->addStretch(1);
  compute_ = new QPushButton(tr("Compute"), ask);
  compute_->setObjectName(QStringLiteral("survey_compute"));
  progress_ = new QProgressBar(ask);
  progress_->setRange(0, progressSteps);
  progress_->setMaximumWidth(fontMetrics().averageCharWidth() * 40);
  stop_ = new QPushButton(tr("Stop"), ask);
  stop_->setObjectName(QStringLiteral("survey_stop"));
  row->addStretch(1);
  for (QWidget* widget : std::initializer_list<QWidget*>{compute_, progress_, stop_}) {
    row->addWidget(widget);
  }
  row->addStretch(1);
  pages_->addWidget(ask);
  auto* content = new QWidget(this);
  auto* lower = new QVBoxLayout(content);
  lower->setContentsMargins(0, 0, 0, 0);
  lower->setSpacing(panelMargin);
  lower->addWidget(makeControls());
  figures_ = new QStackedWidget(content);
  map_ = new DirectionMap(figures_);
  lines_ = new QChartView(new QChart, figures_);
  lines_->setRenderHint(QPainter::Antialiasing);
  lines_->setMinimumSize(0, 0);
  figures_->addWidget(map_);
  figures_->addWidget(lines_);
  figures_->addWidget(makeTables());
  lower->addWidget(figures_, 1);
  worst_ = new QLabel(content);
  worst_->setWordWrap(true);
  worst_->setTextFormat(Qt::PlainText);
  lower->addWidget(worst_);
  pages_->addWidget(content);
  connect(compute_, &QPushButton::clicked, this, &SurveyPanel::compute);
  connect(stop_, &QPushButton::clicked, this, [this] {
    if (job_ != nullptr) {
      job_->cancel();
    }
  });
  refreshPages();
}

SurveyPanel::~SurveyPanel() = default;

QWidget* SurveyPanel::makeControls() {
  auto* bar = new QWidget(this);
  auto* flow = new FlowLayout(bar);
  what_ = makeChoice(tr("What is shown"), this);
  structure_ = makeChoice(tr("Structure"), this);
  system_ = makeChoice(tr("Armor system"), this);
  model_ = makeChoice(tr("Organ model"), this);
  pose_ = makeChoice(tr("Pose"), this);
  source_ = makeChoice(tr("Source of the shots"), this);
  const std::array<std::pair<QComboBox*, const char*>, 6> named{{{what_, "survey_what"},
                                                                 {structure_, "survey_structure"},
                                                                 {system_, "survey_system"},
                                                                 {model_, "survey_model"},
                                                                 {pose_, "survey_pose"},
                                                                 {source_, "survey_source"}}};
  for (const auto& [combo, name] : named) {
    combo->setObjectName(QLatin1String(name));
    flow->addWidget(combo);
    connect(combo, &QComboBox::currentIndexChanged, this, &SurveyPanel::refreshFigure);
  }
  auto* copy = new QToolButton(this);
  copy->setText(tr("Copy as CSV"));
  connect(copy, &QToolButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(QString::fromUtf8(csv())); });
  flow->addWidget(copy);
  return bar;
}

void SurveyPanel::setRun(std::shared_ptr<const document::RunRecord> run) {
  if (run == run_) {
    return;
  }
  jobs::abandon(job_, this);
  pickPatch({});
  run_ = std::move(run);
  survey_.reset();
  trouble_.clear();
  refreshPages();
}

void SurveyPanel::compute() {
  if (run_ == nullptr || !jobs::asksForSurvey(*run_) || job_ != nullptr) {
    return;
  }
  trouble_.clear();
  auto made = std::make_shared<jobs::RunSurvey>();
  job_ = std::make_unique<jobs::Job>(
      tr("Working out the analyses"),
      [made, run = run_](const base::Progress& progress) { *made = jobs::surveyOf(run, progress); });
  connect(job_.get(), &jobs::Job::progressed, this,
          [this](double share) { progress_->setValue(static_cast<int>(progressSteps * share)); });
  connect(job_.get(), &jobs::Job::finished, this, [this, made] { survey_ = made; });
  connect(job_.get(), &jobs::Job::failed, this, [this](const QString& text) { trouble_ = text; });
  connect(job_.get(), &jobs::Job::ended, this, [this] {
    job_.release()->deleteLater();
    refreshPages();
  });
  progress_->setValue(0);
  job_->start();
  refreshPages();
}

void SurveyPanel::refreshPages() {
  const bool asks = run_ != nullptr && jobs::asksForSurvey(*run_);
  pages_->setCurrentIndex(!asks ? 0 : survey_ == nullptr ? 1 : 2);
  if (asks && survey_ == nullptr) {
    const study::Analyses& asked = run_->study->study.analyses;
    QStringList parts;
    if (asked.gaps) {
      parts.append(tr("gaps in the armor"));
    }
    if (asked.anatomy) {
      parts.append(tr("%1 draws of where organs lie").arg(asked.anatomy->draws));
    }
    if (asked.directions) {
      parts.append(tr("coverage in steps of %1°").arg(asked.directions->step));
    }
    if (asked.motion) {
      parts.append(tr("coverage over %1").arg(QString::fromStdString(asked.motion->clip)));
    }
    words_->setText(!trouble_.isEmpty()
                        ? trouble_
                        : tr("%1 asks for %2.%3")
                              .arg(QString::fromStdString(run_->name), parts.join(tr(", ")),
                                   run_->result.partial ? tr(" It is partial: only its finished trials are shot again.")
                                                        : QString()));
    compute_->setVisible(job_ == nullptr);
    progress_->setVisible(job_ != nullptr);
    stop_->setVisible(job_ != nullptr);
  }
  if (survey_ != nullptr) {
    refreshChoices();
  }
}

void SurveyPanel::refreshChoices() {
  {
    const std::array quiet{QSignalBlocker(what_),  QSignalBlocker(structure_), QSignalBlocker(system_),
                           QSignalBlocker(model_), QSignalBlocker(pose_),      QSignalBlocker(source_)};
    what_->clear();
    if (!survey_->directions.empty()) {
      what_->addItem(tr("Coverage by direction"), What::coverageByDirection);
      what_->addItem(tr("Unprotected area by direction"), What::openByDirection);
    }
    if (!survey_->frames.empty()) {
      what_->addItem(tr("Coverage over time"), What::coverageOverTime);
    }
    if (survey_->gaps) {
      what_->addItem(tr("Gaps in the armor"), What::gapsInArmor);
    }
    if (survey_->anatomy) {
      what_->addItem(tr("Where organs may lie"), What::placesOfOrgans);
    }
    static const std::vector<ResultRow> none;
    const std::vector<ResultRow>& rows = !survey_->directions.empty() ? survey_->directions.front().rows
                                         : !survey_->frames.empty()   ? survey_->frames.front().rows
                                                                      : none;
    std::vector<std::string> structures;
    for (const ResultRow& row : rows) {
      if (row.kind != "armor" && row.structure != "miss" && row.structure != "armor" &&
          std::find(structures.begin(), structures.end(), row.structure) == structures.end()) {
        structures.push_back(row.structure);
      }
    }
    refill(*structure_, listOf(structures));
    const bool first = system_->count() == 0;
    refill(*system_, listOf(run_->result.systems));
    if (first && system_->count() > 1) {
      system_->setCurrentIndex(1);
    }
    std::vector<std::string> models;
    std::vector<std::string> sources;
    for (const viscera::OrganModel model : run_->result.models) {
      models.push_back(viscera::name(model));
    }
    for (const analysis::ShotSource& source : run_->result.sources) {
      sources.push_back(source.source.name);
    }
    refillModels(*model_, listOf(models));
    refill(*pose_, listOf(run_->result.poses));
    refill(*source_, listOf(sources));
  }
  refreshFigure();
}

void SurveyPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && lines_ != nullptr) {
    refreshFigure();
  }
}

}  // namespace lorica::panels
