#include "lorica/commands/edits.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <map>

#include "lorica/base/error.h"
#include "lorica/document/appearance.h"
#include "lorica/study/human_study.h"
#include "lorica/study/study_file.h"
#include "two_systems.h"

namespace lorica::commands {
namespace {

using document::Change;
using document::Changes;
using document::ItemKind;
using study::studyText;
using viscera::OrganModel;

class Edits : public ::testing::Test {
 protected:
  Edits() { document_.setStudy(test::twoSystems(), "/studies/two.lorica.json"); }

  const study::Study& study() const { return document_.study(); }
  std::string text() const { return studyText(document_.study()); }
  int steps() const { return document_.undoStack().count(); }
  void expectReadsBack() const { EXPECT_EQ(study::parseStudy(text(), "s"), study()); }

  StudyDocument document_;
};

TEST(PersonEdit, IsOneStepThatUndoGivesBackToTheByte) {
  StudyDocument document;
  document.setStudy(study::parseStudy(study::templateText("sample"), "sample"), "/studies/sample.lorica.json");
  const std::string before = studyText(document.study());
  const human::Person woman{human::Sex::female, 1.628, 65.8};
  QSignalSpy changed(&document, &StudyDocument::studyChanged);
  setPerson(document, woman);
  EXPECT_EQ(document.undoStack().count(), 1);
  EXPECT_EQ(document.undoStack().undoText(), "Change the person");
  EXPECT_EQ(document.study().person, woman);
  ASSERT_EQ(changed.count(), 1);
  EXPECT_EQ(changed[0][0].value<Changes>(), Change::human | Change::armor) << "her plates are of another density";
  EXPECT_EQ(study::parseStudy(studyText(document.study()), "s"), document.study());
  setPerson(document, woman);
  EXPECT_EQ(document.undoStack().count(), 1) << "who is there already is no step";
  document.undoStack().undo();
  EXPECT_EQ(studyText(document.study()), before);
}

TEST(PersonEdit, BuiltInArmorTakesTheDensitiesOfTheNewPersonUnlessTheyWerePutInByHand) {
  const auto piecesOf = [](const study::Study& study) {
    std::map<std::string, std::optional<double>> densities;
    for (const study::ArmorSystem& system : study.systems) {
      for (const study::ArmorPiece& piece : system.pieces) {
        densities.emplace(piece.name, piece.arealDensity);
      }
    }
    return densities;
  };
  const human::Person man{human::Sex::male, 1.755, 84.6};
  study::HumanStudyOptions options{man, study::OrganChoice::none, {"full_torso"}};
  // Whoever wears another size of plates: the program's values differ.
  human::Person other = man;
  for (const human::Person& person :
       {human::Person{human::Sex::female, 1.5, 48.0}, human::Person{human::Sex::male, 2.0, 130.0}}) {
    const auto of = [&](const human::Person& whom) {
      study::HumanStudyOptions wanted = options;
      wanted.person = whom;
      return piecesOf(study::humanStudy(wanted));
    };
    other = of(person) != of(man) ? person : other;
  }
  StudyDocument document;
  document.setStudy(study::humanStudy(options), "/studies/human.lorica.json");
  const std::string byHand = document.study().systems[0].pieces[0].name;
  setArealDensity(document, byHand, 12.5);
  const std::string before = studyText(document.study());
  setPerson(document, other);
  EXPECT_EQ(document.undoStack().count(), 2);
  options.person = other;
  auto expected = piecesOf(study::humanStudy(options));
  expected[byHand] = 12.5;
  EXPECT_EQ(piecesOf(document.study()), expected);
  document.undoStack().undo();
  EXPECT_EQ(studyText(document.study()), before);
  document.undoStack().redo();
  EXPECT_EQ(piecesOf(document.study()), expected);
}

TEST(PersonEdit, IsForTheBuiltInHumanOnly) {
  StudyDocument document;
  study::Study study = study::parseStudy(study::templateText("sample"), "sample");
  study.human.from = study::InputFile{"body.glb", "", std::nullopt, std::nullopt};
  document.setStudy(study, "/studies/s.lorica.json");
  EXPECT_THROW(setPerson(document, {human::Sex::female, 1.628, 65.8}), base::CallerError);
}

// --- each edit ------------------------------------------------------------------------------------------------------

struct Edit {
  const char* name;
  std::function<void(StudyDocument&)> run;
  Changes touches;
  const char* text;
};

void PrintTo(const Edit& edit, std::ostream* out) {
  *out << edit.name;
}

study::Study withAnotherOrgan() {
  study::Study study = test::twoSystems();
  study.organs.push_back(study.organs.front());
  study.organs.back().name = "heart 2";
  return study;
}

study::LatticeSettings threeCells() {
  study::LatticeSettings lattice;
  lattice.layout = study::LatticeSettings::Layout::uniform;
  lattice.cells = {3, 3, 3};
  return lattice;
}

const Changes organsAndDisplay = Changes(Change::organs) | Change::sources | Change::run | Change::display;
const Changes armorAndDisplay = Changes(Change::armor) | Change::sources | Change::run | Change::display;

std::vector<Edit> allEdits() {
  using D = StudyDocument;
  return {
      {"StudyName", [](D& d) { setStudyName(d, "other"); }, Change::general, "Name of the study"},
      {"StudyDescription", [](D& d) { setStudyDescription(d, "two\nlines"); }, Change::general,
       "Description of the study"},
      {"Models", [](D& d) { setModels(d, {OrganModel::dynamic}); }, Change::run, "Organ models"},
      {"Deformer", [](D& d) { setDeformer(d, study::Deformer::lattice); }, Change::organs, "How organs deform"},
      {"Trials", [](D& d) { setTrials(d, 7); }, Change::run, "Trials"},
      {"Seed", [](D& d) { setSeed(d, 18446744073709551615ULL); }, Change::run, "Seed"},
      {"RunPoses",
       [](D& d) {
         setRunPoses(d, {"turned", "toe_touch@0.5"});
       },
       Change::poses, "Poses to run"},
      {"NoRunPoses", [](D& d) { setRunPoses(d, {}); }, Change::poses, "Poses to run"},
      {"Hide", [](D& d) { setVisible(d, "heart", false); }, Change::display, "Hide heart"},
      {"Show", [](D& d) { setVisible(d, "liver", true); }, Change::display, "Show liver"},
      {"HideMany",
       [](D& d) {
         setAllVisible(d, {"heart", "liver", "widget"}, false, "Hide organs");
       },
       Change::display, "Hide organs"},
      {"Colour",
       [](D& d) {
         setColour(d, "heart", {{1, 2, 3}});
       },
       Change::display, "Colour of heart"},
      {"UsualColour", [](D& d) { setColour(d, "liver", {}); }, Change::display, "Colour of liver"},
      {"Opacity", [](D& d) { setOpacity(d, "heart", 0.125); }, Change::display, "Opacity of heart"},
      {"UsualOpacity", [](D& d) { setOpacity(d, "body", {}); }, Change::display, "Opacity of body"},
      {"InjuryClass", [](D& d) { setInjuryClass(d, "heart", ""); }, Change::organs, "Injury class of heart"},
      {"Joint", [](D& d) { setJoint(d, "heart", "spine_1"); }, Change::organs, "Joint of heart"},
      {"NearestJoint", [](D& d) { setJoint(d, "liver", {}); }, Change::organs, "Joint of liver"},
      {"Lattice", [](D& d) { setLattice(d, "heart", threeCells()); }, Change::organs, "Lattice of heart"},
      {"OrganDescription",
       [](D& d) {
         setDescription(d, {ItemKind::organ, "heart"}, "Beats.\nTwice a second.");
       },
       Change::organs, "Description of heart"},
      {"PieceDescription",
       [](D& d) {
         setDescription(d, {ItemKind::piece, "small"}, "Of polyethylene.");
       },
       Change::armor, "Description of small"},
      {"SourceDescription",
       [](D& d) {
         setDescription(d, {ItemKind::source, "left"}, "A window.");
       },
       Change::sources, "Description of left"},
      {"PoseDescription",
       [](D& d) {
         setDescription(d, {ItemKind::pose, "turned"}, "Looks back.");
       },
       Change::poses, "Description of turned"},
      {"Carriage", [](D& d) { setCarriage(d, "small", study::Carriage::skinned); }, Change::armor, "Carriage of small"},
      {"Material", [](D& d) { setMaterial(d, "small", "UHMWPE"); }, Change::armor, "Material of small"},
      {"ArealDensity", [](D& d) { setArealDensity(d, "small", 24.5); }, Change::armor, "Areal density of small"},
      {"NonProtecting",
       [](D& d) {
         setNonProtecting(d, "front", {"strap", "pouch*"});
       },
       Change::armor, "Parts of front that do not protect"},
      {"SourcePosition",
       [](D& d) {
         setSourcePosition(d, "left", {4, 1, 0});
       },
       Change::sources, "Move source left"},
      {"SourceTarget", [](D& d) { setSourceTarget(d, "left", geometry::Vec3d(0, 1.2, 0)); }, Change::sources,
       "Target of source left"},
      {"SourceShots", [](D& d) { setSourceShots(d, "left", 5); }, Change::sources, "Shots of source left"},
      {"AddSource", [](D& d) { addSource(d); }, Change::sources, "Add source source"},
      {"AddPose",
       [](D& d) {
         addPose(d, {"toe_touch@1", study::ClipPose{"toe_touch", 1.0}});
       },
       Change::poses, "Add pose toe_touch@1"},
      {"Replace", [](D& d) { replaceStudy(d, withAnotherOrgan(), "Add 1 organ"); }, document::everything,
       "Add 1 organ"},
      {"RemoveOrgan",
       [](D& d) {
         removeItem(d, {ItemKind::organ, "liver"});
       },
       organsAndDisplay, "Remove organ liver"},
      {"RemoveSystem",
       [](D& d) {
         removeItem(d, {ItemKind::system, "light"});
       },
       armorAndDisplay, "Remove armor system light"},
      {"RemovePiece",
       [](D& d) {
         removeItem(d, {ItemKind::piece, "small"});
       },
       armorAndDisplay, "Remove armor piece small"},
      {"RemovePose",
       [](D& d) {
         removeItem(d, {ItemKind::pose, "bent"});
       },
       Change::poses, "Remove pose bent"},
      {"RemoveSource",
       [](D& d) {
         removeItem(d, {ItemKind::source, "ahead"});
       },
       Change::sources, "Remove source ahead"},
      {"RenameOrgan",
       [](D& d) {
         renameItem(d, {ItemKind::organ, "liver"}, "hepar");
       },
       organsAndDisplay, "Rename liver to hepar"},
      {"RenameSystem",
       [](D& d) {
         renameItem(d, {ItemKind::system, "light"}, "lighter");
       },
       armorAndDisplay, "Rename light to lighter"},
      {"RenamePiece",
       [](D& d) {
         renameItem(d, {ItemKind::piece, "small"}, "tiny");
       },
       armorAndDisplay, "Rename small to tiny"},
      {"RenamePose",
       [](D& d) {
         renameItem(d, {ItemKind::pose, "bent"}, "stoop");
       },
       Change::poses, "Rename bent to stoop"},
      {"RenameSource",
       [](D& d) {
         renameItem(d, {ItemKind::source, "left"}, "port");
       },
       Change::sources, "Rename left to port"},
  };
}

/// Those that can be done to what they leave.
std::vector<Edit> repeatableEdits() {
  std::vector<Edit> edits = allEdits();
  std::erase_if(edits, [](const Edit& edit) {
    const QString name = edit.name;
    return name.startsWith("Remove") || name.startsWith("Rename") || name == "AddSource";
  });
  return edits;
}

class EachEdit : public Edits, public ::testing::WithParamInterface<Edit> {};
class EachRepeatableEdit : public EachEdit {};

TEST_P(EachEdit, IsOneNamedStepThatIsUndoneAndRedoneToTheByte) {
  const std::string before = text();
  QSignalSpy changed(&document_, &StudyDocument::studyChanged);
  GetParam().run(document_);
  const std::string after = text();
  EXPECT_NE(after, before);
  EXPECT_EQ(steps(), 1);
  EXPECT_EQ(document_.undoStack().undoText(), GetParam().text);
  expectReadsBack();

  document_.undoStack().undo();
  EXPECT_EQ(text(), before);
  EXPECT_EQ(study(), test::twoSystems());
  document_.undoStack().redo();
  EXPECT_EQ(text(), after);
  ASSERT_EQ(changed.count(), 3) << "done, undone, redone";
  for (const QList<QVariant>& signal : changed) {
    EXPECT_EQ(signal.at(0).value<Changes>(), GetParam().touches);
  }
}

TEST_P(EachRepeatableEdit, IsNoStepWhenItChangesNothing) {
  GetParam().run(document_);
  const std::string once = text();
  GetParam().run(document_);
  EXPECT_EQ(steps(), 1);
  EXPECT_EQ(text(), once);
}

INSTANTIATE_TEST_SUITE_P(All, EachEdit, ::testing::ValuesIn(allEdits()),
                         [](const auto& edit) { return std::string(edit.param.name); });

INSTANTIATE_TEST_SUITE_P(All, EachRepeatableEdit, ::testing::ValuesIn(repeatableEdits()),
                         [](const auto& edit) { return std::string(edit.param.name); });

// --- drags ----------------------------------------------------------------------------------------------------------

TEST_F(Edits, OfADragAreOneStep) {
  const std::string before = text();
  for (int i = 1; i <= 10; ++i) {
    setOpacity(document_, "heart", 1.0 - 0.05 * i);
  }
  EXPECT_EQ(steps(), 1);
  for (int i = 1; i <= 10; ++i) {
    setSourcePosition(document_, "left", {5.0 - 0.1 * i, 1, 0});
  }
  EXPECT_EQ(steps(), 2);
  for (int i = 1; i <= 10; ++i) {
    setSourceTarget(document_, "left", geometry::Vec3d(0, 0.1 * i, 0));
  }
  EXPECT_EQ(steps(), 3);
  document_.undoStack().undo();
  document_.undoStack().undo();
  EXPECT_EQ(document::appearanceOf(study(), "heart").opacity, 0.5);
  document_.undoStack().undo();
  EXPECT_EQ(text(), before);
}

TEST_F(Edits, OfDifferentThingsStaySteps) {
  setOpacity(document_, "heart", 0.5);
  setOpacity(document_, "liver", 0.5);
  setSourcePosition(document_, "left", {1, 1, 1});
  setSourcePosition(document_, "ahead", {1, 1, 1});
  setColour(document_, "heart", {{1, 1, 1}});
  setColour(document_, "heart", {{2, 2, 2}});
  EXPECT_EQ(steps(), 6);
}

TEST_F(Edits, OfADragThatReturnsToItsStartVanish) {
  const std::string before = text();
  for (const double opacity : {0.5, 0.75, 0.25, 1.0}) {
    setOpacity(document_, "heart", opacity);
  }
  EXPECT_EQ(text(), before);
  EXPECT_EQ(steps(), 0);
  for (const double opacity : {0.1, 0.5}) {
    setOpacity(document_, "body", opacity);
  }
  for (const double x : {4.0, 3.0, 5.0}) {
    setSourcePosition(document_, "left", {x, 1, 0});
  }
  EXPECT_EQ(text(), before);
  EXPECT_EQ(steps(), 0);
  EXPECT_FALSE(document_.undoStack().canUndo());
}

// --- what is kept of displays ---------------------------------------------------------------------------------------

TEST_F(Edits, KeepOnlyDisplaysThatDifferFromTheDefaultInTheOrderOfDrawing) {
  setVisible(document_, "back", false);
  setVisible(document_, "heart", false);
  std::vector<std::string> listed;
  for (const study::Display& display : study().displays) {
    listed.push_back(display.structure);
  }
  EXPECT_EQ(listed, (std::vector<std::string>{"body", "heart", "liver", "back", "small"}));
  setVisible(document_, "back", true);
  setVisible(document_, "heart", true);
  EXPECT_EQ(study(), test::twoSystems());
  setVisible(document_, "small", false);
  setOpacity(document_, "body", 0.25);
  setVisible(document_, "liver", true);
  setColour(document_, "liver", {});
  EXPECT_TRUE(study().displays.empty()) << text();
}

TEST_F(Edits, ColourAHiddenPieceWithoutShowingIt) {
  setVisible(document_, "small", false);
  setColour(document_, "small", {{1, 2, 3}});
  EXPECT_FALSE(document::appearanceOf(study(), "small").visible);
  EXPECT_EQ(document::appearanceOf(study(), "small").colour, QColor(1, 2, 3));
}

TEST_F(Edits, OfADisplayListInAnyOrderAreUndoneToTheByte) {
  study::Study jumbled = test::twoSystems();
  jumbled.displays = {{"nothing", false, {}, {}}, {"small", true, {}, 0.5}, {"heart", true, {}, {}}};
  document_.setStudy(jumbled, "/studies/two.lorica.json");
  const std::string before = text();
  setVisible(document_, "heart", true);
  EXPECT_EQ(steps(), 0) << "it is visible";
  setVisible(document_, "heart", false);
  expectReadsBack();
  EXPECT_EQ(study().displays.front().structure, "heart");
  EXPECT_EQ(study().displays.back().structure, "nothing");
  document_.undoStack().undo();
  EXPECT_EQ(text(), before);
}

TEST_F(Edits, ThatRemoveTheFirstSystemLetTheNextOneFollowTheDefault) {
  setVisible(document_, "small", false);
  setColour(document_, "small", {{1, 2, 3}});
  removeItem(document_, {ItemKind::system, "plates"});
  EXPECT_TRUE(document::appearanceOf(study(), "small").visible);
  EXPECT_EQ(document::appearanceOf(study(), "small").colour, QColor(1, 2, 3));
  document_.undoStack().undo();
  EXPECT_FALSE(document::appearanceOf(study(), "small").visible);
}

// --- values ---------------------------------------------------------------------------------------------------------

TEST_F(Edits, KeepOfALatticeWhatItsLayoutUses) {
  study::LatticeSettings lattice = threeCells();
  lattice.cellMetres = 0.0123456;
  setLattice(document_, "heart", lattice);
  expectReadsBack();
  lattice.layout = study::LatticeSettings::Layout::boundingBox;
  setLattice(document_, "heart", lattice);
  expectReadsBack();
  lattice.layout = study::LatticeSettings::Layout::cellSize;
  for (const double metres : {0.0123456, 1.0 / 30.0, 0.1 / 3.0, 0.0333, 2.0}) {
    lattice.cellMetres = metres;
    setLattice(document_, "heart", lattice);
    expectReadsBack();
    EXPECT_NEAR(study().organs[0].lattice.cellMetres, metres, 1e-15);
  }
  lattice.cellMetres = 0.0;
  EXPECT_THROW(setLattice(document_, "heart", lattice), base::CallerError);
}

TEST_F(Edits, MakeNamesAndPositionsFitTheFile) {
  setStudyName(document_, "tab\there");
  EXPECT_EQ(study().name, "tab here");
  setStudyName(document_, "");
  expectReadsBack();
  setSourcePosition(document_, "left", {1e9, -1e9, 0});
  setNonProtecting(document_, "front", {"strap", "strap"});
  setModels(document_, {OrganModel::dynamic, OrganModel::dynamic});
  setRunPoses(document_, {"rest", "rest"});
  expectReadsBack();
}

TEST_F(Edits, RefuseWhatAStudyCannotHold) {
  const std::string before = text();
  EXPECT_THROW(setTrials(document_, 0), base::CallerError);
  EXPECT_THROW(setOpacity(document_, "heart", 1.5), base::CallerError);
  EXPECT_THROW(setSourceShots(document_, "left", 0), base::CallerError);
  EXPECT_THROW(setSourcePosition(document_, "left", {std::nan(""), 0, 0}), base::CallerError);
  EXPECT_THROW(setInjuryClass(document_, "heart", "vital"), base::CallerError);
  EXPECT_THROW(setVisible(document_, "absent", true), base::CallerError);
  EXPECT_THROW(setJoint(document_, "absent", {}), base::CallerError);
  EXPECT_THROW(setRunPoses(document_, {"absent"}), base::CallerError);
  EXPECT_THROW(setStudyName(document_, "\xff"), base::CallerError);
  EXPECT_THROW(addPose(document_, {"walk@2", study::ClipPose{"walk", 1.0}}), base::CallerError);
  EXPECT_THROW(removeItem(document_, {ItemKind::pose, "rest"}), base::CallerError);
  EXPECT_THROW(removeItem(document_, {ItemKind::organ, "absent"}), base::CallerError);
  EXPECT_EQ(text(), before);
  EXPECT_EQ(steps(), 0);
}

// --- structure ------------------------------------------------------------------------------------------------------

TEST_F(Edits, AddSourcesOfNewNamesAndSelectThem) {
  EXPECT_EQ(addSource(document_), "source");
  EXPECT_EQ(addSource(document_), "source 2");
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::source, "source 2"}));
  EXPECT_EQ(study().sources.back().position, geometry::Vec3d(0, 1, 5));
  document_.undoStack().undo();
  EXPECT_EQ(document_.selection(), std::nullopt);
  EXPECT_EQ(addSource(document_), "source 2");
}

