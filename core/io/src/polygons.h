#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lorica/geometry/vectors.h"

namespace lorica::io {

/// Cuts a polygon into triangles around its first corner: 0 1 2, 0 2 3, ...
void appendFan(std::vector<geometry::Triangle>& triangles, std::span<const std::uint32_t> corners);

/// Triangles of a strip, every second one turned so that all face the same way.
void appendStrip(std::vector<geometry::Triangle>& triangles, std::span<const std::uint32_t> corners);

}  // namespace lorica::io
