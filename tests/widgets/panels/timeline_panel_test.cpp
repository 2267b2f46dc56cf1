#include "lorica/panels/timeline_panel.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>
#include <QVBoxLayout>
#include <cmath>
#include <random>

#include "lorica/commands/edits.h"
#include "lorica/panels/property_form.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

/// The sample with its timeline.
class Timeline : public testing::Test {
 protected:
  Timeline() : panel_(document_) {
    testsupport::openLoadedSample(document_);
    panel_.resize(900, 80);
    panel_.show();
  }

  template <class Widget>
  Widget* part(const char* name) const {
    auto* found = panel_.findChild<Widget*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  double clipLength(const std::string& name) const {
    for (const human::Clip& clip : document_.loaded()->clips) {
      if (clip.name == name) {
        return clip.duration();
      }
    }
    ADD_FAILURE() << "no clip " << name;
    return 0.0;
  }
  double shownSeconds() const {
    const auto moment = study::clipPoseNamed(document_.shownPose());
    EXPECT_TRUE(moment.has_value()) << document_.shownPose();
    return moment ? moment->seconds : -1.0;
  }
  void choose(const QString& id) const {
    auto* poses = part<QComboBox>("pose");
    const int index = poses->findData(id);
    ASSERT_GE(index, 0) << id.toStdString();
    poses->setCurrentIndex(index);
    Q_EMIT poses->activated(index);
  }
  void play(bool loop, double speed) const {
    part<QToolButton>("loop")->setChecked(loop);
    auto* speeds = part<QComboBox>("speed");
    speeds->setCurrentIndex(speeds->findData(speed));
    panel_.playAction()->trigger();
  }

  document::StudyDocument document_;
  TimelinePanel panel_;
};

TEST(ClipFrames, TimesOfFramesComeBackAsTheFrames) {
  for (const double duration : {4.0, 3.99, 4.0000001, 1.0 / 30.0, 0.01, 0.1, 7.0 / 3.0, 100.0}) {
    const ClipFrames frames(duration);
    ASSERT_GT(frames.last(), 0);
    EXPECT_EQ(frames.seconds(0), 0.0);
    EXPECT_EQ(frames.seconds(frames.last()), duration) << "the last frame is the very end";
    for (int frame = 0; frame <= frames.last(); ++frame) {
      EXPECT_EQ(frames.frameAt(frames.seconds(frame)), frame) << duration;
      if (frame > 0) {
        EXPECT_LT(frames.seconds(frame - 1), frames.seconds(frame)) << duration;
        EXPECT_LE(frames.seconds(frame) - frames.seconds(frame - 1), 1.0 / 30.0 + 1e-6) << duration;
        EXPECT_EQ(frames.frameAt(std::nextafter(frames.seconds(frame), 0.0)), frame - 1) << duration;
      }
    }
  }
  EXPECT_EQ(ClipFrames(0.0).last(), 0);
  EXPECT_EQ(ClipFrames(0.0).seconds(0), 0.0);
}

TEST(ClipPoseText, ReadsBackAsTheSameTime) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> times(0.0, 60.0);
  for (int n = 0; n < 2000; ++n) {
    const double seconds = n == 0 ? 0.0 : times(random) * std::pow(10.0, -(n % 7));
    const std::string text = clipPoseText("run@fast", seconds);
    const auto back = study::clipPoseNamed(text);
    ASSERT_TRUE(back) << text;
    EXPECT_EQ(back->clip, "run@fast");
    EXPECT_EQ(back->seconds, seconds) << text;
  }
  EXPECT_EQ(clipPoseText("walk", 2.0), "walk@2") << "as a person writes it";
}

TEST(TimelinePanel, SaysWhatToDoWithoutAStudy) {
  document::StudyDocument document;
  TimelinePanel panel(document);
  EXPECT_FALSE(panel.findChild<QSlider*>()->isVisibleTo(&panel));
  testsupport::openSample(document);
  EXPECT_TRUE(panel.findChild<QSlider*>()->isVisibleTo(&panel));
  EXPECT_FALSE(panel.findChild<QSlider*>()->isEnabled()) << "the body is not read yet";
  EXPECT_FALSE(panel.playAction()->isEnabled());
}