TEST_F(Edits, AddSourcesFiveMetresAheadOfTheLoadedBody) {
  const study::Study sample = study::parseStudy(study::templateText("sample"), "sample");
  auto loaded = std::make_shared<const analysis::LoadedStudy>(analysis::load(sample, "sample.lorica.json", {}));
  document_.setStudy(sample, "sample.lorica.json");
  document_.setLoaded(loaded);
  addSource(document_);
  const geometry::Vec3d position = study().sources.back().position;
  EXPECT_EQ(study::parseStudy(text(), "s"), study());
  geometry::Vec3d low = geometry::Vec3d::Constant(1e9);
  geometry::Vec3d high = -low;
  for (const geometry::Vec3f& point : loaded->body->body().skin.positions) {
    low = low.cwiseMin(point.cast<double>());
    high = high.cwiseMax(point.cast<double>());
  }
  EXPECT_LE((position - (low + high) / 2.0 - geometry::Vec3d(0, 0, 5)).cwiseAbs().maxCoeff(), 0.000501);
  for (const double metres : position) {
    EXPECT_EQ(metres, std::round(metres * 1000.0) / 1000.0);
  }
}

TEST_F(Edits, AddAPoseOnceAndSelectIt) {
  addPose(document_, {"bent", study::ClipPose{"walk", 1.0}});
  EXPECT_EQ(steps(), 0);
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::pose, "bent"}));
  addPose(document_, {"rest", study::TurnedPose{}});
  EXPECT_EQ(steps(), 0);
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::pose, "rest"}));
}

