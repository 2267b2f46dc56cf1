#include "lorica/panels/survey_panel.h"

#include <gtest/gtest.h>

#include <QChart>
#include <QChartView>
#include <QComboBox>
#include <QLabel>
#include <QLineSeries>
#include <QPushButton>
#include <QTableView>
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
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel_.survey() != nullptr && !panel_.isBusy(); }, 300000))
        << panel_.findChild<QLabel*>("survey_words")->text().toStdString();
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

/// A run of the sample whose study asks for gaps and for draws of where organs lie.
std::shared_ptr<const document::RunRecord> recordOf(bool gaps, bool anatomy) {
  auto study = std::make_shared<analysis::LoadedStudy>(*testsupport::loadedSample());
  if (gaps) {
    study->study.analyses.gaps = study::GapSettings{{"body", "liver"}, 0.1, 5, 0.05, false};
  }
  if (anatomy) {
    study->study.analyses.anatomy = study::AnatomySettings{2, 1.0, false, {}};
  }
  auto made = std::make_shared<document::RunRecord>();
  made->name = "Run 1";
  made->result = testsupport::sampleResult();
  made->study = std::move(study);
  return made;
}

class Tables : public Survey {
 protected:
  QString at(int row, const char* title) const {
    const QAbstractItemModel& table = *panel_.table().model();
    for (int column = 0; column < table.columnCount(); ++column) {
      if (table.headerData(column, Qt::Horizontal).toString() == QString::fromUtf8(title)) {
        return table.index(row, column).data().toString();
      }
    }
    ADD_FAILURE() << title;
    return {};
  }
  /// Lines of a file whose fields are these, without its first line.
  static QStringList linesWith(const std::string& csv, const std::string& system, const std::string& model) {
    QStringList lines;
    for (const QString& line : QString::fromStdString(csv).split(u'\n')) {
      const QStringList fields = line.split(u',');
      if (fields.size() > 3 && fields[1].toStdString() == system && fields[2].toStdString() == model) {
        lines.append(line);
      }
    }
    return lines;
  }
};

TEST_F(Tables, GapsAreThoseOfGapsCsvUnderTheChosenSystemAndModel) {
  run_ = recordOf(true, false);
  compute();
  choose("survey_what", gapsInArmor);
  choose("survey_system", "plate_carrier");
  choose("survey_model", "static_joint");
  const std::string file = analysis::gapsCsv(run_->result, *panel_.survey()->gaps);
  const QStringList lines = linesWith(file, "plate_carrier", "static_joint");
  ASSERT_GT(lines.size(), 2);
  ASSERT_EQ(panel_.table().model()->rowCount(), lines.size());
  for (int row = 0; row < lines.size(); ++row) {
    const QStringList fields = lines[row].split(u',');
    EXPECT_EQ(at(row, "Pose"), fields[3]);
    EXPECT_EQ(at(row, "To protect"), fields[4]);
    EXPECT_EQ(at(row, "Unprotected shots").remove(u','), fields[16]);
    EXPECT_EQ(at(row, "Gap"), fields[5] == "0" ? QString("elsewhere") : fields[5]);
    if (fields[5] != "0") {
      EXPECT_NEAR(at(row, "Area cm²").toDouble(), fields[7].toDouble(), 0.0501);
      EXPECT_EQ(at(row, "Azimuth °"), fields[12]);
      EXPECT_EQ(at(row, "Elevation °"), fields[13]);
    }
  }
  const QStringList copied = QString::fromUtf8(panel_.csv()).split(u'\n', Qt::SkipEmptyParts);
  EXPECT_EQ(copied.mid(1), lines) << "what is copied is the file's rows";
}

TEST_F(Tables, AGapThatIsChosenIsTheRowsPatchOfTheSkin) {
  run_ = recordOf(true, false);
  compute();
  choose("survey_what", gapsInArmor);
  std::shared_ptr<const jobs::SkinPatch> picked;
  QObject::connect(&panel_, &SurveyPanel::patchPicked, &panel_, [&](const auto& patch) { picked = patch; });
  const std::vector<analysis::Gap>& gaps = *panel_.survey()->gaps;
  panel_.table().sortByColumn(7, Qt::DescendingOrder);
  panel_.table().selectRow(0);
  ASSERT_NE(picked, nullptr) << "the largest is no row of what is elsewhere";
  EXPECT_EQ(picked->body, run_->study->body);
  const bool known = std::any_of(gaps.begin(), gaps.end(), [&](const analysis::Gap& gap) {
    return gap.patch.triangles == picked->triangles && run_->result.poses[gap.pose] == picked->pose &&
           run_->result.systems[gap.system] == "full_torso" && gap.structure == at(0, "To protect").toStdString();
  });
  EXPECT_TRUE(known);
  panel_.setRun(nullptr);
  EXPECT_EQ(picked, nullptr) << "no gap is shown any more";
}

TEST_F(Tables, PlacesOfOrgansAreThoseOfAnatomyCsv) {
  run_ = recordOf(false, true);
  compute();
  choose("survey_what", placesOfOrgans);
  choose("survey_system", "full_torso");
  choose("survey_model", "dynamic");
  const std::string file = analysis::anatomyCsv(*run_->study, run_->result, *panel_.survey()->anatomy);
  const QStringList lines = linesWith(file, "full_torso", "dynamic");
  ASSERT_GT(lines.size(), 5);
  ASSERT_EQ(panel_.table().model()->rowCount(), lines.size());
  for (int row = 0; row < lines.size(); ++row) {
    const QStringList fields = lines[row].split(u',');
    EXPECT_EQ(at(row, "Structure"), fields[4]);
    EXPECT_EQ(at(row, "Draws that hit"), fields[13]);
    if (!fields[14].isEmpty()) {
      EXPECT_NEAR(at(row, "Coverage %").toDouble(), 100.0 * fields[14].toDouble(), 0.0501);
    }
    if (fields[13] != "0") {
      EXPECT_NEAR(at(row, "Median %").toDouble(), 100.0 * fields[18].toDouble(), 0.0501);
    }
  }
  EXPECT_EQ(QString::fromUtf8(panel_.csv()).split(u'\n', Qt::SkipEmptyParts).mid(1), lines);
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
