#pragma once

/// \file
/// The embedded tables of numbers with their sources (resources/tables): comma-separated values as RFC 4180 has them.

#include <string>
#include <string_view>
#include <vector>

namespace lorica::base {

/// A table with a header line. Value type.
class CsvTable {
 public:
  /// Fields may stand in double quotes and then hold commas and doubled quotes; lines end in LF or CRLF.
  /// \throw InputError naming the line when a row has not as many fields as the header
  explicit CsvTable(std::string_view text);

  std::size_t rows() const { return rows_.size(); }
  /// \pre row < rows(); the table has the column
  const std::string& text(std::size_t row, std::string_view column) const;
  /// The field as a number. \throw InputError naming line and column when it is none
  double number(std::size_t row, std::string_view column) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace lorica::base
