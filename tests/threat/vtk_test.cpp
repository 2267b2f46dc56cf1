#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataSetWriter.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>

#include <cmath>

#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/threat/field_sampler.h"
#include "lorica/threat/read_threat.h"
#include "real_data.h"
#include "temporary_folder.h"

namespace lorica::threat {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3d;

vtkSmartPointer<vtkDoubleArray> arrayOf(const char* name, const std::vector<double>& values, int width = 1) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(width);
  for (const double value : values) {
    array->InsertNextValue(value);
  }
  return array;
}

/// 3 x 2 x 2 points from (10, 20, 30) at distances 1, 2, 4, with the values 0 to 11, plus `add`.
vtkSmartPointer<vtkImageData> image(double add = 0.0) {
  auto made = vtkSmartPointer<vtkImageData>::New();
  made->SetExtent(1, 3, 0, 1, 0, 1);
  made->SetOrigin(9.0, 20.0, 30.0);
  made->SetSpacing(1.0, 2.0, 4.0);
  std::vector<double> values(12);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(i) + add;
  }
  made->GetPointData()->AddArray(arrayOf("p_kPa", values));
  return made;
}

template <class Writer, class Data>
fs::path written(const fs::path& path, Data* data) {
  const vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->Write();
  return path;
}

std::string errorOf(const fs::path& path, const ReadOptions& options = {}) {
  try {
    readThreat(path, options);
  } catch (const base::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error in " << path;
  return "";
}

TEST(ThreatVtk, ReadsAnImageWithItsUnits) {
  const test::TemporaryFolder folder;
  const fs::path path = written<vtkXMLImageDataWriter>(folder.path() / "a.vti", image().Get());
  const ThreatField field = readThreat(path, {base::LengthUnit::centimetre, {}, 'y', {}}).field;
  ASSERT_TRUE(field.lattice);
  EXPECT_EQ(field.lattice->axes[0].size(), 3U);
  EXPECT_LT((field.place(0, 11) - Vec3d(0.12, 0.22, 0.34)).norm(), 1e-12);
  EXPECT_EQ(field.attributes, (std::vector<Attribute>{{"p", "kPa"}}));
  EXPECT_EQ(field.steps[0].values[0][11], 11.0F);
  EXPECT_FALSE(field.timed);
}

TEST(ThreatVtk, ReadsTheTimeAndBlankPointsOfAnImage) {
  const test::TemporaryFolder folder;
  const auto data = image();
  data->GetFieldData()->AddArray(arrayOf("TimeValue", {2.5}));
  const vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  for (int i = 0; i < 12; ++i) {
    ghosts->InsertNextValue(i == 3 ? 2 : 0);
  }
  data->GetPointData()->AddArray(ghosts);
  const ReadField read = readThreat(written<vtkXMLImageDataWriter>(folder.path() / "a.vti", data.Get()),
                                    {{}, TimeUnit::millisecond, 'y', {}});
  EXPECT_TRUE(read.field.timed);
  EXPECT_DOUBLE_EQ(read.field.steps[0].time, 0.0025);
  EXPECT_TRUE(std::isnan(read.field.steps[0].values[0][3]));
  EXPECT_EQ(read.field.steps[0].values[0][4], 4.0F);
  ASSERT_EQ(read.issues.size(), 1U);
  EXPECT_EQ(read.issues[0].text, "1 of 12 points have no value");
}

TEST(ThreatVtk, PutsValuesOfCellsAtTheirMiddles) {
  const test::TemporaryFolder folder;
  const vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(3, 2, 2);
  grid->SetXCoordinates(arrayOf("x", {0.0, 1.0, 3.0}));
  grid->SetYCoordinates(arrayOf("y", {0.0, 2.0}));
  grid->SetZCoordinates(arrayOf("z", {-1.0, 1.0}));
  grid->GetCellData()->AddArray(arrayOf("p", {5.0, 7.0}));
  const ThreatField field = readThreat(written<vtkXMLRectilinearGridWriter>(folder.path() / "a.vtr", grid.Get())).field;
  ASSERT_TRUE(field.lattice);
  EXPECT_EQ(field.place(0, 0), Vec3d(0.5, 1.0, 0.0));
  EXPECT_EQ(field.place(0, 1), Vec3d(2.0, 1.0, 0.0));
  EXPECT_EQ(field.steps[0].values[0], (std::vector<float>{5.0F, 7.0F}));
}

vtkSmartPointer<vtkPolyData> cloud() {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  const vtkNew<vtkPoints> points;
  points->InsertNextPoint(1.0, 2.0, 3.0);
  points->InsertNextPoint(4.0, 5.0, 6.0);
  data->SetPoints(points);
  data->GetPointData()->AddArray(arrayOf("score", {3.0, 4.0}));
  data->GetPointData()->AddArray(arrayOf("v (m/s)", {1, 2, 3, 4, 5, 6}, 3));
  data->GetPointData()->AddArray(arrayOf("fragment_id", {8.0, 9.0}));
  return data;
}

TEST(ThreatVtk, ReadsPointsOfXmlAndLegacyFilesAlike) {
  const test::TemporaryFolder folder;
  for (const fs::path& path : {written<vtkXMLPolyDataWriter>(folder.path() / "a.vtp", cloud().Get()),
                               written<vtkDataSetWriter>(folder.path() / "a.vtk", cloud().Get())}) {
    const ThreatField field = readThreat(path, {{}, {}, 'z', {}}).field;
    EXPECT_FALSE(field.lattice);
    EXPECT_LT((field.place(0, 1) - Vec3d(4.0, 6.0, -5.0)).norm(), 1e-12) << path;
    EXPECT_EQ(field.steps[0].ids, (std::vector<std::int64_t>{8, 9}));
    ASSERT_TRUE(field.attributeNamed("v"));
    EXPECT_EQ(field.attributes[*field.attributeNamed("v")].unit, "m/s");
    EXPECT_EQ(field.steps[0].values[*field.attributeNamed("v")], (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(readThreat(path, {{}, {}, 'y', {"score"}}).field.attributes, (std::vector<Attribute>{{"score", "", 1}}));
  }
}

/// Writes a series of two images; the second with `time`.
fs::path series(const fs::path& folder, const std::string& time) {
  written<vtkXMLImageDataWriter>(folder / "a.vti", image().Get());
  written<vtkXMLImageDataWriter>(folder / "b.vti", image(100.0).Get());
  base::writeFileAtomically(folder / "s.pvd",
                            "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"1\" file=\"a.vti\"/>"
                            "<DataSet timestep=\"" +
                                time + "\" file=\"b.vti\"/></Collection></VTKFile>");
  return folder / "s.pvd";
}

TEST(ThreatVtk, ReadsASeries) {
  const test::TemporaryFolder folder;
  const fs::path path = series(folder.path(), "3");
  const ThreatField field = readThreat(path, {{}, TimeUnit::microsecond, 'y', {}}).field;
  ASSERT_EQ(field.steps.size(), 2U);
  EXPECT_TRUE(field.timed);
  EXPECT_DOUBLE_EQ(field.steps[1].time, 3e-6);
  const FieldSampler sampler(std::make_shared<const ThreatField>(field));
  EXPECT_NEAR(sampler.value({10.5, 20.0, 30.0}, 2e-6, 0).value(), 50.5, 1e-5);
  EXPECT_EQ(filesOfSeries(path), (std::vector<fs::path>{folder.path() / "a.vti", folder.path() / "b.vti"}));
  EXPECT_TRUE(filesOfSeries(folder.path() / "a.vti").empty());
}

TEST(ThreatVtk, RefusesASeriesThatDoesNotAgree) {
  const test::TemporaryFolder folder;
  const fs::path path = series(folder.path(), "1");
  EXPECT_NE(errorOf(path).find("s.pvd: entry 2: time 1 does not come after 1"), std::string::npos);
  EXPECT_NE(errorOf(series(folder.path(), "x")).find("entry 2: expected a time, found timestep=\"x\""),
            std::string::npos);
  series(folder.path(), "2");
  const auto other = image();
  other->SetSpacing(1.0, 2.0, 5.0);
  written<vtkXMLImageDataWriter>(folder.path() / "b.vti", other.Get());
  EXPECT_NE(errorOf(path).find("b.vti: has another grid"), std::string::npos);
  other->SetSpacing(1.0, 2.0, 4.0);
  other->GetPointData()->AddArray(arrayOf("q", std::vector<double>(12)));
  written<vtkXMLImageDataWriter>(folder.path() / "b.vti", other.Get());
  EXPECT_NE(errorOf(path).find("b.vti: has other arrays"), std::string::npos);
  fs::remove(folder.path() / "b.vti");
  EXPECT_NE(errorOf(path).find("b.vti: there is no such file"), std::string::npos);
  base::writeFileAtomically(path, "<VTKFile type=\"Collection\"><Collection></Collection></VTKFile>");
  EXPECT_NE(errorOf(path).find("names no file"), std::string::npos);
  base::writeFileAtomically(path, "<VTKFile");
  EXPECT_NE(errorOf(path).find("is not a collection"), std::string::npos);
}

TEST(ThreatVtk, RefusesWhatIsDamagedInASentence) {
  const test::TemporaryFolder folder;
  testing::internal::CaptureStderr();
  const fs::path good = written<vtkXMLImageDataWriter>(folder.path() / "a.vti", image().Get());
  const std::string bytes = base::readFile(good);
  for (const char* name : {"b.vti", "b.vtr", "b.vtp", "b.vtu", "b.vts", "b.vtk"}) {
    const fs::path path = folder.path() / name;
    base::writeFileAtomically(path, bytes.substr(0, bytes.size() / 3));
    EXPECT_NE(errorOf(path).find("cannot be read as a VTK file"), std::string::npos) << name;
    base::writeFileAtomically(path, "");
    EXPECT_NE(errorOf(path).find(name), std::string::npos);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "nothing of it is printed";
  EXPECT_NE(errorOf(folder.path() / "none.vti").find("there is no such file"), std::string::npos);
  EXPECT_NE(errorOf(folder.path() / "a.stl").find("is no threat data by its name"), std::string::npos);
  EXPECT_NE(errorOf(good, {{}, {}, 'y', {"q"}}).find("has no array \"q\"; it has p"), std::string::npos);
}

TEST(ThreatVtk, RefusesNumbersThatAreNone) {
  const test::TemporaryFolder folder;
  const auto data = cloud();
  data->GetPointData()->AddArray(arrayOf("p", {1.0, std::nan("")}));
  EXPECT_NE(errorOf(written<vtkXMLPolyDataWriter>(folder.path() / "a.vtp", data.Get()))
                .find("array p, entry 1: expected a finite number, found nan"),
            std::string::npos);
  data->GetPointData()->AddArray(arrayOf("p", {1.0, 1e300}));
  EXPECT_NE(errorOf(written<vtkXMLPolyDataWriter>(folder.path() / "a.vtp", data.Get())).find("array p, entry 1"),
            std::string::npos);
  const auto grid = image();
  grid->SetSpacing(1.0, 0.0, 1.0);
  EXPECT_NE(errorOf(written<vtkXMLImageDataWriter>(folder.path() / "a.vti", grid.Get())).find("do not rise"),
            std::string::npos);
}

TEST(ThreatVtk, ReadsAHydrocodesGrid) {
  LORICA_NEEDS_REAL_DATA("cth-plate/cth.vtr");
  const ReadField read =
      readThreat(test::realData() / "cth-plate/cth.vtr", {base::LengthUnit::centimetre, {}, 'y', {}});
  ASSERT_TRUE(read.field.lattice);
  EXPECT_EQ(read.field.lattice->points(), 128U * 64U * 64U);
  EXPECT_GE(read.field.attributes.size(), 5U);
}

}  // namespace
}  // namespace lorica::threat
