#include "lorica/base/error.h"

#include <fmt/format.h>

namespace lorica::base {

namespace {

std::string joined(const std::string& file, const std::string& place, const std::string& text) {
  std::string line;
  for (const std::string* piece : {&file, &place}) {
    if (!piece->empty()) {
      line += *piece + ": ";
    }
  }
  return line + text;
}

}  // namespace

InputError::InputError(const std::string& file, const std::string& place, const std::string& text)
    : Error(joined(file, place, text)), file_(file), place_(place), text_(text) {}

void throwCallerError(const char* condition, const char* function, const char* text) {
  throw CallerError(fmt::format("{}: {} ({})", function, text, condition));
}

}  // namespace lorica::base
