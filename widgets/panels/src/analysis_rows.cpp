#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "item_form_parts.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

using document::StudyDocument;

namespace {

using Names = std::vector<std::string>;

bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Changes a copy of the rule for stopping; a value no study can hold is the row's to prevent.
void editStop(StudyDocument& document, const std::function<void(study::StopRule&)>& change) {
  study::StopRule stop = document.study().stop.value_or(study::StopRule());
  change(stop);
  if (commands::stopTroubles(stop).empty()) {
    commands::setStop(document, stop);
  }
}

/// The organs that matter most: those of the class `essential`, else the first.
Names organsToWatch(const study::Study& study) {
  Names names;
  for (const study::Organ& organ : study.organs) {
    if (organ.injuryClass == "essential") {
      names.push_back(organ.name);
    }
  }
  if (names.empty() && !study.organs.empty()) {
    names.push_back(study.organs.front().name);
  }
  return names;
}

QListWidget* smallList(PropertyForm& form, const char* id, const QString& label) {
  auto* list = new QListWidget(&form);
  list->setObjectName(QString::fromLatin1(id));
  list->setAccessibleName(label);
  list->setTextElideMode(Qt::ElideMiddle);
  list->setFixedHeight(form.fontMetrics().height() * 5);
  return list;
}

void fillWatched(QListWidget& list, const study::Study& study) {
  const Names chosen = study.stop ? study.stop->structures : Names();
  Names all;
  for (const study::Organ& organ : study.organs) {
    all.push_back(organ.name);
  }
  for (const std::string& name : chosen) {
    if (!has(all, name)) {
      all.push_back(name);
    }
  }
  while (list.count() > static_cast<int>(all.size())) {
    delete list.takeItem(list.count() - 1);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int at = static_cast<int>(i);
    QListWidgetItem* item = at < list.count() ? list.item(at) : new QListWidgetItem(&list);
    const bool on = has(chosen, all[i]);
    item->setText(i < study.organs.size() ? shown(all[i]) : Text::tr("%1 (not in the study)").arg(shown(all[i])));
    item->setData(Qt::UserRole, shown(all[i]));
    item->setToolTip(item->text());
    // A rule is about one organ at least.
    item->setFlags(on && chosen.size() == 1 ? Qt::ItemIsUserCheckable : Qt::ItemIsUserCheckable | Qt::ItemIsEnabled);
    item->setCheckState(on ? Qt::Checked : Qt::Unchecked);
  }
}

Names checkedOf(const QListWidget& list) {
  Names names;
  for (int i = 0; i < list.count(); ++i) {
    if (list.item(i)->checkState() == Qt::Checked) {
      names.push_back(list.item(i)->data(Qt::UserRole).toString().toStdString());
    }
  }
  return names;
}

void editAnalyses(StudyDocument& document, const std::function<void(study::Analyses&)>& change) {
  study::Analyses analyses = document.study().analyses;
  change(analyses);
  if (commands::analysesTroubles(analyses).empty()) {
    commands::setAnalyses(document, analyses);
  }
}

Names clipsOf(const StudyDocument& document) {
  Names names;
  if (document.loaded() != nullptr) {
    for (const human::Clip& clip : document.loaded()->clips) {
      names.push_back(clip.name);
    }
  }
  return names;
}

void addDirectionRows(PropertyForm& form) {
  StudyDocument& document = form.document();
  const auto directions = [&document] { return document.study().analyses.directions; };
  form.check(
      {"directions", QString(),
       Text::tr("Parallel beams from the middles of equal steps of azimuth and elevation, at every pose")},
      Text::tr("Coverage by direction"), [directions] { return directions().has_value(); },
      [&document](bool on) {
        editAnalyses(document, [on](study::Analyses& analyses) {
          analyses.directions = on ? std::optional(study::DirectionGrid()) : std::nullopt;
        });
      });
  QWidget* step = form.choice(
      {"direction_step", Text::tr("Step"), Text::tr("Of azimuth and elevation")},
      [] {
        std::vector<Choice> choices;
        for (int degrees = 1; degrees <= 90; ++degrees) {
          if (180 % degrees == 0) {
            choices.push_back(
                {Text::tr("%1°, %2 beams").arg(degrees).arg(64800 / (degrees * degrees)), QString::number(degrees)});
          }
        }
        return choices;
      },
      [directions] { return QString::number(directions().value_or(study::DirectionGrid()).step); },
      [&document](const QString& id) {
        editAnalyses(document, [&](study::Analyses& analyses) { analyses.directions->step = id.toDouble(); });
      });
  QWidget* shots = form.number(
      {"direction_shots", Text::tr("Shots of each beam")}, {1.0, 1e9, 1000.0, 0, {}},
      [directions] { return static_cast<double>(directions().value_or(study::DirectionGrid()).shots); },
      [&document](double value) {
        editAnalyses(document, [value](study::Analyses& analyses) {
          analyses.directions->shots = static_cast<std::uint64_t>(value);
        });
      });
  for (QWidget* row : {step, shots}) {
    form.showRowWhile(row, [directions] { return directions().has_value(); });
  }
}

void addMotionRows(PropertyForm& form) {
  StudyDocument& document = form.document();
  const auto motion = [&document] { return document.study().analyses.motion; };
  QCheckBox* box = form.check(
      {"motion", QString(), Text::tr("Coverage of the frames of a motion from every source")},
      Text::tr("Coverage over a motion"), [motion] { return motion().has_value(); },
      [&document](bool on) {
        editAnalyses(document, [&](study::Analyses& analyses) {
          analyses.motion.reset();
          if (const Names clips = clipsOf(document); on && !clips.empty()) {
            analyses.motion = study::MotionSettings{clips.front(), 5, 30.0};
          }
        });
      });
  form.onRefresh([&document, box, motion] { box->setEnabled(motion().has_value() || !clipsOf(document).empty()); });
  QWidget* clip = form.choice(
      {"motion_clip", Text::tr("Motion")},
      [&document, motion] {
        Names names = clipsOf(document);
        if (motion() && !has(names, motion()->clip)) {
          names.push_back(motion()->clip);
        }
        std::vector<Choice> choices;
        for (const std::string& name : names) {
          choices.push_back({shown(name), shown(name)});
        }
        return choices;
      },
      [motion] { return motion() ? shown(motion()->clip) : QString(); },
      [&document](const QString& id) {
        editAnalyses(document, [&](study::Analyses& analyses) { analyses.motion->clip = id.toStdString(); });
      });
  QWidget* every = form.number(
      {"motion_every", Text::tr("Every so many frames"), Text::tr("1: all of them; first and last always")},
      {1.0, 10000.0, 1.0, 0, {}}, [motion] { return motion() ? motion()->every : 1.0; },
      [&document](double value) {
        editAnalyses(document, [value](study::Analyses& analyses) {
          analyses.motion->every = static_cast<std::uint32_t>(value);
        });
      });
  QWidget* rate = form.number(
      {"motion_rate", Text::tr("Frames per second")}, {0.001, 1000.0, 5.0, 3, {}},
      [motion] { return motion() ? motion()->framesPerSecond : 30.0; },
      [&document](double value) {
        editAnalyses(document, [value](study::Analyses& analyses) { analyses.motion->framesPerSecond = value; });
      });
  for (QWidget* row : {clip, every, rate}) {
    form.showRowWhile(row, [motion] { return motion().has_value(); });
  }
}

/// Moves the structure that is chosen in the list up or down in the order of overlaps.
void moveInOrder(StudyDocument& document, QListWidget& list, int by) {
  study::Overlap overlap = document.study().overlap;
  const int from = list.currentRow();
  const int to = from + by;
  if (from < 0 || to < 0 || to >= static_cast<int>(overlap.order.size())) {
    return;
  }
  std::swap(overlap.order[static_cast<std::size_t>(from)], overlap.order[static_cast<std::size_t>(to)]);
  commands::setOverlap(document, overlap);
  list.setCurrentRow(to);
}

void addOverlapRows(PropertyForm& form) {
  using shotline::OverlapPolicy;
  StudyDocument& document = form.document();
  form.choice(
      {"overlap", Text::tr("Overlap belongs to"), Text::tr("In what is told of single shots")},
      [] {
        return std::vector<Choice>{
            {Text::tr("All"), QString::number(int(OverlapPolicy::allClaim)), Text::tr("Each has the whole length")},
            {Text::tr("The outermost"), QString::number(int(OverlapPolicy::outermost)),
             Text::tr("What the shot entered first")},
            {Text::tr("The first of a list"), QString::number(int(OverlapPolicy::priority)), {}}};
      },
      [&document] { return QString::number(int(document.study().overlap.policy)); },
      [&document](const QString& id) {
        study::Overlap overlap{OverlapPolicy(id.toInt()), {}};
        for (const std::string& structure : document::drawnStructures(document.study())) {
          if (overlap.policy == OverlapPolicy::priority && structure != "body") {
            overlap.order.push_back(structure);
          }
        }
        commands::setOverlap(document, overlap);
      });
  auto* group = new QWidget(&form);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(0, 0, 0, 0);
  QListWidget* list = smallList(form, "overlap_order", Text::tr("Order, the strongest first"));
  row->addWidget(list, 1);
  auto* buttons = new QVBoxLayout;
  row->addLayout(buttons);
  for (const bool up : {true, false}) {
    auto* button = new QToolButton(group);
    button->setObjectName(up ? QStringLiteral("order_up") : QStringLiteral("order_down"));
    button->setArrowType(up ? Qt::UpArrow : Qt::DownArrow);
    button->setToolTip(up ? Text::tr("Stronger") : Text::tr("Weaker"));
    buttons->addWidget(button);
    QObject::connect(button, &QToolButton::clicked, &form,
                     [&document, list, up] { moveInOrder(document, *list, up ? -1 : 1); });
  }
  buttons->addStretch(1);
  form.row(Text::tr("Order"), group, [&document, list] {
    QStringList names;
    for (const std::string& name : document.study().overlap.order) {
      names.append(shown(name));
    }
    const int current = list->currentRow();
    list->clear();
    list->addItems(names);
    list->setCurrentRow(current);
  });
  form.showRowWhile(group, [&document] { return document.study().overlap.policy == OverlapPolicy::priority; });
}

}  // namespace

