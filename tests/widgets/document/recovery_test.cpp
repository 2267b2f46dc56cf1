#include "lorica/document/recovery.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUndoStack>

#include "lorica/base/files.h"
#include "lorica/commands/edits.h"
#include "lorica/study/study_file.h"

namespace lorica::document {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using commands::setTrials;

study::Study sample() {
  return study::parseStudy(study::templateText("sample"), "sample");
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    files.push_back(entry.path());
  }
  return files;
}

class Recovery : public ::testing::Test {
 protected:
  fs::path home() const { return fs::path(home_.path().toStdString()); }
  fs::path folder() const { return home() / "recovery"; }
  fs::path studyFile() const { return home() / "studies" / "a.lorica.json"; }
  /// A document of a saved study, without edits.
  void openSample(StudyDocument& document) const {
    study::saveStudy(sample(), studyFile());
    document.open(studyFile());
  }
  bool somethingIsWritten() const { return !filesIn(folder()).empty(); }

  QTemporaryDir home_;
};

TEST_F(Recovery, FileIsWrittenWithinTheDelayHoweverFastOneEdits) {
  StudyDocument document;
  openSample(document);
  Autosave autosave(document, folder());
  autosave.setDelay(200ms);
  QTest::qWait(300);
  EXPECT_FALSE(somethingIsWritten()) << "there is nothing to lose";

  QElapsedTimer clock;
  clock.start();
  std::uint32_t trials = 10;
  while (!somethingIsWritten() && clock.elapsed() < 5000) {
    setTrials(document, ++trials);
    QTest::qWait(20);
  }
  EXPECT_TRUE(somethingIsWritten());
  EXPECT_GE(clock.elapsed(), 150);
  EXPECT_LT(clock.elapsed(), 2500);
}

TEST_F(Recovery, FileGoesWhenTheStudyIsSavedUndoneOrClosed) {
  StudyDocument document;
  openSample(document);
  Autosave autosave(document, folder());
  const auto edit = [&] {
    setTrials(document, document.study().trials + 1);
    autosave.writeNow();
    EXPECT_TRUE(somethingIsWritten());
  };
  edit();
  document.save();
  EXPECT_FALSE(somethingIsWritten());
  edit();
  document.undoStack().undo();
  EXPECT_FALSE(somethingIsWritten());
  edit();
  document.saveAs(home() / "b.lorica.json");
  EXPECT_FALSE(somethingIsWritten());
  edit();
  document.open(studyFile());
  EXPECT_FALSE(somethingIsWritten());
  edit();
  document.close();
  EXPECT_FALSE(somethingIsWritten());
  autosave.writeNow();
  EXPECT_FALSE(somethingIsWritten());
}

TEST_F(Recovery, FileGoesWithItsWindow) {
  StudyDocument document;
  document.setStudy(sample(), studyFile());
  {
    Autosave autosave(document, folder());
    autosave.writeNow();
    EXPECT_TRUE(somethingIsWritten());
  }
  EXPECT_FALSE(somethingIsWritten());
}

TEST_F(Recovery, OffersNothingOfAWindowThatLives) {
  StudyDocument document;
  document.setStudy(sample(), studyFile());
  Autosave autosave(document, folder());
  autosave.writeNow();
  EXPECT_TRUE(findRecovered(folder()).empty());
  for (const fs::path& file : filesIn(folder())) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - 48h);
  }
  EXPECT_TRUE(findRecovered(folder()).empty()) << "however long it has been open";
  EXPECT_TRUE(somethingIsWritten());
  document.saveAs(studyFile());
  EXPECT_FALSE(somethingIsWritten());
}

