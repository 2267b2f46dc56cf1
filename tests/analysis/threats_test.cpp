#include "lorica/analysis/threats.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lorica/analysis/check.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/export.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

using geometry::Vec3d;

/// A body that is a box from (-0.2, 0, -0.1) to (0.2, 1.8, 0.1) without a rig, an organ in it, a plate before it.
class Threats : public testing::Test {
 protected:
  Threats() {
    putMesh("body", {-0.2, 0.0, -0.1}, {0.2, 1.8, 0.1});
    putMesh("heart", {-0.05, 1.2, -0.05}, {0.05, 1.3, 0.05});
    putMesh("plate", {-0.15, 1.0, 0.12}, {0.15, 1.4, 0.14});
  }

  void putMesh(const std::string& name, const Vec3d& low, const Vec3d& high) const {
    const geometry::TriangleMesh mesh = geometry::box(low, high);
    const std::vector<io::SceneMesh> scene{{name, "body", mesh.positions, mesh.triangles}};
    io::writeScene(scene, io::SceneFormat::glb, folder_.path() / (name + ".glb"));
  }
  void put(const std::string& name, const std::string& bytes) const {
    base::writeFileAtomically(folder_.path() / name, bytes);
  }
  std::filesystem::path file() const { return folder_.path() / "s.lorica.json"; }

  LoadedStudy load(const std::string& threats) const {
    put("s.lorica.json", R"({"lorica_study": 1, "human": {"file": "body.glb"},
      "organs": [{"name": "heart", "file": "heart.glb"}],
      "armor": [{"name": "vest", "pieces": [{"name": "plate", "file": "plate.glb"}]}],
      "models": ["static_joint"], "threats": )" +
                             threats + "}");
    return analysis::load(study::loadStudy(file()), file(), {});
  }
  static ThreatOptions options() {
    ThreatOptions made;
    made.model = viscera::OrganModel::staticJoint;
    return made;
  }
  static const ThreatRow& rowOf(const ThreatResult& result, const std::string& structure) {
    for (const ThreatRow& row : result.rows) {
      if (row.structure == structure) {
        return row;
      }
    }
    throw std::runtime_error("no row of " + structure);
  }

  test::TemporaryFolder folder_;
};

/// Rows x,y,z,t_ms,p_kPa on the corners of a box of 4 m, p = 10 y times 1, 2 and 0 at 0, 1 and 2 ms.
std::string risingCsv() {
  std::string csv = "x,y,z,t_ms,p_kPa\n";
  for (const int time : {0, 1, 2}) {
    for (int corner = 0; corner < 8; ++corner) {
      const int y = (corner >> 1 & 1) != 0 ? 2 : 0;
      csv += fmt::format("{},{},{},{},{}\n", (corner & 1) != 0 ? 2 : -2, y, (corner >> 2) != 0 ? 2 : -2, time,
                         10 * y * std::array{1, 2, 0}.at(static_cast<std::size_t>(time)));
    }
  }
  return csv;
}

TEST_F(Threats, ARisingPressureOnABoxHasKnownPeaksMeansSharesAndImpulses) {
  put("p.csv", risingCsv());
  const ThreatResult result =
      threatAnalysis(load(R"([{"name": "rise", "file": "p.csv", "threshold": 18}])"), options());
  const ThreatRow& body = rowOf(result, "body");
  EXPECT_EQ(body.attribute, (threat::Attribute{"p", "kPa"}));
  EXPECT_EQ(body.pose, "rest");
  EXPECT_NEAR(*body.peak, 36.0, 1e-4);
  EXPECT_NEAR(*body.peakTime, 0.001, 1e-12);
  EXPECT_NEAR(body.peakPlace->y(), 1.8, 1e-6);
  EXPECT_NEAR(*body.mean, 18.0, 1e-4) << "even in y, and so is the box";
  EXPECT_NEAR(*body.shareAbove, 0.5, 1e-5);
  EXPECT_NEAR(body.area, 2.0 * (0.4 * 1.8 + 0.2 * 1.8 + 0.4 * 0.2), 1e-6);
  EXPECT_NEAR(body.areaWithValue, body.area, 1e-9);
  // 10 y kPa: (1 + 2)/2 and (2 + 0)/2 over a millisecond each, 2.5 ms in all; kPa ms are Pa s.
  EXPECT_NEAR(*body.peakImpulse, 18.0 * 2.5, 1e-3);
  EXPECT_NEAR(*rowOf(result, "heart").peak, 26.0, 1e-4);
  EXPECT_EQ(rowOf(result, "heart").kind, "organ");
  EXPECT_NEAR(*rowOf(result, "plate").mean, 24.0, 1e-4);
  EXPECT_NEAR(*rowOf(result, "plate").shareAbove, 1.0, 1e-9);
}

