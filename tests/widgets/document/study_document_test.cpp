#include "lorica/document/study_document.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QUndoStack>

#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/commands/edits.h"
#include "lorica/study/study_file.h"

namespace lorica::document {
namespace {

namespace fs = std::filesystem;
using commands::setTrials;

study::Study sample() {
  return study::parseStudy(study::templateText("sample"), "sample");
}

/// A study that reads files beside and above it, and an absolute one.
study::Study withFiles() {
  study::Study study = sample();
  study.organs.resize(3);
  const std::vector<std::string> paths{"heart.stl", "../meshes/liver.stl", "/models/lung.stl"};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    study.organs[i].mesh.from = study::InputFile{paths[i], "", {}, {}};
  }
  return study;
}

std::vector<fs::path> resolved(const study::Study& study, const fs::path& file) {
  std::vector<fs::path> paths;
  for (const study::InputFile& input : study::inputFiles(study)) {
    paths.push_back(study::resolve(input, file));
  }
  return paths;
}

class Document : public ::testing::Test {
 protected:
  fs::path folder() const { return fs::path(folder_.path().toStdString()); }
  fs::path put(const std::string& name, const study::Study& study) const {
    study::saveStudy(study, folder() / name);
    return folder() / name;
  }
  QString title() const { return document_.displayName(); }

