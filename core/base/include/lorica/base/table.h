#pragma once

/// \file
/// Tables of published numbers, as resources/tables holds them: CSV after RFC 4180 with a header row.

#include <string>
#include <string_view>
#include <vector>

namespace lorica::base {

/// Immutable; const functions are thread-safe.
class Table {
 public:
  /// \param name what errors call the table
  /// Throws InputError with the line for a quote without its end and for rows longer or shorter than the header.
  Table(std::string_view csv, std::string name);

  std::size_t rows() const { return rows_.size(); }
  bool has(std::string_view column) const;
  /// Line of the text where a row begins, from 1. \pre row < rows()
  std::size_t line(std::size_t row) const { return lines_.at(row); }
  /// Throws InputError when there is no such column. \pre row < rows()
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Throws InputError with the line also when the field is not a finite number.
  double number(std::size_t row, std::string_view column) const;
  /// The first row whose field in `column` is `value`; throws InputError when there is none.
  std::size_t find(std::string_view column, std::string_view value) const;

 private:
  std::size_t columnIndex(std::string_view column) const;

  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;  ///< of each row, from 1
};

}  // namespace lorica::base
