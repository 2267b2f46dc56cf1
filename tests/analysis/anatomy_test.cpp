#include "lorica/analysis/anatomy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lorica/analysis/import_study.h"
#include "lorica/analysis/results.h"
#include "lorica/base/error.h"
#include "lorica/geometry/primitives.h"
#include "lorica/io/export.h"
#include "lorica/study/study_file.h"
#include "temporary_folder.h"

namespace lorica::analysis {
namespace {

using geometry::Vec3d;

constexpr double organRadius = 0.04;

void save(const geometry::TriangleMesh& mesh, const std::filesystem::path& file) {
  const io::SceneMesh scene{"mesh", "organ", mesh.positions, mesh.triangles};
  io::writeScene(std::span(&scene, 1), io::SceneFormat::ply, file);
}

/// A small ball inside a larger one, behind a plate that ends at x = 0, shot at from ahead on a grid.
LoadedStudy ballBehindAnEdge(const test::TemporaryFolder& folder, double deviation) {
  save(geometry::ellipsoid({0, 1, 0}, {0.3, 0.3, 0.3}, 4), folder.path() / "skin.ply");
  save(geometry::ellipsoid({0, 1, 0}, {organRadius, organRadius, organRadius}, 4), folder.path() / "ball.ply");
  save(geometry::box({-1, 0, 0.5}, {0, 2, 0.52}), folder.path() / "plate.ply");
  ImportRequest request;
  request.skin = folder.path() / "skin.ply";
  request.organs = {folder.path() / "ball.ply"};
  request.armor = {{"armor", folder.path() / "plate.ply"}};
  request.units = base::LengthUnit::metre;
  request.up = 'y';
  request.studyFile = folder.path() / "s.lorica.json";
  study::Study study = importStudy(request, {}).study;
  study.sources = study::parseStudy(R"({"lorica_study": 1, "human": {"builtin": "human"}, "sources": [{"name": "ahead",
      "type": "parallel", "azimuth_deg": 0, "elevation_deg": 0, "sequence": "grid", "cell_mm": 3}]})",
                                    "s")
                      .sources;
  study.models = {viscera::OrganModel::staticJoint};
  study.trials = 2;
  study.analyses.anatomy = study::AnatomySettings{41, 1.0, false, {{"ball", Vec3d(deviation, 0, 0)}}};
  return load(study, request.studyFile, {});
}

/// Share of a disk around x = centre that lies at x < 0.
double shareLeft(double centre) {
  const double c = std::clamp(centre / organRadius, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / std::numbers::pi;
}

const AnatomyRow& rowOf(const LoadedStudy& study, const RunResult& run, const AnatomyResult& result) {
  const auto rows = summaryRows(study, run);
  for (const AnatomyRow& row : result.rows) {
    if (rows[row.row].structure == "ball" && rows[row.row].system == "armor") {
      return row;
    }
  }
  throw std::out_of_range("ball");
}

TEST(Anatomy, QuantilesBehindAnEdgeAreThoseOfTheDisplacement) {
  const test::TemporaryFolder folder;
  const LoadedStudy study = ballBehindAnEdge(folder, 0.02);
  const RunResult shot = run(study, {});
  const AnatomyResult result = overAnatomies(study, shot, {});
  const AnatomyRow& row = rowOf(study, shot, result);
  std::vector<double> expected;
  for (std::uint32_t draw = 0; draw < 41; ++draw) {
    const Vec3d moved = displacement(result.jitter.at(0), shot.seed, draw);
    EXPECT_EQ(moved.y(), 0.0);
    EXPECT_LE(std::abs(moved.x()), 0.04 * (1 + 1e-12)) << "cut at two standard deviations";
    expected.push_back(shareLeft(moved.x()));
  }
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(row.coverage.size(), 41U);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(row.coverage[i], expected[i], 0.015) << "the grid cuts the edge in steps of 3 mm, twice";
  }
  EXPECT_GT(row.coverage[38] - row.coverage[2], 0.5) << "the band is wide";
  EXPECT_EQ(row.heldBack, 0U);
  const std::string csv = anatomyCsv(study, shot, result);
  EXPECT_NE(csv.find("ahead,armor,static_joint,rest,ball,organ,,given,20.0,0.0,0.0,41,0,41,"), std::string::npos)
      << csv;
}

TEST(Anatomy, WithoutDisplacementEveryDrawIsTheRunItself) {
  const test::TemporaryFolder folder;
  LoadedStudy study = ballBehindAnEdge(folder, 0.0);
  study.study.analyses.anatomy->draws = 3;
  const RunResult shot = run(study, {});
  const AnatomyResult result = overAnatomies(study, shot, {});
  const auto rows = summaryRows(study, shot);
  ASSERT_FALSE(result.rows.empty());
  for (const AnatomyRow& row : result.rows) {
    for (const double coverage : row.coverage) {
      EXPECT_EQ(coverage, *rows[row.row].coverage());
    }
    for (const double share : row.percentOfShots) {
      EXPECT_EQ(share, rows[row.row].percentOfShots());
    }
  }
}

