#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTemporaryDir>
#include <QToolButton>
#include <QUndoStack>

#include "lorica/commands/shot_edits.h"
#include "lorica/panels/shot_forms.h"
#include "sample_document.h"
#include "shot_sources.h"

namespace lorica::panels {
namespace {

using study::Sampler;
using study::Sequence;
using study::SourceType;
using study::studyText;

/// A document and the forms of its sources and its run.
class Form : public testing::Test {
 protected:
  Form() : form_(document_) {
    document_.setStudy(testsupport::studyWithEverySource(), (folder_.path() + "/every.lorica.json").toStdString());
    document_.setLoaded(testsupport::loadedSample());
    draft_ = std::make_shared<SourceDraft>(document_, [this] { return name_; });
    draft_->onEdit([this] { form_.refresh(); });
    addSourceRows(form_, draft_);
    addRunRows(form_);
    addStopRows(form_);
    addAnalysesRows(form_);
    QObject::connect(&document_, &document::StudyDocument::studyChanged, &form_, &PropertyForm::refresh);
    form_.show();
  }

  template <class Editor>
  Editor* editor(const char* name) const {
    auto* found = form_.findChild<Editor*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  void show(const std::string& name) {
    name_ = name;
    form_.refresh();
  }
  const study::Source& source() const {
    const auto& sources = document_.study().sources;
    return *std::find_if(sources.begin(), sources.end(), [&](const auto& one) { return one.name == name_; });
  }
  void choose(const char* name, int id) {
    auto* combo = editor<QComboBox>(name);
    ASSERT_GE(combo->findData(QString::number(id)), 0) << name << " " << id;
    combo->setCurrentIndex(combo->findData(QString::number(id)));
  }
  void chooseType(SourceType type) { choose("type", static_cast<int>(type)); }
  void put(const char* name, double value) { editor<QDoubleSpinBox>(name)->setValue(value); }
  QString trouble(const char* name) const {
    const auto* label = editor<QLabel>((QByteArray(name) + "_trouble").constData());
    return label->isVisibleTo(&form_) ? label->text() : QString();
  }
  bool isShown(const char* name) const { return editor<QWidget>(name)->isVisibleTo(&form_); }
  std::string text() const { return studyText(document_.study()); }
  void writeShots(const char* lines) const {
    QFile file(folder_.path() + "/shots.csv");
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(lines);
  }

  QTemporaryDir folder_;
  document::StudyDocument document_;
  std::string name_ = "cone";
  PropertyForm form_;
  std::shared_ptr<SourceDraft> draft_;
};

TEST_F(Form, ShowsEverySourceWithoutChangingAByte) {
  const std::string before = text();
  for (const study::Source& one : document_.study().sources) {
    show(one.name);
    EXPECT_EQ(editor<QComboBox>("type")->currentData().toInt(), static_cast<int>(one.type)) << one.name;
    EXPECT_EQ(editor<QComboBox>("sampler")->currentData().toInt(), static_cast<int>(one.sampler)) << one.name;
    EXPECT_EQ(editor<QComboBox>("sequence")->currentData().toInt(), static_cast<int>(one.sequence)) << one.name;
    EXPECT_EQ(isShown("position"), one.type == SourceType::point) << one.name;
    EXPECT_EQ(isShown("azimuth"), one.type == SourceType::parallel) << one.name;
    EXPECT_EQ(isShown("azimuth_band_from"), one.type == SourceType::band) << one.name;
    EXPECT_EQ(isShown("file"), one.type == SourceType::list) << one.name;
    EXPECT_EQ(isShown("width"), one.sampler == Sampler::rectangle) << one.name;
    EXPECT_EQ(isShown("radius"), one.sampler == Sampler::disk) << one.name;
    EXPECT_EQ(isShown("sampler_warning"), one.sampler == Sampler::thesis) << one.name;
    EXPECT_EQ(isShown("cell"), one.sequence == Sequence::grid) << one.name;
    EXPECT_EQ(isShown("shots"), one.sequence != Sequence::grid && one.type != SourceType::list) << one.name;
    EXPECT_FALSE(draft_->isPending());
  }
  EXPECT_EQ(document_.undoStack().count(), 0);
  EXPECT_EQ(text(), before);
}

TEST_F(Form, RowsThatWereHiddenAreThereAgainInTheirHeight) {
  for (const char* name : {"listed", "window", "ground", "window"}) {
    show(name);
    QCoreApplication::processEvents();
  }
  put("width", 0.0);
  QCoreApplication::processEvents();
  for (const char* row : {"position", "seen", "target", "sampler", "width", "width_trouble", "height", "shots"}) {
    EXPECT_TRUE(editor<QWidget>(row)->isVisibleTo(&form_)) << row;
    EXPECT_GT(editor<QWidget>(row)->height(), 5) << row;
    EXPECT_LT(editor<QWidget>(row)->height(), 60) << row;
  }
}

/// One edit in the form of a source, and what it makes of it.
struct FormEdit {
  const char* source;
  const char* editor;
  double value;
  std::function<double(const study::Source&)> got;
};

class EveryFormEdit : public Form, public testing::WithParamInterface<FormEdit> {};

TEST_P(EveryFormEdit, ReachesTheStudyReadsBackAndIsUndoneToTheByte) {
  const FormEdit& edit = GetParam();
  const std::string before = text();
  show(edit.source);
  put(edit.editor, edit.value);
  EXPECT_NEAR(edit.got(source()), edit.value, 1e-9);
  EXPECT_NE(text(), before);
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  EXPECT_EQ(document_.undoStack().count(), 1);
  document_.undoStack().undo();
  EXPECT_EQ(text(), before);
  document_.undoStack().redo();
  EXPECT_NEAR(editor<QDoubleSpinBox>(edit.editor)->value(), edit.value, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    All, EveryFormEdit,
    testing::Values(FormEdit{"cone", "position_x", -1.5, [](const auto& s) { return s.position.x(); }},
                    FormEdit{"cone", "shots", 77, [](const auto& s) { return double(s.shots); }},
                    FormEdit{"window", "width", 0.25, [](const auto& s) { return s.width; }},
                    FormEdit{"window", "height", 0.375, [](const auto& s) { return s.height; }},
                    FormEdit{"spot", "radius", 0.5, [](const auto& s) { return s.radius; }},
                    FormEdit{"spot", "target_point_y", 1.0, [](const auto& s) { return s.target->y(); }},
                    FormEdit{"eq 15", "position_z", 4.0, [](const auto& s) { return s.position.z(); }},
                    FormEdit{"beam", "azimuth", 90.0, [](const auto& s) { return s.azimuth.from; }},
                    FormEdit{"beam", "elevation", 45.5, [](const auto& s) { return s.elevation.from; }},
                    FormEdit{"grid", "cell", 12.34, [](const auto& s) { return 1000.0 * s.cell; }},
                    FormEdit{"ground", "azimuth_band_from", 30.0, [](const auto& s) { return s.azimuth.from; }},
                    FormEdit{"ground", "azimuth_band_to", 200.0, [](const auto& s) { return s.azimuth.to; }},
                    FormEdit{"ground", "elevation_band_from", -5.0, [](const auto& s) { return s.elevation.from; }},
                    FormEdit{"ground", "elevation_band_to", 60.0, [](const auto& s) { return s.elevation.to; }},
                    FormEdit{"sphere", "shots", 4096, [](const auto& s) { return double(s.shots); }}),
    [](const auto& edit) {
      return QString("%1_%2").arg(edit.param.source, edit.param.editor).remove(' ').toStdString();
    });

TEST_F(Form, ASourceBecomesEveryOtherTypeAndComesBackToTheByte) {
  writeShots("x,y,z,az,el\n0,1,5,0,0\n");
  for (const study::Source& one : document_.study().sources) {
    const std::string name = one.name;
    for (const SourceType type : {SourceType::point, SourceType::parallel, SourceType::band, SourceType::sphere}) {
      const std::string before = text();
      const int steps = document_.undoStack().index();
      show(name);
      chooseType(type);
      EXPECT_EQ(source().type, type);
      EXPECT_EQ(study::parseStudy(text(), "s"), document_.study()) << name;
      while (document_.undoStack().index() > steps) {
        document_.undoStack().undo();
      }
      EXPECT_EQ(text(), before) << name;
    }
  }
}

TEST_F(Form, EverySamplerAndSequenceCanBeChosen) {
  for (const Sampler sampler : {Sampler::disk, Sampler::rectangle, Sampler::thesis, Sampler::cone}) {
    choose("sampler", static_cast<int>(sampler));
    EXPECT_EQ(source().sampler, sampler);
    EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  }
  show("beam");
  for (const Sequence sequence : {Sequence::sobol, Sequence::grid, Sequence::random}) {
    choose("sequence", static_cast<int>(sequence));
    EXPECT_EQ(source().sequence, sequence);
    EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  }
  show("sphere");
  EXPECT_EQ(editor<QComboBox>("sequence")->findData(QString::number(int(Sequence::grid))), -1)
      << "only a parallel beam has a grid";
}

TEST_F(Form, WhatCannotBeIsSaidAndNotTaken) {
  const std::string before = text();
  struct Bad {
    const char* source;
    const char* editor;
    double value;
    const char* field;
    double good;
  };
  for (const Bad& bad : {Bad{"window", "width", 0.0, "width", 0.5}, Bad{"window", "height", 0.0, "height", 0.75},
                         Bad{"spot", "radius", 0.0, "radius", 0.25}, Bad{"grid", "cell", 0.0, "cell", 5.0},
                         Bad{"ground", "azimuth_band_to", 0.0, "azimuth", 10.0},
                         Bad{"ground", "azimuth_band_from", -10.0, "azimuth", 0.0},
                         Bad{"ground", "elevation_band_from", 15.0, "elevation", -90.0}}) {
    show(bad.source);
    const int steps = document_.undoStack().count();
    put(bad.editor, bad.value);
    EXPECT_TRUE(draft_->isPending()) << bad.editor;
    const QString said = trouble(bad.field);
    EXPECT_TRUE(said.endsWith('.')) << bad.editor << ": " << said.toStdString();
    EXPECT_EQ(editor<QDoubleSpinBox>(bad.editor)->value(), bad.value) << "what was typed stays";
    EXPECT_EQ(document_.undoStack().count(), steps) << bad.editor;
    put(bad.editor, bad.good);
    EXPECT_FALSE(draft_->isPending()) << bad.editor;
    EXPECT_TRUE(trouble(bad.field).isEmpty());
    while (document_.undoStack().canUndo()) {
      document_.undoStack().undo();
    }
    EXPECT_EQ(text(), before);
  }
}

TEST_F(Form, AnotherSourceOrUndoDropsWhatWasNotTaken) {
  show("window");
  put("height", 0.5);
  put("width", 0.0);
  ASSERT_TRUE(draft_->isPending());
  document_.undoStack().undo();
  EXPECT_FALSE(draft_->isPending());
  EXPECT_EQ(editor<QDoubleSpinBox>("width")->value(), 0.5);
  put("width", 0.0);
  show("cone");
  EXPECT_FALSE(draft_->isPending());
}

TEST_F(Form, AListIsTakenWhenItsFileHoldsShots) {
  show("cone");
  chooseType(SourceType::list);
  EXPECT_TRUE(draft_->isPending()) << "no file yet";
  EXPECT_FALSE(trouble("file").isEmpty());
  EXPECT_EQ(source().type, SourceType::point);
  writeShots("x,y,z,dx,dy,dz\n0,1,5,0,0,-1\n0,1,5,0,0,0\n");
  draft_->setFile(folder_.path() + "/shots.csv");
  EXPECT_TRUE(trouble("file").contains("3")) << "the line: " << trouble("file").toStdString();
  EXPECT_EQ(source().type, SourceType::point);
  writeShots("x,y,z,dx,dy,dz\n0,1,5,0,0,-1\n0,1,5,0,0.1,-1\n");
  draft_->setFile(folder_.path() + "/shots.csv");
  EXPECT_TRUE(trouble("file").isEmpty()) << trouble("file").toStdString();
  EXPECT_EQ(source().type, SourceType::list);
  EXPECT_EQ(source().list.path, "shots.csv") << "as seen from the study";
  EXPECT_EQ(source().list.sha256.size(), 64U);
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  draft_->setFile(folder_.path() + "/none.csv");
  EXPECT_FALSE(trouble("file").isEmpty());
  EXPECT_EQ(source().list.path, "shots.csv");
}

TEST_F(Form, AzimuthElevationAndDistancePlaceThePoint) {
  show("spot");  // aimed at (0, 1.2, 0.1)
  put("seen_distance", 2.0);
  put("seen_azimuth", 90.0);
  put("seen_elevation", 0.0);
  EXPECT_LT((source().position - geometry::Vec3d(2.0, 1.2, 0.1)).norm(), 1e-5) << "90 is the person's left, +x";
  put("seen_azimuth", 0.0);
  EXPECT_LT((source().position - geometry::Vec3d(0.0, 1.2, 2.1)).norm(), 1e-5) << "0 is ahead, +z";
  put("seen_elevation", 30.0);
  EXPECT_NEAR(source().position.y(), 1.2 + 2.0 * 0.5, 1e-5);
}

TEST_F(Form, TargetsAreTheBodyAPointOrAStructure) {
  auto* target = editor<QComboBox>("target");
  target->setCurrentIndex(target->findData(":liver"));
  EXPECT_EQ(source().targetStructure, "liver");
  EXPECT_FALSE(source().target);
  target->setCurrentIndex(target->findData("point"));
  EXPECT_TRUE(source().targetStructure.empty());
  ASSERT_TRUE(source().target);
  EXPECT_GT(source().target->y(), 0.9) << "starts at the middle of the liver";
  target->setCurrentIndex(target->findData("body"));
  EXPECT_FALSE(source().target);
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  commands::removeItem(document_, {document::ItemKind::organ, "heart"});
  show("window");
  EXPECT_EQ(target->currentData().toString(), "body") << "its heart is gone";
}

TEST_F(Form, TheRuleForStoppingIsEdited) {
  const std::string before = text();
  EXPECT_TRUE(editor<QCheckBox>("stop")->isChecked());
  EXPECT_NEAR(editor<QDoubleSpinBox>("half_width")->value(), 1.23, 1e-12);
  put("half_width", 2.5);
  put("max_trials", 99);
  EXPECT_EQ(document_.study().stop->halfWidth, 0.025);
  EXPECT_EQ(document_.study().stop->maxTrials, 99U);
  auto* organs = editor<QListWidget>("stop_structures");
  const auto item = [organs](const char* name) { return organs->findItems(name, Qt::MatchExactly).value(0); };
  item("liver")->setCheckState(Qt::Unchecked);
  EXPECT_EQ(document_.study().stop->structures, std::vector<std::string>{"heart"});
  EXPECT_FALSE(item("heart")->flags().testFlag(Qt::ItemIsEnabled)) << "one organ is left";
  editor<QCheckBox>("stop")->setChecked(false);
  EXPECT_FALSE(document_.study().stop);
  EXPECT_FALSE(isShown("half_width"));
  editor<QCheckBox>("stop")->setChecked(true);
  EXPECT_FALSE(document_.study().stop->structures.empty());
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  while (document_.undoStack().canUndo()) {
    document_.undoStack().undo();
  }
  EXPECT_EQ(text(), before);
}

TEST_F(Form, TheAnalysesAreEdited) {
  const std::string before = text();
  EXPECT_EQ(editor<QComboBox>("direction_step")->currentData().toString(), "45");
  EXPECT_EQ(editor<QComboBox>("motion_clip")->currentData().toString(), "toe_touch");
  EXPECT_EQ(editor<QDoubleSpinBox>("motion_rate")->value(), 24.5);
  choose("direction_step", 20);
  put("direction_shots", 123);
  put("motion_every", 2);
  put("motion_rate", 50);
  auto* clip = editor<QComboBox>("motion_clip");
  clip->setCurrentIndex(clip->findData("belly_twist"));
  editor<QCheckBox>("compare")->setChecked(false);
  editor<QCheckBox>("convergence")->setChecked(false);
  const study::Analyses& analyses = document_.study().analyses;
  EXPECT_EQ(analyses.directions, (study::DirectionGrid{20.0, 123}));
  EXPECT_EQ(analyses.motion, (study::MotionSettings{"belly_twist", 2, 50.0}));
  EXPECT_FALSE(analyses.compare || analyses.convergence);
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  for (const char* box : {"directions", "motion", "gaps", "anatomy"}) {
    editor<QCheckBox>(box)->setChecked(false);
  }
  EXPECT_EQ(analyses, study::Analyses());
  EXPECT_FALSE(isShown("motion_clip"));
  editor<QCheckBox>("directions")->setChecked(true);
  editor<QCheckBox>("motion")->setChecked(true);
  EXPECT_TRUE(analyses.directions && analyses.motion);
  while (document_.undoStack().canUndo()) {
    document_.undoStack().undo();
  }
  EXPECT_EQ(text(), before);
}

TEST_F(Form, TheSearchForGapsIsEdited) {
  const std::string before = text();
  auto* list = editor<QListWidget>("gap_structures");
  EXPECT_EQ(list->item(0)->text(), "body") << "the skin is offered first";
  EXPECT_EQ(list->item(0)->checkState(), Qt::Checked);
  EXPECT_EQ(editor<QDoubleSpinBox>("gap_share")->value(), 20.0);
  EXPECT_EQ(editor<QDoubleSpinBox>("gap_radius")->value(), 12.5);
  list->item(0)->setCheckState(Qt::Unchecked);
  put("gap_share", 35);
  put("gap_shots", 50);
  put("gap_radius", 20);
  editor<QCheckBox>("gap_maps")->setChecked(true);
  const study::Analyses& analyses = document_.study().analyses;
  EXPECT_EQ(analyses.gaps, (study::GapSettings{{"liver"}, 0.35, 50, 0.02, true}));
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  const auto liver = list->findItems("liver", Qt::MatchExactly);
  ASSERT_EQ(liver.size(), 1);
  EXPECT_FALSE(liver.front()->flags().testFlag(Qt::ItemIsEnabled)) << "one must stay";
  editor<QCheckBox>("gaps")->setChecked(false);
  EXPECT_FALSE(analyses.gaps);
  EXPECT_FALSE(isShown("gap_structures"));
  editor<QCheckBox>("gaps")->setChecked(true);
  ASSERT_TRUE(analyses.gaps);
  EXPECT_FALSE(analyses.gaps->structures.empty());
  while (document_.undoStack().canUndo()) {
    document_.undoStack().undo();
  }
  EXPECT_EQ(text(), before);
}

TEST_F(Form, ThePlacesOfOrgansAreEditedAndWhatOnlyTheFileSaysStays) {
  put("anatomy_draws", 20);
  put("anatomy_scale", 1.5);
  editor<QCheckBox>("anatomy_verified")->setChecked(false);
  const auto& anatomy = document_.study().analyses.anatomy;
  ASSERT_TRUE(anatomy);
  EXPECT_EQ(anatomy->draws, 20U);
  EXPECT_EQ(anatomy->scale, 1.5);
  EXPECT_FALSE(anatomy->verifiedOnly);
  ASSERT_EQ(anatomy->deviations.size(), 1U);
  EXPECT_EQ(anatomy->deviations[0].organ, "liver");
  EXPECT_TRUE(isShown("anatomy_given"));
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
}

TEST_F(Form, GapsNeedArmorAndTheBoxSaysSo) {
  study::Study bare = document_.study();
  bare.systems.clear();
  bare.analyses.gaps.reset();
  document_.setStudy(bare, (folder_.path() + "/bare.lorica.json").toStdString());
  form_.refresh();
  EXPECT_FALSE(editor<QCheckBox>("gaps")->isEnabled());
  EXPECT_TRUE(editor<QCheckBox>("gaps")->toolTip().contains("no armor"));
}

TEST_F(Form, AnalysesFollowTheNamesOfOrgansAndForgetWhatIsGone) {
  commands::renameItem(document_, {document::ItemKind::organ, "liver"}, "hepar");
  const study::Analyses& analyses = document_.study().analyses;
  EXPECT_EQ(analyses.gaps->structures, (std::vector<std::string>{"body", "hepar"}));
  EXPECT_EQ(analyses.anatomy->deviations[0].organ, "hepar");
  commands::removeItem(document_, {document::ItemKind::organ, "hepar"});
  EXPECT_EQ(analyses.gaps->structures, (std::vector<std::string>{"body"}));
  EXPECT_TRUE(analyses.anatomy->deviations.empty());
  document_.undoStack().undo();
  document_.undoStack().undo();
  editor<QListWidget>("gap_structures")->item(0)->setCheckState(Qt::Unchecked);
  commands::removeItem(document_, {document::ItemKind::organ, "liver"});
  EXPECT_FALSE(analyses.gaps) << "nothing is left to protect";
}

TEST_F(Form, TheOrderOfOverlapsIsEdited) {
  auto* list = editor<QListWidget>("overlap_order");
  ASSERT_EQ(list->count(), 2);
  list->setCurrentRow(1);
  editor<QToolButton>("order_up")->click();
  EXPECT_EQ(document_.study().overlap.order, (std::vector<std::string>{"liver", "heart"}));
  EXPECT_EQ(list->currentRow(), 0);
  editor<QToolButton>("order_up")->click();
  EXPECT_EQ(document_.undoStack().count(), 1) << "it is the first";
  choose("overlap", static_cast<int>(shotline::OverlapPolicy::outermost));
  EXPECT_FALSE(isShown("overlap_order"));
  EXPECT_EQ(study::parseStudy(text(), "s"), document_.study());
  commands::renameItem(document_, {document::ItemKind::organ, "heart"}, "pump");
  document_.undoStack().undo();
  document_.undoStack().undo();
  commands::renameItem(document_, {document::ItemKind::organ, "heart"}, "pump");
  EXPECT_EQ(document_.study().overlap.order, (std::vector<std::string>{"liver", "pump"}));
  EXPECT_EQ(document_.study().stop->structures, (std::vector<std::string>{"pump", "liver"}));
  show("window");
  EXPECT_EQ(source().targetStructure, "pump") << "a new name reaches whatever refers to it";
}

TEST_F(Form, SaysWhatSharesAreOfAndWhatKeepsARunFromBeing) {
  auto loaded = std::make_shared<analysis::LoadedStudy>(*testsupport::loadedSample());
  loaded->study = document_.study();
  std::erase_if(loaded->study.sources, [](const auto& one) { return one.type == SourceType::list; });
  loaded->shotLists.resize(loaded->study.sources.size());
  auto plan = std::make_shared<document::RunPlan>();
  plan->study = loaded;
  plan->result = analysis::planRun(*loaded, {});
  document_.setPlan(plan);
  const auto measure = [&](const char* name) {
    show(name);
    return editor<QLabel>("measure")->text();
  };
  EXPECT_TRUE(measure("cone").endsWith("sr of solid angle")) << measure("cone").toStdString();
  EXPECT_TRUE(measure("ground").contains(QStringLiteral("m² of presented area"))) << measure("ground").toStdString();
  EXPECT_TRUE(measure("eq 15").startsWith("shots alone"));
  const auto& grid = std::find_if(plan->result.sources.begin(), plan->result.sources.end(),
                                  [](const auto& one) { return one.source.name == "grid"; });
  const auto side = std::get<shotline::ParallelBeam>(grid->source.shape).gridSide;
  EXPECT_GT(side, 50U);
  EXPECT_TRUE(measure("grid").remove(',').contains(QString::number(side * side))) << measure("grid").toStdString();

  auto bad = std::make_shared<document::RunPlan>();
  bad->study = loaded;
  bad->trouble = base::Issue{base::Severity::error, "x", "/sources/0/position", "the source is inside the body"};
  document_.setPlan(bad);
  show("cone");
  EXPECT_EQ(trouble("position"), "The source is inside the body.");
  show("window");
  EXPECT_TRUE(trouble("position").isEmpty());
}

}  // namespace
}  // namespace lorica::panels
