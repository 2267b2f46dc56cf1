#include <fmt/format.h>

#include "lorica/io/export.h"

namespace lorica::io {

std::string csvRow(std::span<const std::string> fields) {
  std::string row;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    row += f == 0 ? "" : ",";
    if (fields[f].find_first_of(",\"\r\n") == std::string::npos) {
      row += fields[f];
      continue;
    }
    row += '"';
    for (const char c : fields[f]) {
      row += c == '"' ? "\"\"" : std::string(1, c);
    }
    row += '"';
  }
  return row + "\n";
}

std::string csvWithColumn(std::string_view csv, std::string_view name, std::string_view value) {
  std::string wider;
  bool quoted = false;
  bool isHeader = true;
  for (const char c : csv) {
    quoted = quoted != (c == '"');  // a doubled quote within quotes leaves and comes back
    if (c == '\n' && !quoted) {
      wider += ',';
      wider += isHeader ? name : value;
      isHeader = false;
    }
    wider += c;
  }
  return wider;
}

std::string csvNumber(std::optional<double> value) {
  return value ? fmt::format("{:.6f}", *value) : std::string();
}

}  // namespace lorica::io
