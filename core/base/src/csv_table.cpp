#include "lorica/base/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "lorica/base/error.h"

namespace lorica::base {

namespace {

/// Takes one field off the front of `text`; what follows is a comma, a line end or nothing.
std::string takeField(std::string_view& text) {
  std::string field;
  if (!text.starts_with('"')) {
    const std::size_t end = std::min(text.find_first_of(",\r\n"), text.size());
    field = text.substr(0, end);
    text.remove_prefix(end);
    return field;
  }
  text.remove_prefix(1);
  while (!text.empty()) {
    const std::size_t quote = std::min(text.find('"'), text.size());
    field += text.substr(0, quote);
    text.remove_prefix(std::min(quote + 1, text.size()));
    if (!text.starts_with('"')) {
      break;
    }
    field += '"';
    text.remove_prefix(1);
  }
  return field;
}

std::vector<std::string> takeLine(std::string_view& text) {
  std::vector<std::string> fields;
  while (true) {
    fields.push_back(takeField(text));
    if (!text.starts_with(',')) {
      break;
    }
    text.remove_prefix(1);
  }
  const std::size_t end = text.find('\n');
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return fields;
}

std::string line(std::size_t row) {
  return fmt::format("line {}", row + 2);
}

}  // namespace

CsvTable::CsvTable(std::string_view text) {
  if (!text.empty()) {
    columns_ = takeLine(text);
  }
  while (!text.empty()) {
    rows_.push_back(takeLine(text));
    if (rows_.back().size() != columns_.size()) {
      throw InputError("", line(rows_.size() - 1),
                       fmt::format("{} fields where the header has {}", rows_.back().size(), columns_.size()));
    }
  }
}

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  LORICA_CHECK(found != columns_.end() && row < rows_.size(), "the table has the row and the column");
  return rows_[row][static_cast<std::size_t>(found - columns_.begin())];
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  const std::string& field = text(row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    throw InputError("", fmt::format("{}, {}", line(row), column),
                     fmt::format("expected a number, found \"{}\"", field));
  }
  return value;
}

}  // namespace lorica::base
