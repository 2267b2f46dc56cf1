#pragma once

/// \file
/// Rows of a table that a run wrote, field by field, with errors that say what to do.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "lorica/base/table.h"

namespace lorica::analysis {

class RowReader {
 public:
  /// \throw base::InputError when the file cannot be read, is no table or has not all of these columns
  RowReader(const std::filesystem::path& file, std::initializer_list<const char*> columns);

  /// Goes to the next row. \return whether there is one
  bool next() { return ++row_ < table_.rows(); }

  const std::string& text(std::string_view column) const { return table_.text(row_, column); }
  double number(std::string_view column) const { return table_.number(row_, column); }
  /// A blank field is none.
  std::optional<double> maybe(std::string_view column) const;
  /// As maybe(), from 0 to 1.
  std::optional<double> share(std::string_view column) const;
  std::uint64_t whole(std::string_view column) const;
  /// A whole number not above that of another column.
  std::uint64_t atMost(std::string_view column, std::uint64_t limit, std::string_view limitColumn) const;

  /// \throw base::InputError at the row
  [[noreturn]] void fail(const std::string& text) const;
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  base::Table table_;
  std::size_t row_ = static_cast<std::size_t>(-1);
};

}  // namespace lorica::analysis
