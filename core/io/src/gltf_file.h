#pragma once

#include <string_view>

#include "reading.h"

namespace tinygltf {
class Model;
}

namespace lorica::io {

/// The file as tinygltf sees it, with its buffers and without images. The container, the nesting and the version have
/// been checked and so have the extensions; nothing else has: indices, offsets and counts are as the file gives them.
/// \throw base::InputError
tinygltf::Model parseGltf(std::string_view bytes, Reading& reading);

}  // namespace lorica::io
