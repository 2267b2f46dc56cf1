#pragma once

/// \file
/// One reader per format. Each takes the file's bytes, checks everything and throws base::InputError through
/// `reading`; none knows about units, welding or orientation.

#include <string_view>

#include "raw_model.h"
#include "reading.h"

namespace lorica::io {

/// glTF 2.0; `bytes` is a .glb when it begins with "glTF", else JSON.
RawModel readGltf(std::string_view bytes, Reading& reading);
RawModel readObj(std::string_view bytes, Reading& reading);
RawModel readStl(std::string_view bytes, Reading& reading);
RawModel readPly(std::string_view bytes, Reading& reading);
RawModel readOff(std::string_view bytes, Reading& reading);

/// True when the size fits the number of triangles that a binary STL states.
bool isBinaryStl(std::string_view bytes);
/// True when the first word is a header of the OFF family.
bool isOff(std::string_view bytes);

}  // namespace lorica::io