TEST_F(Edits, ThatRemoveTakeWhatRefersToItAlong) {
  document_.select(ItemRef{ItemKind::organ, "liver"});
  removeItem(document_, {ItemKind::organ, "liver"});
  EXPECT_EQ(document_.selection(), std::nullopt);
  removeItem(document_, {ItemKind::system, "light"});
  ASSERT_EQ(study().displays.size(), 1U);
  EXPECT_EQ(study().displays[0].structure, "body");
  document_.showPose("bent");
  removeItem(document_, {ItemKind::pose, "bent"});
  EXPECT_EQ(study().runPoses, (std::vector<std::string>{"rest", "toe_touch@2"}));
  EXPECT_EQ(document_.shownPose(), "rest");
  document_.undoStack().setIndex(0);
  EXPECT_EQ(study(), test::twoSystems());
}

TEST_F(Edits, TellOfADroppedSelectionAfterItIsGone) {
  document_.select(ItemRef{ItemKind::organ, "liver"});
  bool heard = false;
  QObject::connect(&document_, &StudyDocument::studyChanged, [&] {
    heard = true;
    EXPECT_EQ(document_.selection(), std::nullopt);
  });
  QSignalSpy dropped(&document_, &StudyDocument::selectionChanged);
  removeItem(document_, {ItemKind::organ, "liver"});
  EXPECT_TRUE(heard);
  EXPECT_EQ(dropped.count(), 1);
}

