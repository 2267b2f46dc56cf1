#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "column_names.h"
#include "field_builder.h"
#include "lorica/base/error.h"
#include "lorica/threat/read_threat.h"

namespace lorica::threat {

namespace {

std::string_view trimmed(std::string_view text) {
  const char* blank = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

/// The lines of a text that say something, one after the other, and where an error is.
class Lines {
 public:
  Lines(std::string_view text, const std::string& name) : whole_(text.size()), rest_(text), name_(&name) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8
    if (rest_.starts_with(mark)) {
      rest_.remove_prefix(mark.size());
    }
  }
  /// The next line that is neither blank nor a remark; false at the end.
  bool next(std::string_view& line) {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      const std::size_t begin = line.find_first_not_of(" \t\r,;");
      if (begin != std::string_view::npos && line[begin] != '#') {
        return true;
      }
    }
    return false;
  }
  double share() const {
    return 1.0 - static_cast<double>(rest_.size()) / static_cast<double>(std::max<std::size_t>(1, whole_));
  }
  std::size_t left() const { return rest_.size(); }
  [[noreturn]] void fail(const std::string& column, const std::string& text) const {
    throw base::InputError(
        *name_, fmt::format("line {}{}", std::max<std::size_t>(1, number_), column.empty() ? "" : ", column " + column),
        text);
  }

 private:
  std::size_t whole_;
  std::string_view rest_;
  const std::string* name_;
  std::size_t number_ = 0;
};

/// What a column is for.
enum class Role { x, y, z, time, id, value, ignored };

struct Column {
  std::string header;  ///< as the file has it
  ColumnName name;
  Role role = Role::value;
  std::size_t attribute = 0;  ///< of role value
  std::size_t component = 0;
};

struct Header {
  char separator = ',';
  std::vector<Column> columns;
  std::vector<Attribute> attributes;
  double metres = 1.0;
  double seconds = 1.0;
  bool timed = false;
  bool withIds = false;
};

char separatorOf(std::string_view line) {
  char best = ',';
  for (const char candidate : {',', ';', '\t'}) {
    if (std::count(line.begin(), line.end(), candidate) > std::count(line.begin(), line.end(), best)) {
      best = candidate;
    }
  }
  return best;
}

Role roleOf(const ColumnName& name) {
  const std::string lower = lowerCase(name.name);
  if (lower == "x") {
    return Role::x;
  }
  if (lower == "y") {
    return Role::y;
  }
  if (lower == "z") {
    return Role::z;
  }
  if (lower == "t" || lower == "time") {
    return Role::time;
  }
  return isIdName(lower) ? Role::id : Role::value;
}

/// The stem of a component's name: "velocity_x" gives "velocity"; empty when the name does not end so.
std::string stemOf(const std::string& name, char axis) {
  const std::string lower = lowerCase(name);
  return lower.size() > 2 && lower.ends_with(std::string("_") + axis) ? name.substr(0, name.size() - 2) : "";
}

/// Makes attributes of the columns of role value, three that follow each other to a vector.
void findAttributes(Header& header, const ReadOptions& options) {
  const auto wanted = [&](const std::string& name) {
    return options.attributes.empty() ||
           std::find(options.attributes.begin(), options.attributes.end(), name) != options.attributes.end();
  };
  std::vector<Column>& columns = header.columns;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].role != Role::value) {
      continue;
    }
    const std::string stem = stemOf(columns[c].name.name, 'x');
    const bool vector = !stem.empty() && c + 2 < columns.size() && stemOf(columns[c + 1].name.name, 'y') == stem &&
                        stemOf(columns[c + 2].name.name, 'z') == stem;
    const std::string name = vector ? stem : columns[c].name.name;
    const std::size_t width = vector ? 3 : 1;
    for (std::size_t k = 0; k < width; ++k) {
      Column& column = columns[c + k];
      column.role = wanted(name) ? Role::value : Role::ignored;
      column.attribute = header.attributes.size();
      column.component = k;
    }
    if (wanted(name)) {
      header.attributes.push_back({name, columns[c].name.unit, width});
    }
    c += width - 1;
  }
}

