#include "read_vtk.h"

#include <fmt/format.h>
#include <vtkCellCenters.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDataSetReader.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <new>
#include <sstream>

#include "column_names.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::threat {

namespace fs = std::filesystem;

namespace {

/// Keeps the first error of a reader, and keeps it off the terminal.
class ErrorKeeper : public vtkCommand {
 public:
  static ErrorKeeper* New() { return new ErrorKeeper; }  // NOLINT(cppcoreguidelines-owning-memory): VTK counts
  void Execute(vtkObject*, unsigned long event, void* data) override {
    if (event == vtkCommand::ErrorEvent && first_.empty()) {
      first_ = data != nullptr ? static_cast<const char*>(data) : "error";
    }
  }
  bool failed() const { return !first_.empty(); }
  /// The reader's words, in one line, without its own places.
  std::string words() const {
    std::string text = first_;
    const std::size_t begin = text.find("): ");
    text = begin == std::string::npos ? text : text.substr(begin + 3);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.substr(0, std::min<std::size_t>(text.find_last_not_of(' ') + 1, 200));
  }

 private:
  std::string first_;
};

template <class Reader>
vtkSmartPointer<vtkDataSet> outputOf(Reader* reader, const fs::path& path) {
  vtkNew<ErrorKeeper> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  if constexpr (std::is_base_of_v<vtkXMLReader, Reader>) {
    reader->SetReaderErrorObserver(errors);
    reader->SetParserErrorObserver(errors);
  }
  reader->SetFileName(path.c_str());
  vtkSmartPointer<vtkDataSet> data;
  try {
    if constexpr (std::is_same_v<Reader, vtkDataSetReader>) {
      // VTK warns past every observer when it has no idea what the file holds.
      if (reader->ReadOutputType() < 0) {
        throw base::InputError(path.string(), "",
                               "cannot be read as a VTK file (it says no known kind of data); write it again");
      }
    }
    reader->Update();
    data = reader->GetOutput();
  } catch (const std::bad_alloc&) {
    throw base::InputError(path.string(), "", "asks for more memory than there is; it is too large or damaged");
  }
  if (errors->failed() || data == nullptr) {
    throw base::InputError(path.string(), "", "cannot be read as a VTK file (" + errors->words() + "); write it again");
  }
  return data;
}

vtkSmartPointer<vtkDataSet> readDataSet(const fs::path& path) {
  // VTK's own words for a file that is not there are no help.
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) {
    throw base::InputError(path.string(), "", "there is no such file; put it back or correct the path");
  }
  const std::string ending = lowerCase(path.extension().string());
  if (ending == ".vti") {
    return outputOf(vtkNew<vtkXMLImageDataReader>().Get(), path);
  }
  if (ending == ".vtr") {
    return outputOf(vtkNew<vtkXMLRectilinearGridReader>().Get(), path);
  }
  if (ending == ".vts") {
    return outputOf(vtkNew<vtkXMLStructuredGridReader>().Get(), path);
  }
  if (ending == ".vtp") {
    return outputOf(vtkNew<vtkXMLPolyDataReader>().Get(), path);
  }
  if (ending == ".vtu") {
    return outputOf(vtkNew<vtkXMLUnstructuredGridReader>().Get(), path);
  }
  const vtkNew<vtkDataSetReader> reader;
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllFieldsOn();
  return outputOf(reader.Get(), path);
}

double inMetres(double value, double metres, const std::string& file) {
  constexpr double widest = 1e5;
  if (!(std::abs(value * metres) < widest)) {
    throw base::InputError(file, "",
                           fmt::format("has a point at {}; expected places within 100 km, in the unit given", value));
  }
  return value * metres;
}