TEST_F(Edits, ThatRenameFollowEveryReference) {
  document_.select(ItemRef{ItemKind::organ, "liver"});
  renameItem(document_, {ItemKind::organ, "liver"}, "hepar");
  EXPECT_EQ(study().displays[1].structure, "hepar");
  EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::organ, "hepar"}));
  renameItem(document_, {ItemKind::piece, "small"}, "tiny");
  EXPECT_EQ(study().displays[2].structure, "tiny");
  document_.showPose("bent");
  renameItem(document_, {ItemKind::pose, "bent"}, "toe_touch@2");
  EXPECT_EQ(study().runPoses, (std::vector<std::string>{"rest", "toe_touch@2"})) << "the run listed it already";
  EXPECT_EQ(document_.shownPose(), "toe_touch@2");
  expectReadsBack();
}

TEST_F(Edits, ThatRenameToAnUnknownDisplayedNameTakeItsPlace) {
  study::Study study = test::twoSystems();
  study.displays.push_back({"hepar", true, {}, 0.1});
  document_.setStudy(study, "s.lorica.json");
  renameItem(document_, {ItemKind::organ, "liver"}, "hepar");
  expectReadsBack();
  EXPECT_EQ(document::appearanceOf(document_.study(), "hepar").opacity, 1.0);
}