void addStopRows(PropertyForm& form) {
  StudyDocument& document = form.document();
  const auto rule = [&document] { return document.study().stop; };
  QCheckBox* box = form.check(
      {"stop", QString(),
       Text::tr("More trials follow until the 95 % interval of each chosen organ's coverage is narrow enough")},
      Text::tr("Go on until certain"), [rule] { return rule().has_value(); },
      [&document](bool on) {
        if (on) {
          editStop(document, [&](study::StopRule& stop) { stop.structures = organsToWatch(document.study()); });
        } else {
          commands::setStop(document, std::nullopt);
        }
      });
  QListWidget* list = smallList(form, "stop_structures", Text::tr("Organs whose interval is to be narrow"));
  QObject::connect(list, &QListWidget::itemChanged, &form, [&document, &form, list] {
    if (!form.isRefreshing()) {
      editStop(document, [list](study::StopRule& stop) { stop.structures = checkedOf(*list); });
      form.refresh();
    }
  });
  form.row(Text::tr("Organs"), list, [&document, box, list, rule] {
    box->setEnabled(rule().has_value() || !document.study().organs.empty());
    fillWatched(*list, document.study());
  });
  form.showRowWhile(list, [rule] { return rule().has_value(); });
  form.trouble("stop_structures", [&document] {
    const auto& plan = document.plan();
    const bool about = plan != nullptr && plan->trouble && plan->trouble->place.starts_with("/stop") &&
                       plan->study->study.stop == document.study().stop;
    return about ? Text::tr("The rule names what is no organ of the study; take it off the list.") : QString();
  });
  QWidget* width = form.number(
      {"half_width", Text::tr("Half-width at most"), Text::tr("Of the interval of coverage, in points of percent")},
      {0.01, 50.0, 0.1, 2, Text::tr(" %")}, [rule] { return 100.0 * rule().value_or(study::StopRule()).halfWidth; },
      [&document](double percent) {
        editStop(document, [percent](study::StopRule& stop) { stop.halfWidth = percent / 100.0; });
      });
  QWidget* most = form.number(
      {"max_trials", Text::tr("Trials at most")}, {1.0, 100000.0, 100.0, 0, {}},
      [rule] { return static_cast<double>(rule().value_or(study::StopRule()).maxTrials); },
      [&document](double trials) {
        editStop(document, [trials](study::StopRule& stop) { stop.maxTrials = static_cast<std::uint32_t>(trials); });
      });
  for (QWidget* row : {width, most}) {
    form.showRowWhile(row, [rule] { return rule().has_value(); });
  }
}

void addAnalysesRows(PropertyForm& form) {
  StudyDocument& document = form.document();
  form.check(
      {"compare", QString(), Text::tr("Armor systems and organ models on the same shots, each piece left out")},
      Text::tr("Compare systems and models"), [&document] { return document.study().analyses.compare; },
      [&document](bool on) { editAnalyses(document, [on](study::Analyses& analyses) { analyses.compare = on; }); });
  form.check(
      {"convergence", QString(), Text::tr("Coverage and interval after 1, 2, 3 and so on trials")},
      Text::tr("Convergence over the trials"), [&document] { return document.study().analyses.convergence; },
      [&document](bool on) { editAnalyses(document, [on](study::Analyses& analyses) { analyses.convergence = on; }); });
  addDirectionRows(form);
  addMotionRows(form);
  addOverlapRows(form);
}

}  // namespace lorica::panels