/// Planes of an axis, of the middles between them when the values are the cells'.
std::vector<double> planesOf(const std::vector<double>& planes, bool cells, double metres, const std::string& file) {
  std::vector<double> result;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double plane = inMetres(planes[i], metres, file);
    if (!result.empty() && !(plane > inMetres(planes[i - 1], metres, file))) {
      throw base::InputError(file, "", "has planes of its grid that do not rise along an axis; sort them");
    }
    result.push_back(plane);
  }
  if (cells && result.size() > 1) {
    for (std::size_t i = 0; i + 1 < result.size(); ++i) {
      result[i] = 0.5 * (result[i] + result[i + 1]);
    }
    result.pop_back();
  }
  return result;
}

std::vector<double> numbersOf(vtkDataArray* array) {
  std::vector<double> numbers(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
  }
  return numbers;
}

/// The lattice of an image or a rectilinear grid; nothing for other data.
std::optional<Lattice> latticeOf(vtkDataSet* data, bool cells, double metres, const std::string& file) {
  std::array<std::vector<double>, 3> planes;
  if (auto* image = vtkImageData::SafeDownCast(data)) {
    if (!image->GetDirectionMatrix()->IsIdentity()) {
      throw base::InputError(file, "",
                             "has axes that are turned; expected them along x, y and z: write it without a direction "
                             "matrix and turn it by the placement in the study");
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = image->GetExtent()[2 * axis]; i <= image->GetExtent()[2 * axis + 1]; ++i) {
        planes.at(static_cast<std::size_t>(axis)).push_back(image->GetOrigin()[axis] + i * image->GetSpacing()[axis]);
      }
    }
  } else if (auto* grid = vtkRectilinearGrid::SafeDownCast(data)) {
    planes = {numbersOf(grid->GetXCoordinates()), numbersOf(grid->GetYCoordinates()),
              numbersOf(grid->GetZCoordinates())};
  } else {
    return std::nullopt;
  }
  Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lattice.axes.at(axis) = planesOf(planes.at(axis), cells, metres, file);
  }
  return lattice;
}

geometry::Positions pointsOf(vtkDataSet* data, double metres, const std::string& file) {
  geometry::Positions points(static_cast<std::size_t>(data->GetNumberOfPoints()));
  std::array<double, 3> at{};
  for (std::size_t p = 0; p < points.size(); ++p) {
    data->GetPoint(static_cast<vtkIdType>(p), at.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[p][static_cast<Eigen::Index>(axis)] = static_cast<float>(inMetres(at.at(axis), metres, file));
    }
  }
  return points;
}

/// Values of one array; what is not a number is let through where it may stand for "no value".
std::vector<float> valuesOf(vtkDataArray* array, bool mayMiss, vtkUnsignedCharArray* ghosts, int hidden,
                            const std::string& file, std::size_t& missing) {
  const auto tuples = static_cast<std::size_t>(array->GetNumberOfTuples());
  const auto width = static_cast<std::size_t>(array->GetNumberOfComponents());
  std::vector<float> values(tuples * width);
  for (std::size_t p = 0; p < tuples; ++p) {
    const auto tuple = static_cast<vtkIdType>(p);
    const bool blank = ghosts != nullptr && (ghosts->GetValue(tuple) & hidden) != 0;
    bool lacking = blank;
    for (std::size_t k = 0; k < width; ++k) {
      const double value = array->GetComponent(tuple, static_cast<int>(k));
      lacking = lacking || std::isnan(value);
      if ((std::isnan(value) && !mayMiss) || std::abs(value) > std::numeric_limits<float>::max()) {
        throw base::InputError(
            file, fmt::format("array {}, entry {}", array->GetName(), p),
            fmt::format("expected a finite number, found {}; remove the point or give it a value", value));
      }
      values[p * width + k] = static_cast<float>(value);
    }
    if (lacking) {
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(p * width), width,
                  std::numeric_limits<float>::quiet_NaN());
      ++missing;
    }
  }
  return values;
}

std::vector<std::int64_t> idsOf(vtkDataArray* array, const std::string& file) {
  std::vector<std::int64_t> ids;
  for (const double value : numbersOf(array)) {
    if (!(std::abs(value) <= 0x1p53 && std::floor(value) == value)) {
      throw base::InputError(file, fmt::format("array {}", array->GetName()),
                             fmt::format("expected whole numbers as ids, found {}", value));
    }
    ids.push_back(static_cast<std::int64_t>(value));
  }
  return ids;
}

