#include <algorithm>
#include <span>
#include <utility>

#include "json_text.h"
#include "lorica/base/error.h"
#include "lorica/study/study_file.h"

namespace lorica::study {

/// Written at build time from resources/studies.
std::span<const std::pair<std::string_view, std::string_view>> embeddedStudies();

std::vector<std::string> templateNames() {
  std::vector<std::string> names;
  for (const auto& [name, text] : embeddedStudies()) {
    names.emplace_back(name);
  }
  return names;
}

std::string templateText(std::string_view wanted) {
  std::string known;
  for (const auto& [name, text] : embeddedStudies()) {
    if (name == wanted) {
      return std::string(text);
    }
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw base::InputError("", "", "there is no template " + inQuotes(wanted) + "; known are " + known);
}

}  // namespace lorica::study
