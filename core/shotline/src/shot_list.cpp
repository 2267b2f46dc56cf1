#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "lorica/base/error.h"
#include "lorica/base/units.h"
#include "lorica/shotline/source.h"

namespace lorica::shotline {

using geometry::Vec3d;

namespace {

std::string_view trimmed(std::string_view text) {
  const char* blank = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

/// The lines of a text, one after the other, and where an error is.
class Lines {
 public:
  Lines(std::string_view text, const std::string& name) : rest_(text), name_(&name) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8
    if (rest_.starts_with(mark)) {
      rest_.remove_prefix(mark.size());
    }
  }
  /// The next line that is not blank; false at the end.
  bool next(std::string_view& line) {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!line.empty()) {
        return true;
      }
    }
    return false;
  }
  [[noreturn]] void fail(const std::string& text) const {
    throw base::InputError(*name_, fmt::format("line {}", std::max<std::size_t>(1, number_)), text);
  }

 private:
  std::string_view rest_;
  const std::string* name_;
  std::size_t number_ = 0;
};

constexpr std::array<std::string_view, 6> byDirection{"x", "y", "z", "dx", "dy", "dz"};
constexpr std::array<std::string_view, 5> byAngles{"x", "y", "z", "az", "el"};

/// The columns of a list of shots; none for those of something else.
std::span<const std::string_view> columnsOf(const std::vector<std::string_view>& header) {
  for (const std::span<const std::string_view> known :
       {std::span<const std::string_view>(byDirection), std::span<const std::string_view>(byAngles)}) {
    if (std::equal(header.begin(), header.end(), known.begin(), known.end())) {
      return known;
    }
  }
  return {};
}

double numberOf(const Lines& lines, std::string_view field, std::string_view column) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  constexpr double widest = 1e5;
  if (error != std::errc() || end != field.data() + field.size() || !(std::abs(value) < widest)) {
    lines.fail(fmt::format("expected a number of size below 1e5 in column {}, found \"{}\"", column, field));
  }
  return value;
}

raycast::Ray rayOf(const Lines& lines, const std::array<double, 6>& value, bool angles) {
  const Vec3d origin(value[0], value[1], value[2]);
  if (!angles) {
    const Vec3d direction(value[3], value[4], value[5]);
    const double length = direction.norm();
    if (!(length > 1e-12)) {
      lines.fail("the direction dx,dy,dz has no length; say where the shot goes");
    }
    return {origin.cast<float>(), Vec3d(direction / length).cast<float>()};
  }
  if (std::abs(value[3]) > 360.0) {
    lines.fail(fmt::format("expected an azimuth from -360 to 360 degrees, found {}", value[3]));
  }
  if (std::abs(value[4]) > 90.0) {
    lines.fail(fmt::format("expected an elevation from -90 to 90 degrees, found {}", value[4]));
  }
  return {origin.cast<float>(), Vec3d(-towards(base::radians(value[3]), base::radians(value[4]))).cast<float>()};
}

}  // namespace

ShotList readShotList(std::string_view csv, const std::string& name) {
  Lines lines(csv, name);
  std::string_view line;
  if (!lines.next(line)) {
    lines.fail("is empty; expected a line x,y,z,dx,dy,dz or x,y,z,az,el and a line for each shot");
  }
  const std::vector<std::string_view> header = fieldsOf(line);
  const std::size_t columns = columnsOf(header).size();
  if (columns == 0) {
    lines.fail(fmt::format("expected the columns x,y,z,dx,dy,dz or x,y,z,az,el, found \"{}\"", line));
  }
  const bool angles = columns == byAngles.size();
  auto rays = std::make_shared<std::vector<raycast::Ray>>();
  while (lines.next(line)) {
    const std::vector<std::string_view> fields = fieldsOf(line);
    if (fields.size() != columns) {
      lines.fail(fmt::format("expected {} fields, found {}", columns, fields.size()));
    }
    std::array<double, 6> value{};
    for (std::size_t f = 0; f < columns; ++f) {
      value.at(f) = numberOf(lines, fields[f], header[f]);
    }
    rays->push_back(rayOf(lines, value, angles));
  }
  if (rays->empty()) {
    lines.fail("holds no shots; expected a line for each after the names of the columns");
  }
  return {std::move(rays)};
}

bool isShotList(std::string_view csv) {
  const std::string name;
  Lines lines(csv, name);
  std::string_view line;
  return lines.next(line) && !columnsOf(fieldsOf(line)).empty();
}

}  // namespace lorica::shotline