TEST(Anatomy, GivesTheSameBytesAtAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  LoadedStudy study = ballBehindAnEdge(folder, 0.1);
  study.study.analyses.anatomy->draws = 5;
  std::string first;
  for (const int threads : {1, 2, 5}) {
    RunOptions options;
    options.threads = {threads};
    const RunResult shot = run(study, options);
    const std::string csv = anatomyCsv(study, shot, overAnatomies(study, shot, {threads}));
    EXPECT_TRUE(first.empty() || csv == first);
    first = csv;
  }
}

TEST(Anatomy, AnOrganStopsAMillimetreBeforeTheSkin) {
  const geometry::TriangleMesh ball = geometry::ellipsoid({0, 0, 0}, {0.3, 0.3, 0.3}, 5);
  raycast::Scene skin(raycast::SceneUse::manyRays);
  skin.add(ball.positions, raycast::makeTopology(ball));
  skin.build();
  const geometry::TriangleMesh organ = geometry::ellipsoid({0, 0, 0}, {0.1, 0.1, 0.1}, 4);
  for (const Vec3d& along : {Vec3d(1, 0, 0), Vec3d(0.6, 0, -0.8)}) {
    EXPECT_NEAR(shareInside(skin, organ.positions, 0.4 * along, {}), (0.2 - 0.001) / 0.4, 0.001);
    EXPECT_EQ(shareInside(skin, organ.positions, 0.15 * along, {}), 1.0);
  }
  const std::vector<geometry::Vec3f> outside{{0.5F, 0, 0}};
  EXPECT_EQ(shareInside(skin, outside, Vec3d(-1, 0, 0), {}), 1.0) << "what is outside is not held";
}

TEST(Displacements, AreCutNormalNumbersOfTheOrganAndTheDrawAlone) {
  const OrganJitter heart{"heart", OrganJitter::Basis::given, {{0, 0.01}, {2, 0.02}}};
  const OrganJitter liver{"liver", OrganJitter::Basis::given, {{0, 0.01}}};
  std::vector<double> x;
  double products = 0.0;
  double others = 0.0;
  constexpr std::uint32_t draws = 4000;
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    const Vec3d moved = displacement(heart, 7, draw);
    EXPECT_EQ(moved, displacement(heart, 7, draw));
    EXPECT_EQ(moved.y(), 0.0);
    x.push_back(moved.x() / 0.01);
    products += x.back() * moved.z() / 0.02;
    others += x.back() * displacement(liver, 7, draw).x() / 0.01;
  }
  EXPECT_LT(std::abs(products / draws), 0.06) << "axes are independent";
  EXPECT_LT(std::abs(others / draws), 0.06) << "organs are independent";
  std::sort(x.begin(), x.end());
  EXPECT_GE(x.front(), -2.0);
  EXPECT_LE(x.back(), 2.0);
  // The quantiles of a normal number between -2 and 2.
  const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  for (const double z : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
    const double probability = (normal(z) - normal(-2.0)) / (normal(2.0) - normal(-2.0));
    const auto below = std::lower_bound(x.begin(), x.end(), z) - x.begin();
    EXPECT_NEAR(static_cast<double>(below) / draws, probability, 4.0 * 0.5 / std::sqrt(double{draws}));
  }
}

TEST(OrganMotionTable, IsReadByNameAndOrgansWithoutARowStay) {
  LoadedStudy study;
  study.study.analyses.anatomy = study::AnatomySettings{};
  for (const char* name : {"Left Kidney", "heart", "brain"}) {
    auto organ = std::make_shared<LoadedOrgan>();
    organ->name = name;
    study.organs.push_back(organ);
  }
  const auto jitter = jitterOf(study);
  EXPECT_EQ(jitter[0].basis, OrganJitter::Basis::verified);
  EXPECT_NEAR(jitter[0].deviation().y(), 0.25 * std::hypot(0.070, 0.0143), 1e-12) << "posture and breath";
  EXPECT_NEAR(jitter[0].deviation().x(), 0.0145, 1e-12);
  EXPECT_EQ(jitter[1].basis, OrganJitter::Basis::unverified);
  EXPECT_EQ(jitter[2].basis, OrganJitter::Basis::none);
  EXPECT_TRUE(jitter[2].components.empty());
  study.study.analyses.anatomy->verifiedOnly = true;
  EXPECT_TRUE(jitterOf(study)[1].components.empty());
  study.study.analyses.anatomy->deviations = {{"gall_bladder", {0, 0, 0}}};
  EXPECT_THROW(jitterOf(study), base::InputError);
}

}  // namespace
}  // namespace lorica::analysis