void checkHeader(const Lines& lines, const Header& header, const ReadOptions& options) {
  const auto count = [&](Role role) {
    return std::count_if(header.columns.begin(), header.columns.end(),
                         [&](const Column& column) { return column.role == role; });
  };
  for (const auto& [role, name] : {std::pair{Role::x, "x"}, {Role::y, "y"}, {Role::z, "z"}}) {
    if (count(role) != 1) {
      lines.fail("",
                 fmt::format("expected one column {0} (or {0}_mm and the like), found {1}; the first line names the "
                             "columns",
                             name, count(role)));
    }
  }
  if (count(Role::time) > 1 || count(Role::id) > 1) {
    lines.fail("", "expected at most one column of times and one of ids; remove the others");
  }
  for (const std::string& name : options.attributes) {
    if (std::none_of(header.attributes.begin(), header.attributes.end(),
                     [&](const Attribute& known) { return known.name == name; })) {
      std::vector<std::string> known;
      for (const Column& column : header.columns) {
        if (column.role == Role::ignored || column.role == Role::value) {
          known.push_back(column.name.name);
        }
      }
      lines.fail("",
                 fmt::format("has no column \"{}\"; it has {}", name,
                             known.empty() ? "none but those of places" : fmt::format("{}", fmt::join(known, ", "))));
    }
  }
  for (std::size_t a = 0; a < header.attributes.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (header.attributes[a].name == header.attributes[b].name) {
        lines.fail("", fmt::format("the name \"{}\" stands here twice; rename one column", header.attributes[a].name));
      }
    }
  }
}

/// Metres in the unit of the places.
double metresOf(const Lines& lines, const Header& header, const ReadOptions& options) {
  std::optional<base::LengthUnit> units;
  for (const Column& column : header.columns) {
    if ((column.role != Role::x && column.role != Role::y && column.role != Role::z) || column.name.unit.empty()) {
      continue;
    }
    const std::optional<base::LengthUnit> own = lengthUnit(column.name.unit);
    if (!own) {
      lines.fail(column.header,
                 fmt::format("expected m, cm, mm or in as the unit of a place, found \"{}\"", column.name.unit));
    }
    if (options.units && *options.units != *own) {
      lines.fail(column.header, fmt::format("is in {}, but {} was asked for; give the unit once", column.name.unit,
                                            base::name(*options.units)));
    }
    if (units && *units != *own) {
      lines.fail(column.header, fmt::format("is in {}, but another coordinate is in {}; use one unit for all three",
                                            column.name.unit, base::name(*units)));
    }
    units = own;
  }
  return base::metresPer(units ? *units : options.units.value_or(base::LengthUnit::metre));
}

double secondsOf(const Lines& lines, const Header& header, const ReadOptions& options) {
  for (const Column& column : header.columns) {
    if (column.role != Role::time || column.name.unit.empty()) {
      continue;
    }
    const std::optional<TimeUnit> own = timeUnit(column.name.unit);
    if (!own) {
      lines.fail(column.header,
                 fmt::format("expected s, ms or us as the unit of time, found \"{}\"", column.name.unit));
    }
    if (options.timeUnits && *options.timeUnits != *own) {
      lines.fail(column.header, "says another unit of time than was asked for; give the unit once");
    }
    return secondsPer(*own);
  }
  return secondsPer(options.timeUnits.value_or(TimeUnit::second));
}

Header readHeader(Lines& lines, const ReadOptions& options) {
  std::string_view line;
  if (!lines.next(line)) {
    lines.fail("", "is empty; expected a line with the names of the columns and a line for each point");
  }
  Header header;
  header.separator = separatorOf(line);
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(header.separator, begin), line.size());
    Column column;
    column.header = std::string(trimmed(line.substr(begin, end - begin)));
    column.name = columnName(column.header);
    column.role = roleOf(column.name);
    if (column.name.name.empty()) {
      lines.fail(
          "", fmt::format("the {}. column has no name; the first line names the columns", header.columns.size() + 1));
    }
    header.columns.push_back(std::move(column));
    begin = end + 1;
  }
  findAttributes(header, options);
  checkHeader(lines, header, options);
  header.metres = metresOf(lines, header, options);
  header.seconds = secondsOf(lines, header, options);
  for (const Column& column : header.columns) {
    header.timed = header.timed || column.role == Role::time;
    header.withIds = header.withIds || column.role == Role::id;
  }
  return header;
}