TEST_F(Threats, AtATimeTheValuesThenAreTabled) {
  put("p.csv", risingCsv());
  ThreatOptions then = options();
  then.time = 0.0115;
  const ThreatResult result =
      threatAnalysis(load(R"([{"name": "rise", "file": "p.csv", "time_offset_ms": 10}])"), then);
  EXPECT_NEAR(*rowOf(result, "body").peak, 18.0, 1e-4);
  EXPECT_FALSE(rowOf(result, "body").peakImpulse);
  EXPECT_FALSE(rowOf(result, "body").shareAbove);
  then.time = 0.0015;
  EXPECT_FALSE(
      rowOf(threatAnalysis(load(R"([{"name": "rise", "file": "p.csv", "time_offset_ms": 10}])"), then), "body").peak);
}

TEST_F(Threats, APlacementMovesAndTurnsTheData) {
  // Along the file's x; turned by 90 degrees about z it runs along y, and its origin is moved to y = 1.
  put("p.csv",
      "x_cm,y_cm,z_cm,p\n-200,-200,-200,-2\n200,-200,-200,2\n-200,200,-200,-2\n200,200,-200,2\n"
      "-200,-200,200,-2\n200,-200,200,2\n-200,200,200,-2\n200,200,200,2\n");
  const ThreatResult result = threatAnalysis(
      load(R"([{"name": "t", "file": "p.csv", "offset": [0, 1, 0], "turn_deg": [0, 0, 90]}])"), options());
  EXPECT_NEAR(*rowOf(result, "body").peak, 0.8, 1e-6);
  EXPECT_NEAR(*rowOf(result, "body").mean, -0.1, 1e-6);
  EXPECT_FALSE(rowOf(result, "body").peakTime);
}

TEST_F(Threats, AreaThatTheDataDoNotReachIsTold) {
  put("p.csv", "x,y,z,p\n0.2,1.8,0.1,7\n");
  const ThreatResult result = threatAnalysis(load(R"([{"name": "t", "file": "p.csv", "reach_mm": 1}])"), options());
  EXPECT_EQ(rowOf(result, "body").peak, 7.0);
  EXPECT_FALSE(rowOf(result, "body").mean);
  EXPECT_EQ(rowOf(result, "body").areaWithValue, 0.0);
  EXPECT_FALSE(rowOf(result, "heart").peak);
}

TEST_F(Threats, AFragmentsCrossingsComeInOrderWithTheirTimesAndTheArmorBeforeThem) {
  // Fragment 1 flies along -z through plate, body and heart at 100 m/s, with a sight between plate and body;
  // fragment 2 passes under the plate; fragment 3 ends before the body.
  put("f.csv",
      "id,t_ms,x,y,z\n1,0,0,1.25,1.11\n1,10,0,1.25,0.11\n1,30,0,1.25,-1.89\n2,0,0,0.5,1.1\n2,10,0,0.5,0.1\n"
      "2,20,0,0.5,-0.9\n3,0,0,0.5,1\n3,5,0,0.5,0.5\n");
  const ThreatResult result = threatAnalysis(load(R"([{"name": "f", "file": "f.csv"}])"), options());
  EXPECT_TRUE(result.rows.empty());
  ASSERT_EQ(result.crossings.size(), 4U);
  const auto expect = [&](std::size_t i, int fragment, int order, const char* structure, const char* before, double ms,
                          double z) {
    const FragmentCrossing& crossing = result.crossings[i];
    EXPECT_EQ(crossing.fragment, fragment);
    EXPECT_EQ(crossing.order, static_cast<std::size_t>(order));
    EXPECT_EQ(crossing.structure, structure);
    EXPECT_EQ(crossing.armorBefore, before);
    EXPECT_NEAR(1e3 * *crossing.time, ms, 1e-4);
    EXPECT_NEAR(crossing.place.z(), z, 1e-6);
  };
  expect(0, 1, 1, "plate", "", 9.7, 0.14);
  expect(1, 1, 2, "body", "vest", 10.1, 0.1);
  expect(2, 1, 3, "heart", "vest", 10.6, 0.05);
  expect(3, 2, 1, "body", "", 10.0, 0.1);
  EXPECT_EQ(result.crossings[0].group, "vest");
  EXPECT_EQ(result.crossings[2].group, "static_joint");
}