TEST_F(Edits, TakeAnyNameTheFileTakesAndNoOther) {
  const std::vector<ItemRef> items{{ItemKind::organ, "liver"}, {ItemKind::system, "light"}, {ItemKind::piece, "small"},
                                   {ItemKind::pose, "bent"},   {ItemKind::pose, "turned"},  {ItemKind::source, "left"}};
  const std::vector<std::string> names{
      "",     "new",       "body",          "miss", "armor",  "organs",      "heart", "front",        "plates",
      "rest", "unarmored", "belly_twist@1", "bent", "turned", "toe_touch@2", "ahead", "tab\t",        "toe_touch@3",
      "\xff", "\x7f",      "Milz \xc3\xa4", "@2",   "walk@",  "light",       "small", "toe_touch@2.0"};
  for (const ItemRef& item : items) {
    for (const std::string& name : names) {
      // What the reader says of the study with the name put in, blindly.
      study::Study blind = test::twoSystems();
      blind.runPoses.clear();
      for (study::Organ& organ : blind.organs) {
        organ.name = item.kind == ItemKind::organ && organ.name == item.name ? name : organ.name;
      }
      for (study::ArmorSystem& system : blind.systems) {
        system.name = item.kind == ItemKind::system && system.name == item.name ? name : system.name;
        for (study::ArmorPiece& piece : system.pieces) {
          piece.name = item.kind == ItemKind::piece && piece.name == item.name ? name : piece.name;
        }
      }
      for (study::Pose& pose : blind.poses) {
        pose.name = item.kind == ItemKind::pose && pose.name == item.name ? name : pose.name;
      }
      for (study::Source& source : blind.sources) {
        source.name = item.kind == ItemKind::source && source.name == item.name ? name : source.name;
      }
      bool reads = true;
      try {
        study::parseStudy(studyText(blind), "s");
      } catch (const base::InputError&) {
        reads = false;
      }
      EXPECT_EQ(renameTrouble(document_, item, name).isEmpty(), reads) << item.name << " to " << name;
      if (reads) {
        renameItem(document_, item, name);
        expectReadsBack();
        document_.undoStack().setIndex(0);
      } else {
        EXPECT_THROW(renameItem(document_, item, name), base::CallerError);
      }
    }
  }
}

TEST_F(Edits, ToTheNameItHasAreNoStep) {
  renameItem(document_, {ItemKind::organ, "liver"}, "liver");
  EXPECT_EQ(steps(), 0);
  EXPECT_EQ(study(), test::twoSystems());
}

TEST(CanRemove, HoldsForWhatTheUserAdded) {
  for (const ItemKind kind : {ItemKind::organ, ItemKind::system, ItemKind::piece, ItemKind::pose, ItemKind::source}) {
    EXPECT_TRUE(canRemove({kind, "any"}));
  }
  EXPECT_FALSE(canRemove({ItemKind::pose, "rest"}));
  for (const ItemKind kind : {ItemKind::study, ItemKind::body, ItemKind::region, ItemKind::run}) {
    EXPECT_FALSE(canRemove({kind, ""}));
  }
}

}  // namespace
}  // namespace lorica::commands
