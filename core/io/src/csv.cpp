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

std::string csvNumber(std::optional<double> value) {
  return value ? fmt::format("{:.6f}", *value) : std::string();
}

}  // namespace lorica::io