TEST_F(Recovery, FindsNothingInAFolderThatIsAbsentOrHoldsOtherThings) {
  EXPECT_TRUE(findRecovered(folder()).empty());
  EXPECT_FALSE(fs::exists(folder()));
  base::writeFileAtomically(folder() / "empty.lorica-recovery", "");
  base::writeFileAtomically(folder() / "list.lorica-recovery", "[1, 2]");
  base::writeFileAtomically(folder() / "broken.lorica-recovery",
                            R"({"format": "lorica-recovery-1", "saved_at": "2020-01-01T00:00:00Z", "study": "{"})");
  base::writeFileAtomically(folder() / "later.lorica-recovery",
                            R"({"format": "lorica-recovery-2", "saved_at": "2020-01-01T00:00:00Z"})");
  base::writeFileAtomically(folder() / "note.txt", "hello");
  EXPECT_TRUE(findRecovered(folder()).empty());
  EXPECT_EQ(filesIn(folder()).size(), 5U) << "what is not understood is left alone";
}

TEST_F(Recovery, SaysOnceThatItCannotWriteAndGoesOnTrying) {
  base::writeFileAtomically(folder(), "a file where the folder should be");
  StudyDocument document;
  openSample(document);
  Autosave autosave(document, folder());
  autosave.setDelay(20ms);
  QSignalSpy failed(&autosave, &Autosave::failed);
  setTrials(document, 9);
  ASSERT_TRUE(QTest::qWaitFor([&] { return failed.count() > 0; }));
  setTrials(document, 10);
  QTest::qWait(150);
  EXPECT_EQ(failed.count(), 1);

  fs::remove(folder());
  ASSERT_TRUE(QTest::qWaitFor([&] { return somethingIsWritten(); })) << "without another edit";
  document.save();
  fs::remove_all(folder());
  base::writeFileAtomically(folder(), "again");
  setTrials(document, 11);
  ASSERT_TRUE(QTest::qWaitFor([&] { return failed.count() > 1; }));
  EXPECT_EQ(failed.count(), 2);
}

/// A window in a program of its own, for the test below: edits, saves for recovery, and waits for its end.
TEST(DISABLED_Window, ThatIsKilled) {
  const fs::path home = qEnvironmentVariable("LORICA_TEST_HOME").toStdString();
  ASSERT_FALSE(home.empty());
  StudyDocument document;
  document.open(home / "studies" / "a.lorica.json");
  Autosave autosave(document, home / "recovery");
  autosave.setDelay(10ms);
  setTrials(document, 77);
  if (qEnvironmentVariableIsSet("LORICA_TEST_ELSEWHERE")) {
    document.saveAs(home / "b.lorica.json");
    setTrials(document, 78);
  }
  QTest::qWait(60000);
}

class KilledWindow : public Recovery {
 protected:
  void SetUp() override {
    study::Study study = sample();
    study.organs[0].mesh.from = study::InputFile{"heart.stl", "", {}, {}};
    study::saveStudy(study, studyFile());
  }

  /// Starts a window and waits until its edit is written.
  void start(bool savedElsewhere) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("LORICA_TEST_HOME", home_.path());
    if (savedElsewhere) {
      environment.insert("LORICA_TEST_ELSEWHERE", "1");
    }
    window_.setProcessEnvironment(environment);
    window_.setStandardOutputFile(QProcess::nullDevice());
    window_.start(QCoreApplication::applicationFilePath(),
                  {"--gtest_filter=DISABLED_Window.ThatIsKilled", "--gtest_also_run_disabled_tests"});
    ASSERT_TRUE(window_.waitForStarted());
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          const std::vector<fs::path> files = filesIn(folder());
          return std::any_of(files.begin(), files.end(),
                             [](const fs::path& file) { return file.extension() == ".lorica-recovery"; });
        },
        30000));
  }
  void kill() {
    ASSERT_EQ(::kill(static_cast<pid_t>(window_.processId()), SIGKILL), 0);
    ASSERT_TRUE(window_.waitForFinished());
  }

  QProcess window_;
};

TEST_F(KilledWindow, LeavesItsEditToBeRestored) {
  start(false);
  EXPECT_TRUE(findRecovered(folder()).empty()) << "it lives";
  kill();
  std::vector<Recovered> found = findRecovered(folder());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].file, studyFile());
  EXPECT_TRUE(found[0].hadFile);
  EXPECT_FALSE(found[0].when.empty());
  EXPECT_TRUE(findRecovered(folder()).empty()) << "it is claimed";

  StudyDocument document;
  Autosave autosave(document, folder());
  document.restore(found[0].study, found[0].file, found[0].hadFile);
  EXPECT_EQ(document.study().trials, 77U);
  EXPECT_TRUE(document.isModified());
  autosave.writeNow();
  discardRecovered(found[0]);
  document.save();
  EXPECT_EQ(study::loadStudy(studyFile()).trials, 77U);
  EXPECT_FALSE(somethingIsWritten());
}

TEST_F(KilledWindow, IsOfferedAgainWhenItWasNotTaken) {
  start(false);
  kill();
  EXPECT_EQ(findRecovered(folder()).size(), 1U);
  EXPECT_EQ(findRecovered(folder()).size(), 1U);
}

TEST_F(KilledWindow, ThatSavedElsewhereFindsItsInputs) {
  start(true);
  kill();
  const std::vector<Recovered> found = findRecovered(folder());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].file, home() / "b.lorica.json");
  EXPECT_EQ(found[0].study.trials, 78U);
  const study::InputFile input = study::inputFiles(found[0].study).front();
  EXPECT_EQ(study::resolve(input, found[0].file), home() / "studies" / "heart.stl");
}

TEST_F(Recovery, OffersTheNewestFirst) {
  const auto put = [&](const char* name, const char* when) {
    QJsonObject root;
    root["format"] = "lorica-recovery-1";
    root["file"] = "/a.json";
    root["saved_at"] = when;
    root["study"] = QString::fromStdString(study::studyText(sample()));
    base::writeFileAtomically(folder() / name, QJsonDocument(root).toJson().toStdString());
  };
  put("b.lorica-recovery", "2021-01-01T00:00:00.500Z");
  put("a.lorica-recovery", "2021-01-01T00:00:00.250Z");
  put("c.lorica-recovery", "2022-01-01T00:00:00Z");
  std::vector<std::string> names;
  for (const Recovered& recovered : findRecovered(folder())) {
    names.push_back(recovered.recoveryFile.stem().string());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"c", "b", "a"}));
}

}  // namespace
}  // namespace lorica::document
