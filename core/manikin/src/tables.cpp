#include "tables.h"

#include <algorithm>
#include <span>
#include <utility>

#include "lorica/base/error.h"

namespace lorica::manikin {

/// Written at build time from resources/tables.
std::span<const std::pair<std::string_view, std::string_view>> embeddedTables();

namespace {

base::Table embedded(std::string_view name) {
  const auto files = embeddedTables();
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.first == name; });
  LORICA_CHECK(found != files.end(), "the table is embedded");
  return {found->second, std::string(name)};
}

}  // namespace

const base::Table& anthropometryTable() {
  static const base::Table table = embedded("anthropometry");
  return table;
}

const base::Table& jointTable() {
  static const base::Table table = embedded("joints");
  return table;
}

const base::Table& organTable() {
  static const base::Table table = embedded("organs");
  return table;
}

const base::Table& vesselTable() {
  static const base::Table table = embedded("vessels");
  return table;
}

}  // namespace lorica::manikin
