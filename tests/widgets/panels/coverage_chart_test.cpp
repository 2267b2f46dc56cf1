#include "lorica/panels/coverage_chart.h"

#include <gtest/gtest.h>

#include <QBarSet>
#include <QCoreApplication>
#include <QGraphicsScene>
#include <QPainter>
#include <QValueAxis>
#include <cmath>

#include "lorica/panels/bar_figure.h"
#include "sample_document.h"

namespace lorica::panels {
namespace {

using analysis::ResultRow;

class CoverageChartTest : public testing::Test {
 protected:
  CoverageChartTest() {
    testsupport::openLoadedSample(document_);
    testsupport::addSampleRun(document_);
    chart_.setRun(document_.runs().back());
    chart_.setPose("toe_touch@2");
    chart_.setSystem("full_torso");
    chart_.resize(900, 500);
    chart_.show();
    QCoreApplication::processEvents();
  }

  const ResultRow& rowOf(const std::string& organ, const std::string& model) const {
    for (const ResultRow& row : chart_.run()->summary) {
      if (row.structure == organ && row.model == model && row.pose == "toe_touch@2" && row.system == "full_torso") {
        return row;
      }
    }
    throw std::logic_error("no row of " + organ);
  }
  /// Value and interval as the summary has them, in percent.
  std::pair<double, std::optional<stats::Interval>> expected(const ResultRow& row, ChartMeasure measure) const {
    if (measure == ChartMeasure::coverage) {
      return {100.0 * row.coverage().value_or(0.0), row.coverageInterval()};
    }
    if (measure == ChartMeasure::ofShots) {
      return {row.percentOfShots(), stats::wilson(row.count.any, row.shots)};
    }
    return {row.percentOfBodyHits().value_or(0.0), stats::wilson(row.count.withBody, row.bodyHits)};
  }
  /// Where a value stands, by the axis' range and the plot's rectangle alone.
  double heightOf(double value) const {
    const BarFigure& figure = chart_.figure();
    const auto* axis = qobject_cast<QValueAxis*>(figure.axes(Qt::Vertical).front());
    const QRectF plot = figure.plotArea();
    return plot.bottom() - plot.height() * (value - axis->min()) / (axis->max() - axis->min());
  }
  void expectIntervalsInPlace() {
    const BarFigure& figure = chart_.figure();
    const FigureData& data = figure.data();
    const QRectF plot = figure.plotArea();
    ASSERT_GT(plot.width(), 100.0);
    const double category = plot.width() / static_cast<double>(data.categories.size());
    for (std::size_t s = 0; s < data.series.size(); ++s) {
      for (std::size_t c = 0; c < data.categories.size(); ++c) {
        const auto interval = expected(rowOf(data.categories[c], data.series[s].model), chart_.measure()).second;
        const QLineF line = figure.intervalLine(s, c);
        EXPECT_NEAR(line.y1(), heightOf(interval ? 100.0 * interval->low : 0.0), 1.0);
        EXPECT_NEAR(line.y2(), heightOf(interval ? 100.0 * interval->high : 0.0), 1.0);
        // Two bars share the group; the first stands left of the category's middle, the second right of it.
        const double middle = plot.left() + (static_cast<double>(c) + 0.5) * category;
        const double half = figure.bars().barWidth() * category / 4.0;
        EXPECT_NEAR(line.x1(), middle + (s == 0 ? -half : half), 1.0);
      }
    }
  }