class ArrayReader {
 public:
  ArrayReader(vtkDataSetAttributes* arrays, bool cells, std::string file, const ReadOptions& options)
      : arrays_(arrays), cells_(cells), file_(std::move(file)), options_(&options) {}

  void readInto(ReadField& read) const {
    Step& step = read.field.steps.front();
    auto* ghosts = vtkUnsignedCharArray::SafeDownCast(arrays_->GetAbstractArray("vtkGhostType"));
    const int hidden = cells_ ? static_cast<int>(vtkDataSetAttributes::HIDDENCELL)
                              : static_cast<int>(vtkDataSetAttributes::HIDDENPOINT);
    const auto points = static_cast<vtkIdType>(read.field.points(0));
    for (int a = 0; a < arrays_->GetNumberOfArrays(); ++a) {
      vtkDataArray* array = arrays_->GetArray(a);
      if (array == nullptr || array->GetName() == nullptr || array == ghosts) {
        continue;
      }
      const ColumnName name = columnName(array->GetName());
      if (array->GetNumberOfTuples() != points) {
        throw base::InputError(
            file_, "array " + std::string(array->GetName()),
            fmt::format("expected {} values, found {}; write the file again", points, array->GetNumberOfTuples()));
      }
      if (isIdName(name.name) && array->GetNumberOfComponents() == 1 && !read.field.lattice) {
        step.ids = idsOf(array, file_);
      } else if (wanted(name.name)) {
        take(array, name, ghosts, hidden, read);
      }
    }
    requireWanted(read.field);
  }

 private:
  bool wanted(const std::string& name) const {
    const std::vector<std::string>& names = options_->attributes;
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  }

  void take(vtkDataArray* array, const ColumnName& name, vtkUnsignedCharArray* ghosts, int hidden,
            ReadField& read) const {
    const int width = array->GetNumberOfComponents();
    if (width != 1 && width != 3) {
      read.issues.push_back({base::Severity::warning, file_, "array " + std::string(array->GetName()),
                             fmt::format("has {} numbers a point and is left out; expected 1 or 3", width)});
      return;
    }
    std::size_t missing = 0;
    std::vector<float> values =
        valuesOf(array, read.field.lattice.has_value(), read.field.lattice ? ghosts : nullptr, hidden, file_, missing);
    if (missing > 0) {
      read.issues.push_back({base::Severity::note, file_, "array " + std::string(array->GetName()),
                             fmt::format("{} of {} points have no value", missing, read.field.points(0))});
    }
    read.field.attributes.push_back({name.name, name.unit, static_cast<std::size_t>(width)});
    read.field.steps.front().values.push_back(std::move(values));
  }

