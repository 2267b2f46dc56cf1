#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "fields.h"
#include "lorica/base/error.h"
#include "lorica/threat/read_threat.h"

namespace lorica::threat {
namespace {

using geometry::Vec3d;

/// "place: text" of the error that reading ends in.
std::string errorOf(const std::string& csv, const ReadOptions& options = {}) {
  try {
    readThreatCsv(csv, "t.csv", options);
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.file(), "t.csv");
    return error.place() + ": " + error.text();
  }
  ADD_FAILURE() << "no error in " << csv;
  return "";
}

bool tells(const std::string& error, const std::string& place, const std::string& words) {
  return error.starts_with(place + ": ") && error.find(words) != std::string::npos;
}

TEST(ThreatCsv, UnderstandsUnitsOfPlacesTimesAndValues) {
  const ReadField read = readThreatCsv("x_mm,y_mm,z_mm,t_ms,pressure_kPa,score\n1000,2000,-500,4,12.5,3\n", "t.csv");
  ASSERT_EQ(read.field.steps.size(), 1U);
  EXPECT_TRUE(read.field.timed);
  EXPECT_DOUBLE_EQ(read.field.steps[0].time, 0.004);
  EXPECT_EQ(read.field.place(0, 0), Vec3d(1.0, 2.0, -0.5));
  EXPECT_EQ(read.field.attributes, (std::vector<Attribute>{{"pressure", "kPa"}, {"score", ""}}));
  EXPECT_EQ(read.field.steps[0].values, (std::vector<std::vector<float>>{{12.5F}, {3.0F}}));
  EXPECT_TRUE(read.issues.empty());
}

TEST(ThreatCsv, TakesBracketsOtherSeparatorsQuotesRemarksAndWindowsLines) {
  const std::string wanted = "x [cm];Y [cm];z [cm];\"peak load [N/m]\"\r\n# a remark\r\n\r\n100; 200 ;\"300\";+1e3\r\n";
  for (const char separator : {';', '\t', ','}) {
    std::string csv = "\xEF\xBB\xBF" + wanted;
    std::replace(csv.begin(), csv.end(), ';', separator);
    const ReadField read = readThreatCsv(csv, "t.csv");
    EXPECT_EQ(read.field.place(0, 0), Vec3d(1.0, 2.0, 3.0));
    EXPECT_EQ(read.field.attributes, (std::vector<Attribute>{{"peak load", "N/m"}}));
    EXPECT_EQ(read.field.steps[0].values[0][0], 1000.0F);
    EXPECT_FALSE(read.field.timed);
  }
}

TEST(ThreatCsv, MakesVectorsOfThreeColumns) {
  const ReadField read = readThreatCsv("x,y,z,v_x_m_s,v_y_m_s,v_z_m_s,mass_g\n0,0,0,1,2,3,4\n", "t.csv");
  EXPECT_EQ(read.field.attributes, (std::vector<Attribute>{{"v", "m/s", 3}, {"mass", "g", 1}}));
  EXPECT_EQ(read.field.steps[0].values[0], (std::vector<float>{1, 2, 3}));
}

TEST(ThreatCsv, GroupsRowsOfAnyOrderByTime) {
  const ReadField read = readThreatCsv("t,x,y,z,p,id\n2,0,0,0,1,7\n1,5,0,0,2,7\n2,1,0,0,3,8\n1,6,0,0,4,8\n", "t.csv");
  ASSERT_EQ(read.field.steps.size(), 2U);
  EXPECT_EQ(read.field.steps[0].time, 1.0);
  EXPECT_EQ(read.field.steps[0].values[0], (std::vector<float>{2, 4}));
  EXPECT_EQ(read.field.steps[1].ids, (std::vector<std::int64_t>{7, 8}));
  EXPECT_EQ(read.field.place(1, 1), Vec3d(1.0, 0.0, 0.0));
}

TEST(ThreatCsv, SharesPointsThatStay) {
  const ReadField read = readThreatCsv("t,x,y,z,p\n1,0,0,0,1\n1,1,2,0,1\n2,0,0,0,1\n2,1,2,0,1\n3,0,0,0,1\n", "t.csv");
  ASSERT_EQ(read.field.steps.size(), 3U);
  EXPECT_EQ(read.field.steps[0].points, read.field.steps[1].points);
  EXPECT_NE(read.field.steps[0].points, read.field.steps[2].points);
}

RC_GTEST_PROP(ThreatCsv, TakesPointsThatFillALatticeAsOneWhateverTheirOrder, ()) {
  const Lattice lattice{{planes(0.5, 0.25, *rc::gen::inRange(2U, 5U)), planes(-1.0, 0.5, *rc::gen::inRange(2U, 4U)),
                         planes(0.0, 2.0, *rc::gen::inRange(2U, 4U))}};
  std::vector<std::string> rows;
  for (const double time : {0.0, 1.0}) {
    for (std::size_t p = 0; p < lattice.points(); ++p) {
      const Vec3d at = lattice.place(p);
      rows.push_back(fmt::format("{},{},{},{},{}\n", time, at.x(), at.y(), at.z(), 1000.0 * time + double(p)));
    }
  }
  // The same order at both times, as a file of steps has it.
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  std::vector<std::size_t> order(lattice.points());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (a + 1) * 2654435761U * (seed | 1U) % 1009 < (b + 1) * 2654435761U * (seed | 1U) % 1009;
  });
  std::string csv = "t,x,y,z,p\n";
  for (std::size_t step = 0; step < 2; ++step) {
    for (const std::size_t i : order) {
      csv += rows[step * lattice.points() + i];
    }
  }
  const ReadField read = readThreatCsv(csv, "t.csv");
  RC_ASSERT(read.field.lattice.has_value());
  RC_ASSERT(read.field.lattice->axes == lattice.axes);
  for (std::size_t p = 0; p < lattice.points(); ++p) {
    RC_ASSERT(read.field.steps[1].values[0][p] == static_cast<float>(1000 + p));
  }
}

