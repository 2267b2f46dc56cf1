#include "lorica/base/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "lorica/base/error.h"

namespace lorica::base {

Table::Table(std::string_view csv, std::string name) : name_(std::move(name)) {
  std::vector<std::string> fields(1);
  std::size_t line = 1;
  std::size_t start = 1;
  bool quoted = false;
  bool empty = true;
  const auto endRow = [&] {
    if (!empty) {
      if (header_.empty()) {
        header_ = fields;
      } else if (fields.size() == header_.size()) {
        rows_.push_back(fields);
        lines_.push_back(start);
      } else {
        throw InputError(name_, fmt::format("line {}", start),
                         fmt::format("expected {} fields, found {}", header_.size(), fields.size()));
      }
    }
    fields.assign(1, "");
    empty = true;
  };
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (c == '\n') {
      ++line;
    }
    if (quoted) {
      if (c != '"') {
        fields.back() += c;
      } else if (i + 1 < csv.size() && csv[i + 1] == '"') {
        fields.back() += csv[++i];
      } else {
        quoted = false;
      }
    } else if (c == '\n') {
      endRow();
      start = line;
    } else if (c == ',') {
      fields.emplace_back();
      empty = false;
    } else if (c == '"' && fields.back().empty()) {
      quoted = true;
      empty = false;
    } else if (c != '\r') {
      fields.back() += c;
      empty = false;
    }
  }
  if (quoted) {
    throw InputError(name_, fmt::format("line {}", start), "a quote is opened and never closed");
  }
  endRow();
}

bool Table::has(std::string_view column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::size_t Table::columnIndex(std::string_view column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) {
    throw InputError(name_, "line 1", fmt::format("there is no column '{}'", column));
  }
  return static_cast<std::size_t>(found - header_.begin());
}

const std::string& Table::text(std::size_t row, std::string_view column) const {
  return rows_.at(row)[columnIndex(column)];
}

double Table::number(std::size_t row, std::string_view column) const {
  const std::string& field = text(row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
    throw InputError(name_, fmt::format("line {}", lines_[row]),
                     fmt::format("expected a number in column '{}', found '{}'", column, field));
  }
  return value;
}

std::size_t Table::find(std::string_view column, std::string_view value) const {
  const std::size_t index = columnIndex(column);
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const auto& fields) { return fields[index] == value; });
  if (found == rows_.end()) {
    throw InputError(name_, "", fmt::format("there is no row whose '{}' is '{}'", column, value));
  }
  return static_cast<std::size_t>(found - rows_.begin());
}

}  // namespace lorica::base