  document::StudyDocument document_;
  CoverageChart chart_;
};

class EachMeasure : public CoverageChartTest, public testing::WithParamInterface<ChartMeasure> {};

TEST_P(EachMeasure, BarsAreTheRowsValuesAndTheIntervalsWilsons) {
  chart_.setMeasure(GetParam());
  const FigureData& data = chart_.figure().data();
  ASSERT_EQ(data.series.size(), 2U);
  ASSERT_EQ(data.categories.size(), 17U);
  int positive = 0;
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    const QBarSet& bars = *chart_.figure().bars().barSets()[static_cast<qsizetype>(s)];
    ASSERT_EQ(bars.count(), 17) << "organs without a hit stay";
    for (std::size_t c = 0; c < data.categories.size(); ++c) {
      const auto [value, interval] = expected(rowOf(data.categories[c], data.series[s].model), GetParam());
      EXPECT_NEAR(bars.at(static_cast<int>(c)), value, 1e-9);
      ASSERT_EQ(data.series[s].bars[c].interval.has_value(), interval.has_value());
      if (interval) {
        EXPECT_NEAR(data.series[s].bars[c].interval->low, 100.0 * interval->low, 1e-9);
        EXPECT_NEAR(data.series[s].bars[c].interval->high, 100.0 * interval->high, 1e-9);
      }
      positive += value > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(positive, 5);
}

TEST_P(EachMeasure, IntervalsStandWhereTheAxisPutsThem) {
  chart_.setMeasure(GetParam());
  QCoreApplication::processEvents();
  expectIntervalsInPlace();
}

TEST_P(EachMeasure, IntervalsStayInPlaceWhenTheChartIsResized) {
  chart_.setMeasure(GetParam());
  for (const QSize size : {QSize(420, 330), QSize(1300, 700)}) {
    chart_.resize(size);
    QCoreApplication::processEvents();
    expectIntervalsInPlace();
  }
}

INSTANTIATE_TEST_SUITE_P(Measures, EachMeasure,
                         testing::Values(ChartMeasure::ofBodyHits, ChartMeasure::ofShots, ChartMeasure::coverage),
                         [](const auto& measure) {
                           return measure.param == ChartMeasure::coverage     ? "Coverage"
                                  : measure.param == ChartMeasure::ofBodyHits ? "OfBodyHits"
                                                                              : "OfShots";
                         });

TEST_F(CoverageChartTest, SaysWhatItShows) {
  EXPECT_TRUE(chart_.figure().title().contains("toe_touch@2"));
  EXPECT_TRUE(chart_.figure().title().contains("full_torso"));
  EXPECT_TRUE(chart_.figure().axes(Qt::Vertical).front()->titleText().contains("%")) << "the unit";
  chart_.setPose("rest");
  EXPECT_TRUE(chart_.figure().title().contains("rest"));
}

TEST_F(CoverageChartTest, CopiesTheNumbersOfItsBars) {
  chart_.setMeasure(ChartMeasure::coverage);
  const QList<QByteArray> lines = chart_.csv().split('\n');
  ASSERT_EQ(lines.size(), 1 + 34 + 1);
  for (qsizetype i = 1; i <= 22; ++i) {
    const QList<QByteArray> fields = lines[i].split(',');
    const ResultRow& row = rowOf(fields[3].toStdString(), fields[4].toStdString());
    EXPECT_EQ(fields[6].toULongLong(), row.count.shielded);
    EXPECT_EQ(fields[7].toULongLong(), row.count.any);
    EXPECT_EQ(fields[8].isEmpty(), !row.coverage().has_value());
    EXPECT_NEAR(fields[8].toDouble(), 100.0 * row.coverage().value_or(0.0), 1e-5);
  }
}

TEST_F(CoverageChartTest, PrintsBothModelsColoursAtAnySize) {
  for (const double scale : {1.0, 2.0}) {
    const QImage image = chart_.toImage({800, 450}, scale);
    EXPECT_EQ(image.size(), QSize(800, 450) * scale);
    for (const char* model : {"static_joint", "dynamic"}) {
      int pixels = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          pixels += image.pixelColor(x, y) == modelColour(model) ? 1 : 0;
        }
      }
      EXPECT_GT(pixels, 500) << model;
    }
    EXPECT_EQ(image.pixelColor(2, 2), QColor(Qt::white));
  }
}

TEST_F(CoverageChartTest, PrintsIntervalsInk) {
  // In the middle of the tallest bar there is a dark line, beside it only the bar.
  chart_.setMeasure(ChartMeasure::ofBodyHits);
  QCoreApplication::processEvents();
  const FigureData& data = chart_.figure().data();
  std::size_t tallest = 0;
  for (std::size_t c = 0; c < data.categories.size(); ++c) {
    tallest = data.series[1].bars[c].value > data.series[1].bars[tallest].value ? c : tallest;
  }
  const QLineF line = chart_.figure().intervalLine(1, tallest);
  QImage image(chart_.figure().size().toSize(), QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::white);
  QPainter painter(&image);
  chart_.figure().scene()->render(&painter, QRectF(image.rect()), chart_.figure().sceneBoundingRect());
  painter.end();
  const auto darkest = [&](double x) {
    int least = 255;
    for (int dx = -1; dx <= 1; ++dx) {
      least = std::min(
          least,
          image.pixelColor(static_cast<int>(std::lround(x)) + dx, static_cast<int>(std::lround(line.center().y())))
              .lightness());
    }
    return least;
  };
  EXPECT_LT(darkest(line.x1()), 70);
  EXPECT_GT(darkest(line.x1() + 8.0), 80);
}

TEST_F(CoverageChartTest, KeepsOrgansWithoutAHitAndSaysThatTheyHaveNoCoverage) {
  chart_.setMeasure(ChartMeasure::coverage);
  const auto categoryTitle = [this] { return chart_.figure().axes(Qt::Horizontal).front()->titleText(); };
  EXPECT_FALSE(categoryTitle().contains("no coverage"));
  auto record = std::make_shared<document::RunRecord>(*chart_.run());
  for (ResultRow& row : record->summary) {
    if (row.structure == "spleen") {
      row.count = {};
    }
  }
  chart_.setRun(record);
  const FigureData& data = chart_.figure().data();
  ASSERT_EQ(data.categories.size(), 17U);
  ASSERT_EQ(data.categories[4], "spleen");
  EXPECT_EQ(data.series[0].bars[4].value, 0.0);
  EXPECT_FALSE(data.series[0].bars[4].interval.has_value());
  EXPECT_TRUE(data.series[0].bars[3].interval.has_value());
  EXPECT_TRUE(categoryTitle().contains("no coverage"));
  EXPECT_EQ(chart_.figure().intervalLine(0, 4).length(), 0.0);
}

TEST_F(CoverageChartTest, ShowsNothingWithoutARun) {
  EXPECT_FALSE(chart_.figure().data().series.empty());
  chart_.setRun(nullptr);
  EXPECT_EQ(chart_.csv().count('\n'), 1) << "the header alone";
}

TEST(ModelColours, DifferInHueAndInGrey) {
  EXPECT_GT(std::abs(qGray(modelColour("static_joint").rgb()) - qGray(modelColour("dynamic").rgb())), 50);
  EXPECT_NE(modelColour("static_skin"), modelColour("static_joint"));
  EXPECT_NE(modelColour("dynamic_thesis"), modelColour("dynamic"));
}

TEST_F(CoverageChartTest, WhereThereIsLittleHeightItIsForTheBarsAndValuesCarryTheirUnit) {
  const auto* values = qobject_cast<QValueAxis*>(chart_.figure().axes(Qt::Vertical).front());
  ASSERT_NE(values, nullptr);
  EXPECT_FALSE(values->titleText().isEmpty());
  chart_.resize(460, 250);
  QCoreApplication::processEvents();
  EXPECT_TRUE(chart_.figure().title().isEmpty());
  EXPECT_TRUE(values->titleText().isEmpty()) << "it would be cut off";
  EXPECT_TRUE(values->labelFormat().contains("%%")) << "the unit";
  EXPECT_GT(chart_.figure().plotArea().height(), 0.33 * chart_.figure().size().height());
  chart_.resize(900, 500);
  QCoreApplication::processEvents();
  EXPECT_FALSE(chart_.figure().title().isEmpty());
  EXPECT_FALSE(values->titleText().isEmpty());
}

}  // namespace
}  // namespace lorica::panels
