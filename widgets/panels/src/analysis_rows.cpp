#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "analysis_parts.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

using document::StudyDocument;

namespace {

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
  const QString tip = Text::tr("Coverage of the frames of a motion from every source");
  QCheckBox* box = form.check(
      {"motion", QString(), tip}, Text::tr("Coverage over a motion"), [motion] { return motion().has_value(); },
      [&document](bool on) {
        editAnalyses(document, [&](study::Analyses& analyses) {
          analyses.motion.reset();
          if (const Names clips = clipsOf(document); on && !clips.empty()) {
            analyses.motion = study::MotionSettings{clips.front(), 5, 30.0};
          }
        });
      });
  form.onRefresh([&document, box, motion, tip] {
    const bool can = motion().has_value() || !clipsOf(document).empty();
    box->setEnabled(can);
    box->setToolTip(can ? tip : Text::tr("The body has no motion."));
  });
  QWidget* clip = form.choice(
      {"motion_clip", Text::tr("Motion")},
      [&document, motion] {
        Names names = clipsOf(document);
        if (motion() && !holdsName(names, motion()->clip)) {
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
  QListWidget* list = makeNameList(form, "overlap_order", Text::tr("Order, the strongest first"));
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
  addGapRows(form);
  addAnatomyRows(form);
  addDirectionRows(form);
  addMotionRows(form);
  addOverlapRows(form);
}

}  // namespace lorica::panels
