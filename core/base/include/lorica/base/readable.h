#pragma once

/// \file
/// Numbers as a person reads them, in English whatever the machine's language.

#include <cstdint>
#include <string>

namespace lorica::base {

/// "1 h 03 min", "2 min 05 s", "7 s"; rounded up. \pre seconds is finite and not negative
std::string readableTime(double seconds);

/// 1234567 as "1,234,567".
std::string readableCount(std::uint64_t count);

}  // namespace lorica::base