  QTemporaryDir folder_;
  StudyDocument document_;
};

TEST_F(Document, IsEmptyBeforeAnythingIsOpened) {
  EXPECT_FALSE(document_.hasStudy());
  EXPECT_FALSE(document_.hasFile());
  EXPECT_FALSE(document_.isModified());
  EXPECT_TRUE(title().isEmpty());
  EXPECT_FALSE(exists(document_, {ItemKind::study, ""}));
  EXPECT_FALSE(exists(document_, {ItemKind::pose, "rest"}));
  EXPECT_THROW(document_.saveAs(folder() / "a.lorica.json"), base::CallerError);
}

TEST_F(Document, OpensWhatWasSavedAsItWas) {
  document_.setStudy(withFiles(), folder() / "a.lorica.json");
  setTrials(document_, 9);
  const study::Study saved = document_.study();
  document_.saveAs(folder() / "a.lorica.json");
  EXPECT_EQ(base::readFile(folder() / "a.lorica.json"), study::studyText(saved));
  StudyDocument other;
  other.open(folder() / "a.lorica.json");
  EXPECT_EQ(other.study(), saved);
  EXPECT_EQ(other.file(), folder() / "a.lorica.json");
  EXPECT_EQ(other.savedFile(), other.file());
  EXPECT_FALSE(other.isModified());
}

TEST_F(Document, SavedToAnotherFolderReadsTheSameFilesAndCanStillBeUndone) {
  document_.open(put("studies/a.lorica.json", withFiles()));
  const std::vector<fs::path> files = resolved(document_.study(), document_.file());
  const study::Study opened = document_.study();
  commands::removeItem(document_, {ItemKind::organ, document_.study().organs[1].name});
  setTrials(document_, 9);

  const fs::path elsewhere = folder() / "else" / "where" / "b.lorica.json";
  document_.saveAs(elsewhere);
  EXPECT_EQ(document_.savedFile(), elsewhere);
  EXPECT_FALSE(document_.isModified());
  const auto expectSame = [&](const std::vector<fs::path>& expected) {
    document_.save();
    EXPECT_EQ(resolved(document_.study(), document_.file()), expected);
    EXPECT_EQ(resolved(study::loadStudy(elsewhere), elsewhere), expected);
  };
  expectSame({files[0], files[2]});
  document_.undoStack().undo();
  document_.undoStack().undo();
  EXPECT_EQ(document_.study(), opened);
  expectSame(files);
  document_.undoStack().redo();
  expectSame({files[0], files[2]});
  document_.saveAs(folder() / "studies" / "a.lorica.json");
  EXPECT_EQ(base::readFile(folder() / "studies" / "a.lorica.json"), study::studyText(document_.study()));
}

TEST_F(Document, StaysAsItWasWhenAFileIsDamagedOrMissing) {
  document_.open(put("a.lorica.json", sample()));
  setTrials(document_, 9);
  document_.select(ItemRef{ItemKind::organ, "heart"});
  const study::Study before = document_.study();
  base::writeFileAtomically(folder() / "damaged.json", "{\"lorica_study\": 1, \"human\": ");
  QSignalSpy replaced(&document_, &StudyDocument::replaced);
  for (const char* name : {"damaged.json", "missing.json", "."}) {
    EXPECT_THROW(document_.open(folder() / name), base::InputError) << name;
    EXPECT_EQ(document_.study(), before);
    EXPECT_EQ(document_.savedFile(), folder() / "a.lorica.json");
    EXPECT_TRUE(document_.isModified());
    EXPECT_TRUE(document_.undoStack().canUndo());
    EXPECT_EQ(document_.selection(), (ItemRef{ItemKind::organ, "heart"}));
  }
  EXPECT_EQ(replaced.count(), 0);
}

TEST_F(Document, StaysModifiedWhenItCannotBeSaved) {
  document_.open(put("a.lorica.json", sample()));
  setTrials(document_, 9);
  fs::create_directory(folder() / "folder.json");
  EXPECT_THROW(document_.saveAs(folder() / "folder.json"), base::InputError);
  EXPECT_TRUE(document_.isModified());
  EXPECT_EQ(document_.savedFile(), folder() / "a.lorica.json");
}

TEST_F(Document, IsModifiedBetweenAnEditAndItsUndoOrSave) {
  document_.open(put("a.lorica.json", sample()));
  EXPECT_FALSE(document_.isModified());
  QSignalSpy told(&document_, &StudyDocument::fileChanged);
  setTrials(document_, 9);
  EXPECT_TRUE(document_.isModified());
  EXPECT_EQ(told.count(), 1);
  document_.undoStack().undo();
  EXPECT_FALSE(document_.isModified());
  document_.undoStack().redo();
  EXPECT_TRUE(document_.isModified());
  document_.save();
  EXPECT_FALSE(document_.isModified());
  EXPECT_EQ(told.count(), 4);
  document_.undoStack().undo();
  EXPECT_TRUE(document_.isModified()) << "the file has the edit";
}

TEST_F(Document, IsModifiedByADragThatBeginsWhereItWasSaved) {
  document_.open(put("a.lorica.json", sample()));
  commands::setOpacity(document_, "body", 0.5);
  document_.save();
  commands::setOpacity(document_, "body", 0.75);
  EXPECT_TRUE(document_.isModified());
  document_.undoStack().undo();
  EXPECT_FALSE(document_.isModified());
  EXPECT_EQ(study::loadStudy(document_.savedFile()), document_.study());
}

TEST_F(Document, OfANewStudyIsModifiedUntilItIsSaved) {
  document_.setStudy(sample(), folder() / "suggested.lorica.json");
  EXPECT_TRUE(document_.isModified());
  EXPECT_FALSE(document_.hasFile());
  EXPECT_EQ(document_.file(), folder() / "suggested.lorica.json");
  EXPECT_THROW(document_.save(), base::CallerError);
  QSignalSpy told(&document_, &StudyDocument::fileChanged);
  document_.saveAs(folder() / "a.lorica.json");
  EXPECT_FALSE(document_.isModified());
  EXPECT_EQ(told.count(), 1);
}

TEST_F(Document, RestoredAfterACrashIsModifiedAndKnowsItsFile) {
  document_.restore(sample(), folder() / "gone.lorica.json", true);
  EXPECT_TRUE(document_.isModified());
  EXPECT_TRUE(document_.hasFile());
  document_.save();
  EXPECT_FALSE(document_.isModified());
  EXPECT_EQ(study::loadStudy(folder() / "gone.lorica.json"), sample());
  document_.restore(sample(), folder() / "suggested.lorica.json", false);
  EXPECT_FALSE(document_.hasFile());
}

TEST_F(Document, IsTitledByItsFileOrItsStudy) {
  document_.setStudy(sample(), "a.lorica.json");
  EXPECT_EQ(title(), "sample");
  commands::setStudyName(document_, "");
  EXPECT_EQ(title(), "untitled");
  document_.saveAs(folder() / "b.lorica.json");
  EXPECT_EQ(title(), "b.lorica.json");
  document_.close();
  EXPECT_TRUE(title().isEmpty());
}

TEST_F(Document, OfARelativeFileStaysWhereItIsWhenTheProgramGoesElsewhere) {
  const fs::path before = fs::current_path();
  put("a.lorica.json", sample());
  fs::current_path(folder());
  document_.open("a.lorica.json");
  fs::current_path(before);
  setTrials(document_, 9);
  document_.save();
  EXPECT_EQ(study::loadStudy(folder() / "a.lorica.json").trials, 9U);
}

TEST_F(Document, ForgetsEverythingOfTheStudyBefore) {
  document_.open(put("a.lorica.json", sample()));
  setTrials(document_, 9);
  document_.select(ItemRef{ItemKind::pose, "toe_touch@2"});
  document_.showPose("toe_touch@2");
  document_.showModels({viscera::OrganModel::staticJoint, viscera::OrganModel::dynamic});
  document_.setProblems({{base::Severity::warning, "", "", "odd"}});
  bool told = false;
  QObject::connect(&document_, &StudyDocument::replaced, [&] {
    told = true;
    EXPECT_EQ(document_.selection(), std::nullopt);
    EXPECT_EQ(document_.shownPose(), "rest");
    EXPECT_TRUE(document_.problems().empty());
    EXPECT_EQ(document_.undoStack().count(), 0);
  });
  document_.close();
  EXPECT_TRUE(told);
  EXPECT_EQ(document_.shownModels().size(), 1U);
  EXPECT_FALSE(document_.hasStudy());
  EXPECT_FALSE(document_.isModified());
  EXPECT_TRUE(document_.savedFile().empty());
}

TEST_F(Document, SelectsOnlyWhatExists) {
  document_.setStudy(sample(), "a.lorica.json");
  QSignalSpy told(&document_, &StudyDocument::selectionChanged);
  for (const ItemRef& item : std::vector<ItemRef>{{ItemKind::study, ""},
                                                  {ItemKind::body, ""},
                                                  {ItemKind::organ, "heart"},
                                                  {ItemKind::system, "full_torso"},
                                                  {ItemKind::piece, "carrier_plate_front"},
                                                  {ItemKind::pose, "rest"},
                                                  {ItemKind::pose, "toe_touch@2"},
                                                  {ItemKind::source, "front"}}) {
    document_.select(item);
    EXPECT_EQ(document_.selection(), item);
    ItemRef absent = item;
    absent.name += "absent";
    EXPECT_FALSE(exists(document_, absent));
  }
  EXPECT_EQ(told.count(), 8);
  document_.select(document_.selection());
  EXPECT_EQ(told.count(), 8);
  document_.select(ItemRef{ItemKind::organ, "absent"});
  EXPECT_EQ(document_.selection(), std::nullopt);
}

TEST_F(Document, ShowsPosesAndModelsThatThereAre) {
  document_.setStudy(sample(), "a.lorica.json");
  QSignalSpy told(&document_, &StudyDocument::shownPoseChanged);
  document_.showPose("toe_touch@0.25");
  document_.showPose("toe_touch@0.25");
  EXPECT_EQ(told.count(), 1);
  EXPECT_THROW(document_.showPose("absent"), base::CallerError);
  using viscera::OrganModel;
  EXPECT_THROW(document_.showModels({}), base::CallerError);
  EXPECT_THROW(document_.showModels({OrganModel::dynamic, OrganModel::dynamic}), base::CallerError);
}

TEST_F(Document, NumbersItsRunsAndKnowsTheRegionsOfALoadedBody) {
  study::Study small = sample();
  small.organs.resize(1);
  small.poses.clear();
  small.trials = 1;
  small.sources[0].shots = 100;
  auto loaded = std::make_shared<const analysis::LoadedStudy>(analysis::load(small, "sample.lorica.json", {}));
  document_.setStudy(small, "sample.lorica.json");
  const ItemRef region{ItemKind::region, loaded->body->body().regions.names.front()};
  EXPECT_FALSE(exists(document_, region));
  document_.setLoaded(loaded);
  EXPECT_TRUE(exists(document_, region));
  QSignalSpy told(&document_, &StudyDocument::runsChanged);
  for (int i = 0; i < 2; ++i) {
    document_.addRun(loaded, analysis::run(*loaded, {}));
  }
  EXPECT_EQ(told.count(), 2);
  ASSERT_EQ(document_.runs().size(), 2U);
  EXPECT_EQ(document_.runs()[1]->name, "Run 2");
  EXPECT_FALSE(document_.runs()[1]->summary.empty());
  EXPECT_TRUE(exists(document_, {ItemKind::run, "Run 2"}));
  document_.select(region);
  document_.setLoaded(nullptr);
  EXPECT_EQ(document_.selection(), std::nullopt);
}

}  // namespace
}  // namespace lorica::document