TEST(TimelinePanel, ABodyWithoutASkeletonIsShownAtRestOnly) {
  document::StudyDocument document;
  TimelinePanel panel(document);
  testsupport::openSample(document);
  auto stiff = std::make_shared<analysis::LoadedStudy>(*testsupport::loadedSample());
  parenting::Body body = stiff->body->body();
  body.skeleton.reset();
  body.weights.reset();
  stiff->body =
      std::make_shared<const parenting::BodyRig>(std::move(body), parenting::RigOptions{0.2, false}, base::Threads{});
  stiff->clips.clear();
  document.setLoaded(stiff);
  EXPECT_FALSE(panel.findChild<QComboBox*>("pose")->isEnabled());
  EXPECT_FALSE(panel.playAction()->isEnabled());
  EXPECT_TRUE(panel.findChild<ElidedLabel*>("where")->text().contains("no skeleton"));
}

TEST_F(Timeline, SliderShowsEveryFrameOfTheClip) {
  choose("clip:toe_touch");
  EXPECT_EQ(document_.shownPose(), "toe_touch@0");
  auto* slider = part<QSlider>("frame");
  const ClipFrames frames(clipLength("toe_touch"));
  EXPECT_EQ(slider->maximum(), frames.last());
  for (const int frame : {1, 42, frames.last() - 1, frames.last()}) {
    slider->setValue(frame);
    EXPECT_EQ(shownSeconds(), frames.seconds(frame));
    EXPECT_EQ(slider->value(), frame) << "showing it does not move it";
    EXPECT_NO_THROW(analysis::resolvePose(*document_.loaded(), document_.shownPose()));
  }
}

TEST_F(Timeline, ATimeBetweenFramesStaysAsItIs) {
  document_.showPose("toe_touch@1.41234567");
  EXPECT_EQ(document_.shownPose(), "toe_touch@1.41234567");
  EXPECT_TRUE(part<ElidedLabel>("where")->text().contains("between frames 42 and 43"));
  auto* time = part<QDoubleSpinBox>("time");
  time->interpretText();
  EXPECT_EQ(document_.shownPose(), "toe_touch@1.41234567") << "what is displayed rounds, what is shown does not";
  panel_.stepBackAction()->trigger();
  EXPECT_EQ(shownSeconds(), 42.0 / 30.0);
  document_.showPose("toe_touch@1.41234567");
  panel_.stepForwardAction()->trigger();
  EXPECT_EQ(shownSeconds(), 43.0 / 30.0);
}

TEST_F(Timeline, StepsStopAtBothEnds) {
  choose("clip:toe_touch");
  panel_.stepBackAction()->trigger();
  EXPECT_EQ(shownSeconds(), 0.0);
  part<QSlider>("frame")->setValue(part<QSlider>("frame")->maximum());
  panel_.stepForwardAction()->trigger();
  EXPECT_EQ(shownSeconds(), clipLength("toe_touch"));
}

TEST_F(Timeline, ATypedTimeIsShownAndNeverBeyondTheClip) {
  choose("clip:belly_twist");
  auto* time = part<QDoubleSpinBox>("time");
  time->setValue(1.234);
  EXPECT_EQ(document_.shownPose(), "belly_twist@1.234");
  time->setValue(1e9);
  EXPECT_EQ(shownSeconds(), clipLength("belly_twist"));
}

TEST_F(Timeline, FollowsWhatOthersShow) {
  document_.showPose("toe_touch@2");
  EXPECT_EQ(part<QComboBox>("pose")->currentData().toString(), "pose:toe_touch@2");
  EXPECT_EQ(part<QSlider>("frame")->value(), 60);
  document_.showPose("belly_twist@0.5");
  EXPECT_EQ(part<QComboBox>("pose")->currentData().toString(), "clip:belly_twist");
  document_.showPose("rest");
  EXPECT_EQ(part<QComboBox>("pose")->currentData().toString(), "pose:rest");
  EXPECT_FALSE(part<QSlider>("frame")->isEnabled());
}

TEST_F(Timeline, PlayingStopsAtTheVeryEndWithoutLoop) {
  choose("clip:toe_touch");
  document_.showPose(clipPoseText("toe_touch", clipLength("toe_touch") - 0.3));
  QSignalSpy shown(&document_, &document::StudyDocument::shownPoseChanged);
  play(false, 1.0);
  EXPECT_TRUE(panel_.isPlaying());
  ASSERT_TRUE(QTest::qWaitFor([this] { return !panel_.isPlaying(); }, 5000));
  EXPECT_EQ(shownSeconds(), clipLength("toe_touch"));
  EXPECT_GE(shown.count(), 1);
  EXPECT_LE(shown.count(), 11) << "0.3 s have no more frames";
}

