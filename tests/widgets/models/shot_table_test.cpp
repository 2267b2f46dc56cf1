#include "lorica/models/shot_table.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <functional>

#include "lorica/analysis/shot_paths.h"
#include "sample_document.h"

namespace lorica::models {
namespace {

/// The words of a line, split at runs of blanks.
QStringList words(const QString& line) {
  return line.simplified().split(u' ', Qt::SkipEmptyParts);
}

class Shots : public testing::Test {
 protected:
  static const analysis::RunResult& plan() {
    static const analysis::RunResult plan = [] {
      analysis::RunOptions options;
      options.poses = {"rest"};
      return analysis::planRun(*testsupport::loadedSample(), options);
    }();
    return plan;
  }
  static analysis::ShotDetails details(std::uint64_t shot) {
    return analysis::shotDetails(*testsupport::loadedSample(), plan(), {"front", 0, shot}, {}).front();
  }
  static QStringList report(std::uint64_t shot) {
    return QString::fromStdString(analysis::shotReport(*testsupport::loadedSample(), plan(), {"front", 0, shot}, {}))
        .split(u'\n');
  }
  /// The number of the first shot whose crossings are so.
  static std::uint64_t firstWith(const std::function<bool(const analysis::ShotPath&)>& holds) {
    static const analysis::PosedScene scene(*testsupport::loadedSample(), plan().models, std::nullopt,
                                            raycast::SceneUse::manyRays, {});
    for (const analysis::ShotPath& path : analysis::shotPaths(scene, plan().sources[0], plan().seed, 5000)) {
      if (holds(path)) {
        return path.number;
      }
    }
    ADD_FAILURE() << "no such shot";
    return 0;
  }
  /// Through armor and an organ.
  static std::uint64_t throughArmorAndOrgan() {
    using Kind = analysis::StructureRef::Kind;
    static const std::uint64_t found = firstWith([](const analysis::ShotPath& path) {
      const auto has = [&](Kind kind) {
        return std::any_of(path.crossings.begin(), path.crossings.end(),
                           [kind](const auto& crossing) { return crossing.structure.kind == kind; });
      };
      return has(Kind::piece) && has(Kind::organ);
    });
    return found;
  }
};

TEST_F(Shots, RowsAreThoseOfTheReportOfTheCommandLine) {
  const std::uint64_t shot = throughArmorAndOrgan();
  const QStringList lines = report(shot);
  const study::Overlap overlap = testsupport::loadedSample()->study.overlap;
  for (const std::string& system : plan().systems) {
    for (const viscera::OrganModel model : plan().models) {
      const std::string name = viscera::name(model);
      // Passages of this system and model stand in the first table, gaps in the list under their heading.
      std::vector<QStringList> passages;
      std::vector<QStringList> gaps;
      bool inTable = false;
      bool inList = false;
      for (const QString& line : lines) {
        if (line.contains("enter mm")) {
          inTable = true;
        } else if (line.startsWith("armor system")) {
          inTable = false;
          inList = line.startsWith(
              QString("armor system %1, organs %2;").arg(QString::fromStdString(system), QString::fromStdString(name)));
        } else if (inTable) {
          const QStringList cells = words(line);
          const bool body = cells.value(1) == "body";
          if (body || cells.value(2).toStdString() == (cells.value(1) == "armor" ? system : name)) {
            passages.push_back(cells);
          }
        } else if (inList && line.contains("gap")) {
          gaps.push_back(words(line));
        }
      }
      std::size_t passage = 0;
      std::size_t gap = 0;
      for (const ShotRow& row : shotRows(details(shot), overlap, system, name)) {
        if (row.structure == "gap") {
          ASSERT_LT(gap, gaps.size());
          EXPECT_EQ((QStringList{row.enter, "to", row.exit, row.thickness, "mm", "gap"}), gaps[gap++]);
          continue;
        }
        QStringList cells{row.structure, row.kind};
        if (!row.group.isEmpty()) {
          cells << row.group;
        }
        cells << row.enter << row.exit << row.thickness << row.normalThickness << row.obliquityIn << row.obliquityOut
              << row.depth;
        ASSERT_LT(passage, passages.size());
        EXPECT_EQ(cells, passages[passage++]);
      }
      EXPECT_EQ(passage, passages.size()) << system << " " << name;
      EXPECT_EQ(gap, gaps.size()) << system << " " << name;
      EXPECT_GT(passage, 0U);
    }
  }
}

TEST_F(Shots, ProtectedIsWhatLiesBehindArmorOfTheSystem) {
  const analysis::ShotDetails shot = details(throughArmorAndOrgan());
  const auto organsOf = [&](const std::string& system) {
    std::vector<QString> said;
    bool armorSeen = false;
    for (const ShotRow& row : shotRows(shot, {}, system, viscera::name(plan().models.back()))) {
      armorSeen = armorSeen || row.kind == "armor";
      if (row.kind == "organ") {
        EXPECT_EQ(row.isProtected == "yes", armorSeen) << row.structure.toStdString();
        said.push_back(row.isProtected);
      }
    }
    return said;
  };
  for (const QString& said : organsOf("unarmored")) {
    EXPECT_EQ(said, "no");
  }
  const auto armored = organsOf(plan().systems.back());
  EXPECT_FALSE(armored.empty());
  EXPECT_TRUE(shotSummary(shot, "unarmored", viscera::name(plan().models.back())).contains("Armor in order: none"));
}

TEST_F(Shots, AMissHasNoRows) {
  const analysis::ShotDetails miss = details(firstWith([](const auto& path) { return path.crossings.empty(); }));
  EXPECT_TRUE(shotRows(miss, {}, "unarmored", "dynamic").empty());
  EXPECT_FALSE(shotSummary(miss, "unarmored", "dynamic").isEmpty());
}

TEST_F(Shots, TheTableIsAModelAndItsCsvHasARowForEachOfItsRows) {
  ShotTable table;
  const QAbstractItemModelTester tester(&table, QAbstractItemModelTester::FailureReportingMode::Fatal);
  table.setRows(
      shotRows(details(throughArmorAndOrgan()), {}, plan().systems.back(), viscera::name(plan().models.back())));
  ASSERT_GT(table.rowCount(), 3);
  const QStringList lines = table.csv().split(u'\n', Qt::SkipEmptyParts);
  ASSERT_EQ(lines.size(), table.rowCount() + 1);
  EXPECT_TRUE(lines[0].startsWith("structure,kind,system_or_model,enter_mm,exit_mm"));
  for (int row = 0; row < table.rowCount(); ++row) {
    EXPECT_EQ(lines[row + 1].count(u','), table.columnCount() - 1);
    EXPECT_TRUE(lines[row + 1].startsWith(table.index(row, 0).data().toString()));
  }
  table.setRows({});
  EXPECT_EQ(table.rowCount(), 0);
}

}  // namespace
}  // namespace lorica::models
