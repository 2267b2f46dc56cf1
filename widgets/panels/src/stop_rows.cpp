#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QListWidget>

#include "analysis_parts.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

namespace {

/// Changes a copy of the rule for stopping; a value no study can hold is the row's to prevent.
void editStop(document::StudyDocument& document, const std::function<void(study::StopRule&)>& change) {
  study::StopRule stop = document.study().stop.value_or(study::StopRule());
  change(stop);
  if (commands::stopTroubles(stop).empty()) {
    commands::setStop(document, stop);
  }
}

}  // namespace

void addStopRows(PropertyForm& form) {
  document::StudyDocument& document = form.document();
  const auto rule = [&document] { return document.study().stop; };
  const QString tip =
      Text::tr("More trials follow until the 95 % interval of each chosen organ's coverage is narrow enough");
  QCheckBox* box = form.check(
      {"stop", QString(), tip}, Text::tr("Go on until certain"), [rule] { return rule().has_value(); },
      [&document](bool on) {
        if (on) {
          editStop(document, [&](study::StopRule& stop) { stop.structures = organsToWatch(document.study()); });
        } else {
          commands::setStop(document, std::nullopt);
        }
      });
  form.onRefresh([&document, box, rule, tip] {
    const bool can = rule().has_value() || !document.study().organs.empty();
    box->setEnabled(can);
    box->setToolTip(can ? tip : Text::tr("The study has no organ whose coverage could get certain."));
  });
  QListWidget* list = addTickedNames(
      form, {"stop_structures", Text::tr("Organs"), Text::tr("Organs whose interval is to be narrow")},
      [&document] { return namesOf(document.study().organs); },
      [rule] { return rule().value_or(study::StopRule()).structures; },
      [&document](const Names& names) { editStop(document, [&](study::StopRule& stop) { stop.structures = names; }); });
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

}  // namespace lorica::panels
