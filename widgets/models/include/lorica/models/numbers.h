#pragma once

/// \file
/// How numbers are written in tables, labels and charts: English, whatever the machine's language.

#include <QString>
#include <cstdint>

namespace lorica::models {

/// "100,000"
QString grouped(std::uint64_t count);
/// Plain digits with a fixed number of decimals.
QString fixed(double value, int decimals);

}  // namespace lorica::models