TEST(ThreatCsv, PointsThatLeaveAPlaceOfALatticeEmptyStayScattered) {
  std::string csv = "x,y,z,p\n";
  for (int i = 0; i < 8; ++i) {
    csv += i == 5 ? "0,0,0,9\n" : fmt::format("{},{},{},1\n", i & 1, i >> 1 & 1, i >> 2);
  }
  const ReadField read = readThreatCsv(csv, "t.csv");
  EXPECT_FALSE(read.field.lattice);
  ASSERT_EQ(read.issues.size(), 1U);
  EXPECT_EQ(read.issues[0].severity, base::Severity::warning);
  EXPECT_TRUE(read.issues[0].text.starts_with("1 point(s) lie at the place of another"));
}

TEST(ThreatCsv, ReadsOnlyTheAttributesAskedFor) {
  const ReadField read = readThreatCsv("x,y,z,material,p_kPa\n0,0,0,steel,5\n", "t.csv", {{}, {}, 'y', {"p"}});
  EXPECT_EQ(read.field.attributes, (std::vector<Attribute>{{"p", "kPa"}}));
}

TEST(ThreatCsv, ZUpBecomesYUp) {
  const ReadField read = readThreatCsv("x,y,z,p\n1,2,3,0\n", "t.csv", {{}, {}, 'z', {}});
  EXPECT_LT((read.field.place(0, 0) - Vec3d(1.0, 3.0, -2.0)).norm(), 1e-12);
}

