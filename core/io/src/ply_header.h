#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reading.h"

namespace lorica::io {

enum class PlyEncoding { ascii, littleEndian, bigEndian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;   ///< of the value, or of each value of a list
  std::optional<PlyType> listCount;  ///< type of the number of values; nothing when the property is no list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;  ///< at least one when count > 0
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  ///< up to the first byte of the data
  std::size_t lines = 0;
};

/// \throw base::InputError naming the line
PlyHeader readPlyHeader(std::string_view bytes, const Reading& reading);

}  // namespace lorica::io
