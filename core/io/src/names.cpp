#include "names.h"

#include <algorithm>

#include "reading.h"

namespace lorica::io {

std::string UniqueNames::take(std::string_view wanted, const std::string& fallback) {
  std::string base = oneLine(wanted);
  if (base.empty()) {
    base = fallback;
  }
  int& copies = copies_[base];
  std::string name = base;
  while (!taken_.insert(name).second) {
    name = base + "_" + std::to_string(std::max(copies, 1) + 1);
    copies = std::max(copies, 1) + 1;
  }
  return name;
}

}  // namespace lorica::io
