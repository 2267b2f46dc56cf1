#pragma once

/// \file
/// Where the real models are. A test that needs them skips with a message when they are absent.

#include <cstdlib>
#include <filesystem>

namespace lorica::test {

/// LORICA_DATA when set, else ../shared/data beside the project.
inline std::filesystem::path realData() {
  if (const char* set = std::getenv("LORICA_DATA")) {
    return set;
  }
  return std::filesystem::path(LORICA_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace lorica::test

#define LORICA_NEEDS_REAL_DATA(path)                                                            \
  if (!std::filesystem::exists(::lorica::test::realData() / (path))) {                          \
    GTEST_SKIP() << "needs the real models: " << (::lorica::test::realData() / (path)).string() \
                 << " is absent (set LORICA_DATA to their folder)";                             \
  }