  void requireWanted(const ThreatField& field) const {
    for (const std::string& name : options_->attributes) {
      if (!field.attributeNamed(name)) {
        std::vector<std::string> known;
        for (int a = 0; a < arrays_->GetNumberOfArrays(); ++a) {
          known.push_back(columnName(arrays_->GetArrayName(a) != nullptr ? arrays_->GetArrayName(a) : "").name);
        }
        throw base::InputError(file_, "",
                               fmt::format("has no array \"{}\"; it has {}", name,
                                           known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
      }
    }
  }

  vtkDataSetAttributes* arrays_;
  bool cells_;
  std::string file_;
  const ReadOptions* options_;
};

std::optional<double> timeOf(vtkDataSet* data, const std::string& file) {
  for (const char* name : {"TimeValue", "TIME"}) {
    vtkDataArray* array = data->GetFieldData()->GetArray(name);
    if (array != nullptr && array->GetNumberOfTuples() > 0) {
      const double time = array->GetComponent(0, 0);
      if (!std::isfinite(time)) {
        throw base::InputError(file, std::string("field array ") + name, "expected a finite time");
      }
      return time;
    }
  }
  return std::nullopt;
}

}  // namespace

ReadField readVtk(const fs::path& path, const ReadOptions& options) {
  const std::string file = path.string();
  vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  const bool cells = data->GetPointData()->GetNumberOfArrays() == 0 && data->GetCellData()->GetNumberOfArrays() > 0;
  if (data->GetNumberOfPoints() == 0 || (cells && data->GetNumberOfCells() == 0)) {
    throw base::InputError(file, "", "holds no points; write it again with data");
  }
  if (data->GetNumberOfPoints() > std::numeric_limits<std::uint32_t>::max()) {
    throw base::InputError(file, "", "holds more than 4294967295 points; cut it");
  }
  const double metres = base::metresPer(options.units.value_or(base::LengthUnit::metre));
  ReadField read;
  read.field.lattice = latticeOf(data, cells, metres, file);
  Step& step = read.field.steps.emplace_back();
  if (const std::optional<double> time = timeOf(data, file)) {
    read.field.timed = true;
    step.time = *time * secondsPer(options.timeUnits.value_or(TimeUnit::second));
  }
  if (!read.field.lattice && cells) {
    const vtkNew<vtkCellCenters> centres;
    centres->SetInputData(data);
    centres->Update();
    data = centres->GetOutput();
  }
  if (!read.field.lattice) {
    step.points = std::make_shared<const geometry::Positions>(pointsOf(data, metres, file));
  }
  const bool fromCells = cells && read.field.lattice;
  if (!cells && data->GetCellData()->GetNumberOfArrays() > 0) {
    read.issues.push_back({base::Severity::note, file, "",
                           "has values of points and of cells; those of cells are left "
                           "out"});
  }
  vtkDataSetAttributes* arrays = fromCells ? static_cast<vtkDataSetAttributes*>(data->GetCellData())
                                           : static_cast<vtkDataSetAttributes*>(data->GetPointData());
  ArrayReader(arrays, fromCells, file, options).readInto(read);
  return read;
}

std::vector<SeriesEntry> readSeries(const fs::path& path) {
  const std::string text = base::readFile(path);
  const std::string file = path.string();
  const vtkNew<vtkXMLDataParser> parser;
  const vtkNew<ErrorKeeper> errors;
  parser->AddObserver(vtkCommand::ErrorEvent, errors);
  parser->AddObserver(vtkCommand::WarningEvent, errors);
  std::istringstream stream(text);
  parser->SetStream(&stream);
  const bool parsed = parser->Parse() != 0;
  vtkXMLDataElement* root = parsed ? parser->GetRootElement() : nullptr;
  vtkXMLDataElement* list = root != nullptr ? root->FindNestedElementWithName("Collection") : nullptr;
  if (list == nullptr || errors->failed()) {
    throw base::InputError(file, "", "is not a collection of VTK files; expected <VTKFile type=\"Collection\">");
  }
  std::vector<SeriesEntry> entries;
  for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = list->GetNestedElement(i);
    const std::string place = fmt::format("entry {}", i + 1);
    const char* name = element->GetAttribute("file");
    const char* written = element->GetAttribute("timestep");
    const std::string_view number = written != nullptr ? written : "";
    SeriesEntry entry;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), entry.time);
    if (name == nullptr || *name == '\0') {
      throw base::InputError(file, place, "names no file; expected file=\"...\"");
    }
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(entry.time)) {
      throw base::InputError(file, place, fmt::format("expected a time, found timestep=\"{}\"", number));
    }
    if (!entries.empty() && !(entry.time > entries.back().time)) {
      throw base::InputError(file, place,
                             fmt::format("time {} does not come after {}; sort the files, one for each time",
                                         entry.time, entries.back().time));
    }
    entry.file = (path.parent_path() / name).lexically_normal();
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) {
    throw base::InputError(file, "", "names no file; expected an entry for each time");
  }
  return entries;
}

}  // namespace lorica::threat
