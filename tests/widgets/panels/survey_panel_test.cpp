#include "lorica/panels/survey_panel.h"

#include <gtest/gtest.h>

#include <QChart>
#include <QChartView>
#include <QComboBox>
#include <QLineSeries>
#include <QPushButton>
#include <QTest>
#include <cmath>

#include "lorica/analysis/directions.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

/// A run of the sample whose study asks for few directions and few frames.
std::shared_ptr<const document::RunRecord> record(bool asks) {
  auto study = std::make_shared<analysis::LoadedStudy>(*testsupport::loadedSample());
  study->study.trials = 2;
  study->study.sources[0].shots = 500;
  if (asks) {
    study->study.analyses.directions = study::DirectionGrid{60.0, 800};
    study->study.analyses.motion = study::MotionSettings{"toe_touch", 15, 10.0};
  }
  auto made = std::make_shared<document::RunRecord>();
  made->name = "Run 1";
  analysis::RunOptions options;
  options.poses = {"rest"};
  made->result = analysis::planRun(*study, options);
  made->study = std::move(study);
  return made;
}

class Survey : public testing::Test {
 protected:
  Survey() {
    panel_.resize(900, 400);
    panel_.show();
  }
  void compute() {
    panel_.setRun(run_);
    panel_.compute();
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel_.survey() != nullptr && !panel_.isBusy(); }, 60000));
  }
  void choose(const char* name, const QVariant& value) const {
    auto* combo = panel_.findChild<QComboBox*>(QString::fromLatin1(name));
    ASSERT_NE(combo, nullptr);
    ASSERT_GE(combo->findData(value), 0) << name;
    combo->setCurrentIndex(combo->findData(value));
  }

  std::shared_ptr<const document::RunRecord> run_ = record(true);
  SurveyPanel panel_;
};

TEST_F(Survey, ARunThatAsksForNothingSaysSo) {
  panel_.setRun(record(false));
  EXPECT_FALSE(panel_.findChild<QPushButton*>("survey_compute")->isVisible());
  panel_.compute();
  EXPECT_FALSE(panel_.isBusy());
  panel_.setRun(run_);
  EXPECT_TRUE(panel_.findChild<QPushButton*>("survey_compute")->isVisible());
}

TEST_F(Survey, TheMapHasTheNumbersOfDirectionsCsvAndItsWorstDirection) {
  compute();
  choose("survey_structure", "body");
  choose("survey_system", "full_torso");
  choose("survey_model", "dynamic");
  const QString csv = QString::fromStdString(
      analysis::directionsCsv(*run_->study, run_->result, analysis::byDirection(*run_->study, run_->result, {})));
  std::size_t cell = 0;
  const MapData& map = panel_.map().data();
  for (const QString& line : csv.split(u'\n')) {
    const QStringList fields = line.split(u',');
    if (fields.size() < 18 || fields[0] != "full_torso" || fields[1] != "dynamic" || fields[3] != "body") {
      continue;
    }
    ASSERT_LT(cell, map.cells.size());
    EXPECT_EQ(map.cells[cell].azimuth, fields[6].toDouble());
    EXPECT_EQ(map.cells[cell].elevation, fields[7].toDouble());
    ASSERT_TRUE(map.cells[cell].value);
    EXPECT_NEAR(*map.cells[cell].value, 100.0 * fields[11].toDouble(), 1e-3);
    if (fields[16] == "1") {
      ASSERT_TRUE(map.mark);
      EXPECT_EQ(*map.cells[*map.mark].value, *map.cells[cell].value);
    }
    ++cell;
  }
  EXPECT_EQ(cell, map.cells.size());
  EXPECT_EQ(cell, 18U);
  EXPECT_EQ(panel_.csv().count('\n'), 19);
}

TEST_F(Survey, TheFrontIsInTheMiddleAndThePersonsLeftOnTheRight) {
  compute();
  const DirectionMap& map = panel_.map();
  const QPointF front = map.placeOf(0.0, 0.0);
  EXPECT_GT(map.placeOf(90.0, 0.0).x(), front.x());
  EXPECT_EQ(map.placeOf(270.0, 0.0).x(), map.placeOf(-90.0, 0.0).x());
  EXPECT_NEAR(map.placeOf(90.0, 0.0).x() - front.x(), front.x() - map.placeOf(-90.0, 0.0).x(), 1e-9);
  EXPECT_LT(map.placeOf(0.0, 45.0).y(), front.y()) << "above is up";
}

TEST_F(Survey, LinesHaveAPointForEachFrameThatHits) {
  compute();
  choose("survey_structure", "body");
  choose("survey_what", 2);
  const auto series = panel_.lines().chart()->series();
  ASSERT_EQ(series.size(), static_cast<qsizetype>(run_->result.systems.size()));
  const auto frames = panel_.survey()->frames.size();
  ASSERT_GT(frames, 2U);
  for (const QAbstractSeries* one : series) {
    const auto points = static_cast<const QLineSeries*>(one)->points();
    ASSERT_EQ(points.size(), static_cast<qsizetype>(frames)) << "every frame is hit";
    EXPECT_EQ(points.front().x(), 0.0);
    EXPECT_NEAR(points.back().x(), 4.0, 1e-6) << "the clip's end";
    if (one->name() == "unarmored") {
      EXPECT_EQ(points.front().y(), 0.0);
    }
  }
}

TEST(MapColour, GrowsLighterAllTheWay) {
  const auto light = [](double share) {
    const QColor colour = mapColour(share);
    return 0.2126 * colour.redF() + 0.7152 * colour.greenF() + 0.0722 * colour.blueF();
  };
  for (int i = 1; i <= 20; ++i) {
    EXPECT_GT(light(i / 20.0), light((i - 1) / 20.0)) << i;
  }
}

}  // namespace
}  // namespace lorica::panels