template <class Number>
Number numberOf(const Lines& lines, std::string_view field, const Column& column, const char* what) {
  if (field.starts_with('+')) {
    field.remove_prefix(1);
  }
  Number value{};
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  bool good = error == std::errc() && end == field.data() + field.size() && !field.empty();
  if constexpr (std::is_floating_point_v<Number>) {
    good = good && std::isfinite(value) && std::abs(value) <= std::numeric_limits<float>::max();
  }
  if (!good) {
    lines.fail(column.header, fmt::format("expected {}, found {}", what,
                                          field.empty() ? "nothing" : "\"" + std::string(field.substr(0, 40)) + "\""));
  }
  return value;
}

class RowReader {
 public:
  RowReader(const Lines& lines, const Header& header, std::size_t expected) : lines_(&lines), header_(&header) {
    rows_.attributes = header.attributes;
    rows_.places.reserve(expected);
    rows_.times.reserve(header.timed ? expected : 0);
    rows_.ids.reserve(header.withIds ? expected : 0);
    for (const Attribute& attribute : header.attributes) {
      rows_.values.emplace_back().reserve(expected * attribute.components);
    }
  }

  void read(std::string_view line) {
    std::size_t begin = 0;
    geometry::Vec3d place = geometry::Vec3d::Zero();
    for (std::size_t c = 0; c < header_->columns.size(); ++c) {
      if (begin > line.size()) {
        lines_->fail("", fmt::format("expected {} fields, found {}", header_->columns.size(), c));
      }
      const std::size_t end = std::min(line.find(header_->separator, begin), line.size());
      take(header_->columns[c], trimmed(line.substr(begin, end - begin)), place);
      begin = end + 1;
    }
    if (begin <= line.size() && !trimmed(line.substr(begin)).empty()) {
      lines_->fail("", fmt::format("expected {} fields, found more", header_->columns.size()));
    }
    rows_.places.push_back((header_->metres * place).cast<float>());
  }

  PointRows take() { return std::move(rows_); }
  std::size_t count() const { return rows_.places.size(); }

 private:
  void take(const Column& column, std::string_view field, geometry::Vec3d& place) {
    switch (column.role) {
      case Role::x:
      case Role::y:
      case Role::z: {
        const double value = numberOf<double>(*lines_, field, column, "a number");
        constexpr double widest = 1e5;
        if (!(std::abs(value * header_->metres) < widest)) {
          lines_->fail(column.header, fmt::format("{} is more than 100 km away; move the data near the body", value));
        }
        place[static_cast<Eigen::Index>(column.role)] = value;
        break;
      }
      case Role::time:
        rows_.times.push_back(numberOf<double>(*lines_, field, column, "a time") * header_->seconds);
        break;
      case Role::id:
        rows_.ids.push_back(numberOf<std::int64_t>(*lines_, field, column, "a whole number"));
        break;
      case Role::value:
        rows_.values[column.attribute].push_back(
            static_cast<float>(numberOf<double>(*lines_, field, column, "a number")));
        break;
      case Role::ignored:
        break;
    }
  }

  const Lines* lines_;
  const Header* header_;
  PointRows rows_;
};

}  // namespace

ReadField readThreatCsv(std::string_view csv, const std::string& name, const ReadOptions& options,
                        const base::Progress& progress) {
  Lines lines(csv, name);
  const Header header = readHeader(lines, options);
  const std::string_view body = csv.substr(csv.size() - lines.left());
  RowReader reader(lines, header, static_cast<std::size_t>(std::count(body.begin(), body.end(), '\n')) + 1);
  std::string_view line;
  while (lines.next(line)) {
    reader.read(line);
    if (reader.count() % 65536 == 0) {
      progress.check();
      progress.report(0.7 * lines.share());
    }
  }
  if (reader.count() == 0) {
    lines.fail("", "holds no points; expected a line for each after the names of the columns");
  }
  if (reader.count() > std::numeric_limits<std::uint32_t>::max()) {
    lines.fail("", "holds more than 4294967295 points; cut the file");
  }
  ReadField read;
  read.field = fieldOf(reader.take(), name, read.issues, progress.part(0.7, 1.0));
  read.field.placement.rotation = uprighting(options.up);
  return read;
}

}  // namespace lorica::threat
