#include "lorica/jobs/study_loader.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUndoStack>

#include "lorica/commands/edits.h"
#include "lorica/study/study_file.h"

namespace lorica::jobs {
namespace {

class Loader : public testing::Test {
 protected:
  void open() {
    document_.setStudy(study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json");
    settle();
  }
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return loader_.isInStep(); }, 30000));
  }

  document::StudyDocument document_;
  StudyLoader loader_{document_};
};

TEST_F(Loader, ReadsAStudyForAllFourModels) {
  open();
  ASSERT_NE(document_.loaded(), nullptr);
  EXPECT_EQ(document_.loaded()->study, document_.study());
  EXPECT_FALSE(document_.loaded()->body->thesisSites().empty());
}

TEST_F(Loader, AnEditBindsAgainOnlyWhatItChanged) {
  open();
  const auto before = document_.loaded();
  study::LatticeSettings finer;
  finer.cellMetres = 0.02;
  commands::setLattice(document_, "heart", finer);
  settle();
  const auto after = document_.loaded();
  EXPECT_EQ(after->body, before->body);
  for (std::size_t o = 0; o < after->organs.size(); ++o) {
    EXPECT_EQ(after->organs[o] == before->organs[o], after->organs[o]->name != "heart") << after->organs[o]->name;
  }
  EXPECT_EQ(after->pieces, before->pieces);
}

TEST_F(Loader, HowThingsAreDrawnLoadsNothing) {
  open();
  const auto before = document_.loaded();
  QSignalSpy started(&loader_, &StudyLoader::started);
  commands::setOpacity(document_, "heart", 0.3);
  QTest::qWait(100);
  EXPECT_EQ(started.count(), 0);
  EXPECT_EQ(document_.loaded(), before);
}

TEST_F(Loader, AStudyThatCannotBeReadKeepsWhatWasLoadedAndSaysWhy) {
  open();
  const auto before = document_.loaded();
  commands::setJoint(document_, "heart", "no_such_joint");
  settle();
  EXPECT_EQ(document_.loaded(), before);
  ASSERT_FALSE(document_.problems().empty());
  EXPECT_NE(document_.problems().front().text.find("no_such_joint"), std::string::npos);
  document_.undoStack().undo();
  settle();
  EXPECT_EQ(document_.loaded()->study, document_.study());
}

TEST_F(Loader, ReadingThatIsStoppedKeepsWhatWasLoadedAndSaysSo) {
  open();
  const auto before = document_.loaded();
  const QTemporaryDir cache;
  qputenv("LORICA_CACHE", cache.path().toUtf8());
  // Nobody made this one before: it takes long enough to be stopped.
  commands::setPerson(document_, {human::Sex::female, 1.6, 61.25});
  ASSERT_TRUE(QTest::qWaitFor([&] { return loader_.job() != nullptr; }, 5000));
  loader_.cancel();
  settle();
  EXPECT_EQ(document_.loaded(), before);
  ASSERT_EQ(document_.problems().size(), 1U);
  EXPECT_EQ(document_.problems().front().severity, base::Severity::error);
  document_.undoStack().undo();
  settle();
  EXPECT_EQ(document_.loaded()->study, document_.study());
  EXPECT_TRUE(document_.loaded()->body == before->body) << "nothing of it changed";
  qunsetenv("LORICA_CACHE");
}

TEST_F(Loader, AnotherStudyMayComeWhileOneIsRead) {
  document_.setStudy(study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json");
  ASSERT_TRUE(QTest::qWaitFor([&] { return loader_.job() != nullptr; }, 5000));
  document_.setStudy(study::parseStudy(study::templateText("minimal"), "minimal"), "minimal.lorica.json");
  settle();
  ASSERT_NE(document_.loaded(), nullptr);
  EXPECT_EQ(document_.loaded()->study, document_.study());
}

}  // namespace
}  // namespace lorica::jobs