TEST_F(Threats, ABuiltInBlastReachesEveryVertexOfEveryPose) {
  const ThreatResult result =
      threatAnalysis(load(R"([{"name": "b", "builtin": "blast", "tnt_kg": 1, "position": [0, 1, 3]}])"), options());
  for (const ThreatRow& row : result.rows) {
    EXPECT_NEAR(row.areaWithValue, row.area, 1e-9) << row.structure;
  }
  EXPECT_GT(*rowOf(result, "plate").peak, *rowOf(result, "heart").peak) << "nearer to the charge";
  EXPECT_LT(*rowOf(result, "plate").peakTime, *rowOf(result, "heart").peakTime);
}

TEST_F(Threats, FilesAreWrittenAllTogetherAndReadBack) {
  put("p.csv", risingCsv());
  ThreatOptions wanted = options();
  wanted.time = 0.001;
  wanted.models = true;
  wanted.levels = {20.0};
  wanted.slices = {{1, 1.0}};
  wanted.spacing = 0.5;
  const ThreatResult result = threatAnalysis(load(R"([{"name": "a/b", "file": "p.csv"}])"), wanted);
  const std::vector<std::string> names = writeThreats(result, folder_.path() / "out");
  EXPECT_EQ(names, (std::vector<std::string>{"threat.csv", "a_b_rest.vtp", "a_b_level_20.vtp", "a_b_slice_y_1.vtp"}));
  // The slice, read as threat data: at 1 m the pressure is 20 kPa everywhere.
  const threat::ThreatField slice = threat::readThreat(folder_.path() / "out" / "a_b_slice_y_1.vtp").field;
  EXPECT_EQ(slice.attributes, (std::vector<threat::Attribute>{{"p", "kPa"}}));
  EXPECT_EQ(slice.points(0), 81U);
  for (const float value : slice.steps[0].values[0]) {
    EXPECT_NEAR(value, 20.0F, 1e-4F);
  }
  wanted.time.reset();
  EXPECT_THROW(threatAnalysis(load(R"([{"name": "a", "file": "p.csv"}])"), wanted), base::InputError);
}

TEST_F(Threats, TablesAreTheSameBytesAtAnyNumberOfThreads) {
  put("p.csv", risingCsv());
  const LoadedStudy study = load(R"([{"name": "rise", "file": "p.csv", "threshold": 18},
                                     {"name": "b", "builtin": "blast", "tnt_kg": 1, "position": [0, 1, 3]}])");
  ThreatOptions one = options();
  one.threads = {1};
  ThreatOptions three = options();
  three.threads = {3};
  EXPECT_EQ(threatCsv(threatAnalysis(study, one).rows), threatCsv(threatAnalysis(study, three).rows));
}

TEST_F(Threats, WhatIsWrongIsToldWithItsPlace) {
  put("p.csv", risingCsv());
  put("none.csv", "x,y,z\n0,0,0\n");
  const auto errorOf = [&](const std::string& threats) -> std::string {
    try {
      threatAnalysis(load(threats), options());
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(errorOf("[]").find("/threats: the study has no threat data"), std::string::npos);
  EXPECT_NE(errorOf(R"([{"name": "t", "file": "p.csv", "attribute": "q"}])").find("no column \"q\"; it has p"),
            std::string::npos);
  EXPECT_NE(errorOf(R"([{"name": "t", "file": "none.csv"}])").find("/threats/0: the data have neither values nor ids"),
            std::string::npos);
  EXPECT_NE(errorOf(R"([{"name": "t", "file": "absent.csv"}])").find("absent.csv: there is no such file"),
            std::string::npos);
  EXPECT_NE(errorOf(R"([{"name": "t", "file": "p.csv", "units": "km"}])").find("/threats/0/units"), std::string::npos);
}

TEST_F(Threats, CheckTellsWhatAFileHoldsAndWhereItLies) {
  put("p.csv", risingCsv());
  const base::Issues found = checkFile(folder_.path() / "p.csv", {});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NE(found[0].text.find("a lattice of 2 x 2 x 2 points, 3 time(s) from 0 to 2 ms"), std::string::npos);
  EXPECT_EQ(found[1].text, "from 0 to 40 kPa");
  load(R"([{"name": "far", "file": "p.csv", "offset": [10, 0, 0]}])");
  const base::Issues study = checkFile(file(), {});
  const bool told = std::any_of(study.begin(), study.end(), [](const base::Issue& issue) {
    return issue.place == "/threats/0" && issue.text.find("lies 7.80 m beside the body") != std::string::npos;
  });
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace lorica::analysis