TEST_F(Timeline, PlayingStartsAgainWithLoop) {
  choose("clip:toe_touch");
  const double length = clipLength("toe_touch");
  document_.showPose(clipPoseText("toe_touch", length - 0.1));
  play(true, 2.0);
  ASSERT_TRUE(QTest::qWaitFor([this] { return shownSeconds() < 1.0; }, 5000));
  EXPECT_TRUE(panel_.isPlaying());
  panel_.playAction()->trigger();
  EXPECT_FALSE(panel_.isPlaying());
}

TEST_F(Timeline, PlayingAtTheEndStartsFromTheBeginning) {
  choose("clip:toe_touch");
  document_.showPose(clipPoseText("toe_touch", clipLength("toe_touch")));
  play(false, 0.25);
  EXPECT_EQ(shownSeconds(), 0.0);
  EXPECT_TRUE(panel_.isPlaying());
}

TEST_F(Timeline, PlayingLeavesFramesOutWhileTheEngineIsBusy) {
  choose("clip:toe_touch");
  bool busy = true;
  panel_.setBusyCheck([&busy] { return busy; });
  QSignalSpy shown(&document_, &document::StudyDocument::shownPoseChanged);
  play(true, 1.0);
  QTest::qWait(300);
  EXPECT_EQ(shown.count(), 0);
  busy = false;
  ASSERT_TRUE(QTest::qWaitFor([&shown] { return shown.count() > 0; }, 5000));
  EXPECT_GE(shownSeconds(), 0.25) << "time went on meanwhile";
}

TEST_F(Timeline, PlayingGoesOnFromWhereSomebodyElsePutIt) {
  choose("clip:toe_touch");
  play(false, 0.25);
  QTest::qWait(100);
  document_.showPose("toe_touch@3");
  QTest::qWait(200);
  EXPECT_GE(shownSeconds(), 3.0 - 1.0 / 30.0);
  document_.showPose("rest");
  EXPECT_FALSE(panel_.isPlaying());
}

TEST_F(Timeline, AKeptPoseIsOneOfTheStudyAndResolves) {
  choose("clip:toe_touch");
  part<QSlider>("frame")->setValue(43);
  auto* keep = part<QToolButton>("keep");
  ASSERT_TRUE(keep->isEnabled());
  const std::size_t before = document_.study().poses.size();
  keep->click();
  ASSERT_EQ(document_.study().poses.size(), before + 1);
  const study::Pose& kept = document_.study().poses.back();
  EXPECT_EQ(kept.name, document_.shownPose());
  EXPECT_EQ(std::get<study::ClipPose>(kept.what).seconds, 43.0 / 30.0);
  analysis::LoadedStudy loaded = *document_.loaded();
  loaded.study = document_.study();
  EXPECT_TRUE(analysis::resolvePose(loaded, kept.name).pose.has_value());
  EXPECT_FALSE(keep->isEnabled()) << "it is there";
  document_.undoStack().undo();
  EXPECT_EQ(document_.study().poses.size(), before);
  EXPECT_TRUE(keep->isEnabled());
}

TEST_F(Timeline, AMomentTheStudyHasCannotBeKeptTwice) {
  choose("clip:toe_touch");
  part<QSlider>("frame")->setValue(60);
  EXPECT_EQ(document_.shownPose(), "toe_touch@2");
  EXPECT_FALSE(part<QToolButton>("keep")->isEnabled());
  EXPECT_EQ(part<QComboBox>("pose")->currentData().toString(), "clip:toe_touch") << "the choice does not jump";
}

TEST_F(Timeline, SpacePlaysButNotWhileSomethingIsTyped) {
  QWidget window;
  QVBoxLayout layout(&window);
  QLineEdit edit;
  QWidget view;
  view.setFocusPolicy(Qt::StrongFocus);
  layout.addWidget(&edit);
  layout.addWidget(&view);
  layout.addWidget(&panel_);
  window.show();
  window.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  choose("clip:toe_touch");
  edit.setFocus();
  QTest::keyClicks(&edit, "a b");
  EXPECT_EQ(edit.text(), "a b");
  EXPECT_FALSE(panel_.isPlaying());
  QTest::keyClick(&edit, Qt::Key_Left);
  EXPECT_EQ(edit.cursorPosition(), 2);
  view.setFocus();
  QTest::keyClick(&view, Qt::Key_Right);
  EXPECT_EQ(shownSeconds(), 1.0 / 30.0);
  QTest::keyClick(&view, Qt::Key_Space);
  EXPECT_TRUE(panel_.isPlaying());
  layout.removeWidget(&panel_);
  panel_.setParent(nullptr);
}

}  // namespace
}  // namespace lorica::panels
