#include "lorica/io/import.h"

#include <algorithm>
#include <cctype>

#include "finish.h"
#include "formats.h"
#include "lorica/base/files.h"
#include "reading.h"

namespace lorica::io {

namespace {

struct Format {
  RawModel (*read)(std::string_view bytes, Reading& reading);
  FormatFrame frame;
};

const Format gltf{readGltf, {base::LengthUnit::metre, UpAxis::y}};
const Format obj{readObj, {}};
const Format stl{readStl, {}};
const Format ply{readPly, {}};
const Format off{readOff, {}};

std::string ending(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Format formatOf(std::string_view bytes, const Reading& reading) {
  if (bytes.empty()) {
    reading.fail("", "is empty; a model was expected");
  }
  if (bytes.starts_with("glTF")) {
    return gltf;
  }
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) {
    return ply;
  }
  if (isBinaryStl(bytes)) {
    return stl;
  }
  if (isOff(bytes)) {
    return off;
  }
  const std::string end = ending(reading.path());
  if (end == ".gltf" || end == ".glb") {
    return gltf;
  }
  if (end == ".obj") {
    return obj;
  }
  if (end == ".stl") {
    return stl;
  }
  if (end == ".ply") {
    return ply;
  }
  if (end == ".off") {
    return off;
  }
  reading.fail("", "is no model of a known format; .gltf, .glb, .obj, .stl, .ply and .off can be read");
}

}  // namespace

Model importModel(const std::filesystem::path& path, const ImportOptions& options) {
  return importModel(path, base::readFile(path), options);
}

Model importModel(const std::filesystem::path& path, std::string_view bytes, const ImportOptions& options) {
  Reading reading(path);
  const Format format = formatOf(bytes, reading);
  return finish(format.read(bytes, reading), format.frame, options, reading);
}

}  // namespace lorica::io
