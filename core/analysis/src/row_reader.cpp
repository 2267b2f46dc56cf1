#include "row_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::analysis {

namespace {

/// A table of the file. What is wrong with its text is always that it is not as the run wrote it.
base::Table tableOf(const std::filesystem::path& file) {
  const std::string text = base::readFile(file);
  if (!text.empty() && text.back() != '\n') {
    throw base::InputError(file.string(), fmt::format("line {}", 1 + std::count(text.begin(), text.end(), '\n')),
                           "ends before its line does; the file is cut, so run the study again");
  }
  try {
    return {text, file.string()};
  } catch (const base::InputError& error) {
    throw base::InputError(error.file(), error.place(), error.text() + "; the file is damaged, so run the study again");
  }
}

}  // namespace

RowReader::RowReader(const std::filesystem::path& file, std::initializer_list<const char*> columns)
    : file_(file.string()), table_(tableOf(file)) {
  for (const char* column : columns) {
    if (!table_.has(column)) {
      throw base::InputError(file_, "line 1",
                             fmt::format("there is no column '{}', as a run writes it; run the study again", column));
    }
  }
}

std::optional<double> RowReader::maybe(std::string_view column) const {
  return text(column).empty() ? std::nullopt : std::optional(number(column));
}

std::optional<double> RowReader::share(std::string_view column) const {
  const std::optional<double> value = maybe(column);
  if (value && (*value < 0.0 || *value > 1.0)) {
    fail(fmt::format("expected a share from 0 to 1 in column '{}', found '{}'", column, text(column)));
  }
  return value;
}

std::uint64_t RowReader::whole(std::string_view column) const {
  const double value = number(column);
  constexpr double most = 0x1p53;
  if (value != std::floor(value) || value < 0.0 || value > most) {
    fail(fmt::format("expected a whole number from 0 in column '{}', found '{}'", column, text(column)));
  }
  return static_cast<std::uint64_t>(value);
}

std::uint64_t RowReader::atMost(std::string_view column, std::uint64_t limit, std::string_view limitColumn) const {
  const std::uint64_t value = whole(column);
  if (value > limit) {
    fail(fmt::format("'{}' is {}, more than '{}', which is {}", column, value, limitColumn, limit));
  }
  return value;
}

void RowReader::fail(const std::string& text) const {
  throw base::InputError(file_, fmt::format("line {}", table_.line(row_)), text);
}

}  // namespace lorica::analysis
