#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QListWidget>

#include "analysis_parts.h"

namespace lorica::panels {

namespace {

constexpr double millimetres = 1000.0;

bool hasPieces(const study::Study& study) {
  return std::any_of(study.systems.begin(), study.systems.end(),
                     [](const study::ArmorSystem& system) { return !system.pieces.empty(); });
}

}  // namespace

void addGapRows(PropertyForm& form) {
  document::StudyDocument& document = form.document();
  const auto gaps = [&document] { return document.study().analyses.gaps; };
  const auto edit = [&document](const std::function<void(study::GapSettings&)>& change) {
    editAnalyses(document, [&](study::Analyses& analyses) { change(*analyses.gaps); });
  };
  const QString tip = Text::tr("Patches of skin through which shots reach a structure past the armor");
  QCheckBox* box = form.check(
      {"gaps", QString(), tip}, Text::tr("Gaps in the armor"), [gaps] { return gaps().has_value(); },
      [&document](bool on) {
        editAnalyses(document, [&](study::Analyses& analyses) {
          analyses.gaps.reset();
          if (on) {
            analyses.gaps.emplace();
            analyses.gaps->structures = organsToWatch(document.study());
            if (analyses.gaps->structures.empty()) {
              analyses.gaps->structures = {"body"};
            }
          }
        });
      });
  form.onRefresh([&document, box, gaps, tip] {
    const bool can = gaps().has_value() || hasPieces(document.study());
    box->setEnabled(can);
    box->setToolTip(can ? tip : Text::tr("The study has no armor, so there are no gaps in it."));
  });
  QListWidget* list = addTickedNames(
      form,
      {"gap_structures", Text::tr("To protect"),
       Text::tr("Structures that shots must not reach past the armor; \"body\" is the skin")},
      [&document] {
        Names names = namesOf(document.study().organs);
        names.insert(names.begin(), "body");
        return names;
      },
      [gaps] { return gaps().value_or(study::GapSettings()).structures; },
      [edit](const Names& names) { edit([&](study::GapSettings& wanted) { wanted.structures = names; }); });
  QWidget* share = form.number(
      {"gap_share", Text::tr("Open above"),
       Text::tr("A place is open when more than this share of the shots through it is unprotected")},
      {0.0, 95.0, 5.0, 1, Text::tr(" %")}, [gaps] { return 100.0 * gaps().value_or(study::GapSettings()).openShare; },
      [edit](double percent) { edit([=](study::GapSettings& wanted) { wanted.openShare = percent / 100.0; }); });
  QWidget* shots = form.number(
      {"gap_shots", Text::tr("Shots at least"), Text::tr("On a patch, and for a place to be judged")},
      {1.0, 1e6, 10.0, 0, {}}, [gaps] { return static_cast<double>(gaps().value_or(study::GapSettings()).minShots); },
      [edit](double count) {
        edit([=](study::GapSettings& wanted) { wanted.minShots = static_cast<std::uint32_t>(count); });
      });
  QWidget* radius = form.number(
      {"gap_radius", Text::tr("Pooled within"),
       Text::tr("How far around a triangle of the skin shots are gathered where it has too few of its own")},
      {0.0, 1000.0, 5.0, 1, Text::tr(" mm")},
      [gaps] { return millimetres * gaps().value_or(study::GapSettings()).radius; },
      [edit](double value) { edit([=](study::GapSettings& wanted) { wanted.radius = value / millimetres; }); });
  QWidget* maps = form.check(
      {"gap_maps", QString(),
       Text::tr("Saved tables then hold a VTK file of skin, organs and armor for each system, "
                "model and pose")},
      Text::tr("Save heat maps too"), [gaps] { return gaps().value_or(study::GapSettings()).maps; },
      [edit](bool on) { edit([=](study::GapSettings& wanted) { wanted.maps = on; }); });
  for (QWidget* row : std::initializer_list<QWidget*>{list, share, shots, radius, maps}) {
    form.showRowWhile(row, [gaps] { return gaps().has_value(); });
  }
}

void addAnatomyRows(PropertyForm& form) {
  document::StudyDocument& document = form.document();
  const auto anatomy = [&document] { return document.study().analyses.anatomy; };
  const auto edit = [&document](const std::function<void(study::AnatomySettings&)>& change) {
    editAnalyses(document, [&](study::Analyses& analyses) { change(*analyses.anatomy); });
  };
  const QString tip = Text::tr(
      "How far coverage is open because nobody knows where in a person the organs lie: they are moved at "
      "random by published displacements and the same shots are traced again");
  QCheckBox* box = form.check(
      {"anatomy", QString(), tip}, Text::tr("Organs may lie elsewhere"), [anatomy] { return anatomy().has_value(); },
      [&document](bool on) {
        editAnalyses(document, [on](study::Analyses& analyses) {
          analyses.anatomy = on ? std::optional(study::AnatomySettings()) : std::nullopt;
        });
      });
  form.onRefresh([&document, box, anatomy, tip] {
    const bool can = anatomy().has_value() || !document.study().organs.empty();
    box->setEnabled(can);
    box->setToolTip(can ? tip : Text::tr("The study has no organs."));
  });
  QWidget* draws = form.number(
      {"anatomy_draws", Text::tr("Draws"), Text::tr("How often organs are moved; each takes as long as the run")},
      {2.0, 1e5, 10.0, 0, {}},
      [anatomy] { return static_cast<double>(anatomy().value_or(study::AnatomySettings()).draws); },
      [edit](double count) {
        edit([=](study::AnatomySettings& wanted) { wanted.draws = static_cast<std::uint32_t>(count); });
      });
  QWidget* scale = form.number(
      {"anatomy_scale", Text::tr("Displacements times"), Text::tr("1: as published")}, {0.0, 10.0, 0.1, 2, {}},
      [anatomy] { return anatomy().value_or(study::AnatomySettings()).scale; },
      [edit](double value) { edit([=](study::AnatomySettings& wanted) { wanted.scale = value; }); });
  QWidget* verified = form.check(
      {"anatomy_verified", QString(),
       Text::tr("Leave out published magnitudes whose source nobody has looked up again")},
      Text::tr("Only verified displacements"),
      [anatomy] { return anatomy().value_or(study::AnatomySettings()).verifiedOnly; },
      [edit](bool on) { edit([=](study::AnatomySettings& wanted) { wanted.verifiedOnly = on; }); });
  QWidget* given =
      form.fact({"anatomy_given", Text::tr("Given by the study"),
                 Text::tr("Standard deviations that stand in the study's file in place of published ones")},
                [anatomy] {
                  QStringList organs;
                  for (const auto& one : anatomy().value_or(study::AnatomySettings()).deviations) {
                    organs.append(shown(one.organ));
                  }
                  return organs.join(QStringLiteral(", "));
                });
  for (QWidget* row : {draws, scale, verified}) {
    form.showRowWhile(row, [anatomy] { return anatomy().has_value(); });
  }
  form.showRowWhile(given, [anatomy] { return anatomy() && !anatomy()->deviations.empty(); });
}

}  // namespace lorica::panels
