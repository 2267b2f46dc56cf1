#include "gltf_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <limits>

#include "lorica/base/files.h"

namespace lorica::io {

namespace {

constexpr std::size_t deepestNesting = 128;  // tinygltf follows nested values by recursion
constexpr std::uint32_t jsonChunk = 0x4E4F534A;
constexpr std::uint32_t binaryChunk = 0x004E4942;

std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// The JSON of a .glb whose header and chunks fit the file.
std::string_view checkedJsonOfGlb(std::string_view bytes, const Reading& reading) {
  constexpr std::size_t header = 12;
  constexpr std::size_t chunkHeader = 8;
  if (bytes.size() < header + chunkHeader) {
    reading.fail("", fmt::format("is cut off: {} bytes are too few for a .glb", bytes.size()));
  }
  if (const std::uint32_t version = wordAt(bytes, 4); version != 2) {
    reading.fail("", fmt::format("is a .glb of version {}; version 2 is needed", version));
  }
  const std::uint64_t length = wordAt(bytes, 8);
  if (length != bytes.size()) {
    reading.fail(
        "", fmt::format("states a length of {} bytes but has {}; the file is cut or damaged", length, bytes.size()));
  }
  std::string_view json;
  std::size_t chunk = 0;
  for (std::uint64_t at = header; at < length; ++chunk) {
    if (length - at < chunkHeader) {
      reading.fail(fmt::format("chunk {}", chunk), "is cut off within its header");
    }
    const std::uint64_t size = wordAt(bytes, at);
    const std::uint32_t type = wordAt(bytes, at + 4);
    at += chunkHeader;
    if (size > length - at) {
      reading.fail(fmt::format("chunk {}", chunk),
                   fmt::format("states {} bytes, but only {} follow; the file is cut or damaged", size, length - at));
    }
    if (size % 4 != 0) {
      reading.fail(fmt::format("chunk {}", chunk), fmt::format("its length {} is no multiple of 4", size));
    }
    if (chunk == 0) {
      json = bytes.substr(at, size);
    }
    if ((chunk == 0 && type != jsonChunk) || (chunk == 1 && type != binaryChunk)) {
      reading.fail(fmt::format("chunk {}", chunk), "has the wrong type; JSON, then BIN were expected");
    }
    at += size;
  }
  return json;
}

void checkNesting(std::string_view json, const Reading& reading) {
  std::size_t depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString) {
      i += c == '\\' ? 1 : 0;
      inString = c != '"';
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepestNesting) {
        reading.fail(fmt::format("byte {} of the JSON", i), "is nested too deeply for a glTF file");
      }
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
}

bool isImageFile(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 10> images{".png", ".jpg", ".jpeg",  ".webp", ".ktx2",
                                                    ".ktx", ".dds", ".basis", ".tga",  ".bmp"};
  return std::find(images.begin(), images.end(), end) != images.end();
}

/// Buffers are looked for beside the model only, and image files are never opened.
bool fileExists(const std::string& path, void* folder) {
  std::error_code failure;
  return path.starts_with(*static_cast<const std::string*>(folder)) && !isImageFile(path) &&
         std::filesystem::is_regular_file(path, failure);
}

bool readWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
  try {
    const std::string bytes = base::readFile(path);
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const base::InputError& failure) {
    *error = failure.text();
    return false;
  }
}

std::string unchanged(const std::string& path, void*) {
  return path;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

bool ignoreImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

/// Extensions that change neither geometry nor motion, so that a file may require them and still be read.
bool isHarmless(std::string_view extension) {
  constexpr std::array<std::string_view, 6> prefixes{"KHR_materials_",      "KHR_texture_",    "EXT_texture_",
                                                     "KHR_lights_punctual", "KHR_xmp_json_ld", "MSFT_texture_"};
  return std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view p) { return extension.starts_with(p); });
}

bool isRead(std::string_view extension) {
  return extension == "KHR_mesh_quantization";
}

void checkExtensions(const tinygltf::Model& model, Reading& reading) {
  for (const std::string& extension : model.extensionsRequired) {
    if (!isRead(extension) && !isHarmless(extension)) {
      reading.fail("extensionsRequired",
                   fmt::format("needs the extension {}, which cannot be read; save the file without it",
                               oneLine(extension, 60)));
    }
  }
  for (const std::string& extension : model.extensionsUsed) {
    if (!isRead(extension)) {
      reading.note("extensionsUsed", fmt::format("the extension {} is not used", oneLine(extension, 60)));
    }
  }
}

/// tinygltf reports some things and goes on. Skins without inverse bind matrices and channels without a node are
/// legal; a primitive that it left out is not.
void judgeComplaints(std::string_view complaints, Reading& reading) {
  while (!complaints.empty()) {
    const std::size_t end = complaints.find('\n');
    const std::string line = oneLine(complaints.substr(0, end));
    complaints.remove_prefix(end == std::string_view::npos ? complaints.size() : end + 1);
    if (line.empty() || line.find("inverseBindMatrices") != std::string::npos ||
        line.find("animation.channels.target") != std::string::npos || line == "'node' property is missing.") {
      continue;
    }
    if (line.find("Primitive") != std::string::npos) {
      reading.fail("meshes", "a primitive is not as glTF 2.0 has it: " + line);
    }
    reading.warn("", "is not quite as glTF 2.0 has it: " + line);
  }
}

}  // namespace

tinygltf::Model parseGltf(std::string_view bytes, Reading& reading) {
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
    reading.fail("", "is larger than 4 GB, the most a glTF file may be");
  }
  const bool isGlb = bytes.starts_with("glTF");
  if (bytes.starts_with("\xEF\xBB\xBF")) {
    bytes.remove_prefix(3);
  }
  checkNesting(isGlb ? checkedJsonOfGlb(bytes, reading) : bytes, reading);

  const std::filesystem::path parent = reading.path().parent_path();
  std::string folder = (parent.empty() ? std::filesystem::path(".") : parent).string();
  folder += folder.ends_with('/') ? "" : "/";
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(ignoreImage, nullptr);
  reader.SetFsCallbacks({fileExists, unchanged, readWholeFile, writeNothing, &folder});
  tinygltf::Model model;
  std::string errors;
  std::string warnings;  // about textures only, which are not used
  bool good = false;
  try {
    const auto size = static_cast<unsigned int>(bytes.size());
    good = isGlb ? reader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                               reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                 : reader.LoadASCIIFromString(&model, &errors, &warnings, bytes.data(), size, folder);
  } catch (const std::exception& failure) {
    errors = failure.what();
  }
  if (!good) {
    reading.fail("", "cannot be read as glTF 2.0: " + oneLine(errors.empty() ? "it is damaged" : errors));
  }
  if (!model.asset.version.starts_with("2.")) {
    reading.fail("asset", fmt::format("is glTF {}; glTF 2 is needed", oneLine(model.asset.version, 20)));
  }
  judgeComplaints(errors, reading);
  checkExtensions(model, reading);
  return model;
}

}  // namespace lorica::io