TEST(ThreatCsv, NamesLineAndColumnOfABadRow) {
  const std::string head = "x,y,z,t_ms,pressure_kPa\n0,0,0,1,1\n";
  EXPECT_TRUE(tells(errorOf(head + "0,0,zero,1,1\n"), "line 3, column z", "expected a number, found \"zero\""));
  EXPECT_TRUE(tells(errorOf(head + "0,0,0,1,\n"), "line 3, column pressure_kPa", "found nothing"));
  EXPECT_TRUE(tells(errorOf(head + "0,0,0,1,nan\n"), "line 3, column pressure_kPa", "found \"nan\""));
  EXPECT_TRUE(tells(errorOf(head + "0,0,0,1,1e39\n"), "line 3, column pressure_kPa", "found \"1e39\""));
  EXPECT_TRUE(tells(errorOf(head + "0,0,0,inf,1\n"), "line 3, column t_ms", "found \"inf\""));
  EXPECT_TRUE(tells(errorOf(head + "# two\n\n0,0,0,1\n"), "line 5", "expected 5 fields, found 4"));
  EXPECT_TRUE(tells(errorOf(head + "0,0,0,1,1,9\n"), "line 3", "expected 5 fields, found more"));
  EXPECT_TRUE(tells(errorOf(head + "0,2e5,0,1,1\n"), "line 3, column y", "100 km"));
}

TEST(ThreatCsv, NamesWhatIsWrongWithTheHeader) {
  EXPECT_TRUE(tells(errorOf(""), "line 1", "is empty"));
  EXPECT_TRUE(tells(errorOf("x,y,z,p\n"), "line 1", "holds no points"));
  EXPECT_TRUE(tells(errorOf("x,y,p\n0,0,0\n"), "line 1", "expected one column z"));
  EXPECT_TRUE(tells(errorOf("x,x,y,z\n0,0,0,0\n"), "line 1", "expected one column x"));
  EXPECT_TRUE(tells(errorOf("x,y,z,p,p\n0,0,0,0,0\n"), "line 1", "stands here twice"));
  EXPECT_TRUE(tells(errorOf("x,y,z,,p\n0,0,0,0,0\n"), "line 1", "4. column has no name"));
  EXPECT_TRUE(tells(errorOf("x_kPa,y,z\n0,0,0\n"), "line 1, column x_kPa", "unit of a place"));
  EXPECT_TRUE(tells(errorOf("x_mm,y_cm,z\n0,0,0\n"), "line 1, column y_cm", "one unit"));
  EXPECT_TRUE(tells(errorOf("x,y,z,t_mm\n0,0,0,0\n"), "line 1, column t_mm", "unit of time"));
  EXPECT_TRUE(tells(errorOf("x_mm,y_mm,z_mm\n0,0,0\n", {base::LengthUnit::centimetre, {}, 'y', {}}),
                    "line 1, column x_mm", "cm was asked for"));
  EXPECT_TRUE(tells(errorOf("x,y,z,p\n0,0,0,0\n", {{}, {}, 'y', {"q"}}), "line 1", "no column \"q\"; it has p"));
}

TEST(ThreatCsv, RefusesAFragmentAtTwoPlacesAtOnce) {
  EXPECT_TRUE(tells(errorOf("id,t,x,y,z\n1,0,0,0,0\n2,0,1,0,0\n1,0,2,0,0\n"), "time 0 s", "the id 1 is there twice"));
}

RC_GTEST_PROP(ThreatCsv, AnyTextIsReadOrRefusedInASentence, ()) {
  std::string csv = *rc::gen::element<std::string>("", "x,y,z,p\n", "x;y;z;t_ms;id\n", "x\ty\tz\n");
  const auto pieces = *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
      "0", "1,2,3,4", "1;2;3;4;5", "\n", "\r\n", ",", ";", "\t", "-1e400", "nan", "#", "\"", "x", "9999999999999999999",
      " ", std::string(1, '\0'), "\xFF", "1e-320", "."));
  for (const std::string& piece : pieces) {
    csv += piece;
  }
  try {
    const ReadField read = readThreatCsv(csv, "t.csv");
    RC_ASSERT(!read.field.steps.empty());
  } catch (const base::InputError& error) {
    RC_ASSERT(!error.text().empty());
    RC_ASSERT(error.text().find('\n') == std::string::npos);
  }
}

}  // namespace
}  // namespace lorica::threat
