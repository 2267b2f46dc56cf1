#include "lorica/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "lorica/base/error.h"
#include "made_run.h"
#include "pdf_text.h"

namespace lorica::report {
namespace {

using test::madeRun;
using test::PdfText;
using test::RunSize;

QString percentOf(double share) {
  return QString::number(100.0 * share, 'f', 1);
}

const analysis::CoverageRow& rowOf(const analysis::RunTables& run, const std::string& model, const std::string& pose,
                                   const std::string& organ) {
  for (const analysis::CoverageRow& row : run.summary) {
    if (row.place.system == "vest" && row.place.model == model && row.place.pose == pose && row.structure == organ) {
      return row;
    }
  }
  throw std::out_of_range(organ);
}

TEST(Report, EveryOrganHasItsNumbersOfTheSummaryOnOneLine) {
  RunSize size;
  size.poses = {"rest", "kneeling"};
  size.organs = {"heart", "liver", "spleen", "kidney"};
  const analysis::RunTables run = madeRun(size);
  const QStringList lines = PdfText(reportPdf(run, {})).lines();
  for (const std::string& pose : size.poses) {
    for (const std::string& organ : size.organs) {
      const double rigid = *rowOf(run, "static_joint", pose, organ).coverage.value;
      const double deforming = *rowOf(run, "dynamic", pose, organ).coverage.value;
      const QString difference = QString::number(std::abs(100.0 * (deforming - rigid)), 'f', 1);
      const bool found = std::any_of(lines.begin(), lines.end(), [&](const QString& line) {
        const QStringList words = line.simplified().split(' ');
        return words.contains(QString::fromStdString(organ)) && words.contains(percentOf(rigid)) &&
               words.contains(percentOf(deforming)) &&
               words.contains((deforming < rigid ? QString(QChar(0x2212)) : QString("+")) + difference);
      });
      EXPECT_TRUE(found) << organ << " in " << pose << ": " << percentOf(rigid).toStdString() << ", "
                         << percentOf(deforming).toStdString() << ", " << difference.toStdString();
    }
  }
}

TEST(Report, KeyFindingsNameTheLargestDifferenceOfTheModels) {
  RunSize size;
  size.poses = {"rest", "kneeling"};
  size.organs = {"heart", "liver", "spleen", "kidney"};
  const analysis::RunTables run = madeRun(size);
  double largest = 0.0;
  QString wanted;
  for (const std::string& pose : size.poses) {
    for (const std::string& organ : size.organs) {
      const double rigid = *rowOf(run, "static_joint", pose, organ).coverage.value;
      const double deforming = *rowOf(run, "dynamic", pose, organ).coverage.value;
      if (std::abs(deforming - rigid) > largest) {
        largest = std::abs(deforming - rigid);
        wanted = QString("%1 in %2 under vest: %3 %")
                     .arg(QString::fromStdString(organ), QString::fromStdString(pose), percentOf(deforming));
      }
    }
  }
  ASSERT_GT(largest, 0.05);
  const QString text = PdfText(reportPdf(run, {})).text();
  const auto first = text.indexOf("The largest differences in coverage:");
  ASSERT_GE(first, 0);
  EXPECT_TRUE(text.mid(first + 36, 60).contains(wanted)) << text.mid(first, 120).toStdString();
}

TEST(Report, KeyFindingsSetSystemsAgainstEachOther) {
  RunSize size;
  size.systems = {"vest", "carrier"};
  const analysis::RunTables run = madeRun(size);
  const auto coverage = [&](const std::string& system) {
    for (const analysis::CoverageRow& row : run.summary) {
      if (row.place.system == system && row.place.model == "dynamic" && row.structure == "organs") {
        return *row.coverage.value;
      }
    }
    return 0.0;
  };
  const double change = 100.0 * (coverage("vest") - coverage("carrier"));
  const QString wanted = QString("vest against carrier, all organs: a difference of %1%2 percentage points in rest.")
                             .arg(change < 0.0 ? QString(QChar(0x2212)) : QString("+"))
                             .arg(QString::number(std::abs(change), 'f', 1));
  EXPECT_TRUE(PdfText(reportPdf(run, {})).text().contains(wanted)) << wanted.toStdString();
}

TEST(Report, PagesAreNumberedAndTheFileSaysWhatItIs) {
  RunSize size;
  size.poses = {"rest", "kneeling", "prone"};
  const QByteArray pdf = reportPdf(madeRun(size), {});
  const PdfText seen(pdf);
  ASSERT_GT(seen.pages(), 5);
  const QString text = seen.text();
  for (int page = 1; page <= seen.pages(); ++page) {
    EXPECT_TRUE(text.contains(QString("%1 of %2").arg(page).arg(seen.pages()))) << page;
  }
  EXPECT_TRUE(seen.info().contains("Coverage report: made up"));
  // Every font is embedded: the column "emb" of each line below the two of the head.
  const QStringList fonts = seen.fonts().trimmed().split('\n').mid(2);
  ASSERT_FALSE(fonts.isEmpty());
  for (const QString& font : fonts) {
    EXPECT_TRUE(font.contains(QRegularExpression("Identity-H\\s+yes"))) << font.toStdString();
  }
}

TEST(Report, IsTheSameFileEveryTimeAndHoldsNoTime) {
  const analysis::RunTables run = madeRun({});
  const QByteArray pdf = reportPdf(run, {});
  EXPECT_EQ(pdf, reportPdf(run, {}));
  EXPECT_FALSE(pdf.contains("CreationDate"));
  EXPECT_FALSE(PdfText(pdf).info().contains("CreationDate"));
}

/// Long names, many of everything.
RunSize large() {
  RunSize size;
  size.systems.clear();
  for (const char* system : {"a_plate_carrier_with_a_name_that_no_column_can_hold_in_one_line", "vest %1 100 %"}) {
    size.systems.emplace_back(system);
  }
  size.poses.clear();
  for (int pose = 0; pose < 8; ++pose) {
    size.poses.push_back("a very long pose name with many words and number " + std::to_string(pose));
  }
  size.organs.clear();
  for (int organ = 0; organ < 40; ++organ) {
    size.organs.push_back("organ_" + std::to_string(organ) + std::string(organ % 3 == 0 ? 70 : 0, 'x'));
  }
  return size;
}

TEST(Report, NothingStandsOutsideThePageHoweverLongNamesAre) {
  analysis::RunTables run = madeRun(large());
  run.facts.study = std::string(300, 'W');
  run.facts.description = std::string(900, 'd');
  run.facts.inputs.push_back({std::string(200, 'f') + ".glb", std::string(64, 'b')});
  run.facts.issues.assign(80, "note about " + std::string(300, 'q'));
  const PdfText seen(reportPdf(run, {}));
  const std::vector<test::Word> words = seen.words();
  ASSERT_GT(words.size(), 10000U);
  constexpr double margin = 18.0 * 72.0 / 25.4;
  for (const test::Word& word : words) {
    EXPECT_GE(word.left, margin - 3.0) << word.page << ": " << word.text.toStdString();
    EXPECT_LE(word.right, 595.3 - margin + 3.0) << word.page << ": " << word.text.toStdString();
    EXPECT_GE(word.top, 20.0) << word.page << ": " << word.text.toStdString();
    EXPECT_LE(word.bottom, 842.0 - 20.0) << word.page << ": " << word.text.toStdString();
  }
}

TEST(Report, TablesOverSeveralPagesRepeatTheirHeads) {
  RunSize size = large();
  size.models = {"static_joint", "static_skin", "dynamic_thesis", "dynamic"};
  size.systems = {"vest"};
  size.poses = {"rest"};
  const PdfText seen(reportPdf(madeRun(size), {}));
  std::set<int> pagesWithOrgans;
  std::set<int> pagesWithHeads;
  for (const test::Word& word : seen.words()) {
    if (word.text.startsWith("organ_") && word.left < 60.0) {
      pagesWithOrgans.insert(word.page);
    }
    if (word.text == "Organ" && word.left < 60.0) {
      pagesWithHeads.insert(word.page);
    }
  }
  EXPECT_GT(pagesWithOrgans.size(), 3U);
  for (const int page : pagesWithOrgans) {
    EXPECT_TRUE(pagesWithHeads.contains(page)) << page;
  }
  EXPECT_TRUE(seen.text().contains("(continued)"));
}

TEST(Report, APartialRunIsSaidLoudlyOnTheFirstPage) {
  analysis::RunTables run = madeRun({});
  run.facts.partial = true;
  run.facts.runs.front().trials = 1;
  const QString text = PdfText(reportPdf(run, {})).text();
  EXPECT_TRUE(text.left(600).contains("PARTIAL RESULT. The run was stopped after 1 of 3 trials"));
  EXPECT_FALSE(PdfText(reportPdf(madeRun({}), {})).text().contains("PARTIAL"));
}

TEST(Report, WhatIsMissingIsSaidInWords) {
  analysis::RunTables run = madeRun({});
  run.summary.clear();
  run.deformation.clear();
  run.facts.partial = true;
  run.facts.runs.front().trials = 0;
  EXPECT_TRUE(PdfText(reportPdf(run, {})).text().contains("No trial of any source and pose was finished"));
  RunSize bare;
  bare.systems.clear();
  EXPECT_TRUE(PdfText(reportPdf(madeRun(bare), {})).text().contains("The study has no armor"));
  RunSize hollow;
  hollow.organs.clear();
  analysis::RunTables empty = madeRun(hollow);
  EXPECT_TRUE(PdfText(reportPdf(empty, {})).text().contains("The study has no organs"));
}

TEST(Report, SaysHowManyPosesHaveNoPicture) {
  RunSize size;
  size.poses = {"rest", "kneeling", "prone"};
  QImage image(40, 90, QImage::Format_RGB32);
  image.fill(Qt::white);
  PictureSet pictures;
  pictures.model = "dynamic";
  pictures.metresPerPixel = 0.02;
  pictures.poses.push_back({"kneeling", "vest", image, image, image});
  pictures.legend.push_back({"heart", "", qRgb(200, 0, 0)});
  const QString text = PdfText(reportPdf(madeRun(size), pictures)).text();
  EXPECT_TRUE(text.contains("kneeling, vest"));
  EXPECT_TRUE(text.contains("2 more poses of the run are not drawn."));
}

TEST(Report, CanBeStopped) {
  base::Task task;
  task.cancel();
  EXPECT_THROW(reportPdf(madeRun({}), {}, base::Progress(task)), base::Cancelled);
}

}  // namespace
}  // namespace lorica::report
