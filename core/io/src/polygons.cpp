#include "polygons.h"

namespace lorica::io {

void appendFan(std::vector<geometry::Triangle>& triangles, std::span<const std::uint32_t> corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
}

void appendStrip(std::vector<geometry::Triangle>& triangles, std::span<const std::uint32_t> corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const bool even = k % 2 == 0;
    triangles.push_back({corners[k - 2], corners[even ? k - 1 : k], corners[even ? k : k - 1]});
  }
}

}  // namespace lorica::io
