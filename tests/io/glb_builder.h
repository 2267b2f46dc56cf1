#pragma once

/// \file
/// Small glTF files made in memory, valid or not.

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lorica::test {

using Json = nlohmann::json;

template <class T>
constexpr int componentType() {
  if constexpr (std::is_same_v<T, std::int8_t>) {
    return 5120;
  } else if constexpr (std::is_same_v<T, std::uint8_t>) {
    return 5121;
  } else if constexpr (std::is_same_v<T, std::int16_t>) {
    return 5122;
  } else if constexpr (std::is_same_v<T, std::uint16_t>) {
    return 5123;
  } else if constexpr (std::is_same_v<T, std::uint32_t>) {
    return 5125;
  } else {
    static_assert(std::is_same_v<T, float>);
    return 5126;
  }
}

/// Components of an element of the type.
inline std::size_t width(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

template <class T>
std::string bytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// `document` may be changed freely before glb() or gltf() is called.
class GlbBuilder {
 public:
  Json document{{"asset", {{"version", "2.0"}}},
                {"scene", 0},
                {"scenes", Json::array({{{"nodes", Json::array()}}})},
                {"nodes", Json::array()},
                {"meshes", Json::array()},
                {"accessors", Json::array()},
                {"bufferViews", Json::array()}};
  std::string binary;

  /// Appends bytes, aligned, and a view of them.
  int view(const std::string& bytes, int stride = 0) {
    binary.append((4 - binary.size() % 4) % 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) {
      view["byteStride"] = stride;
    }
    binary += bytes;
    return add("bufferViews", view);
  }

  /// Accessor on a view of its own.
  template <class T>
  int accessor(const std::vector<T>& values, const std::string& type, bool normalised = false) {
    Json accessor{{"bufferView", view(bytesOf(values))},
                  {"componentType", componentType<T>()},
                  {"count", values.size() / width(type)},
                  {"type", type}};
    if (normalised) {
      accessor["normalized"] = true;
    }
    return add("accessors", accessor);
  }

  /// Appends to one of the document's lists; the index of the new entry.
  int add(const std::string& list, const Json& entry) {
    document[list].push_back(entry);
    return static_cast<int>(document[list].size()) - 1;
  }

  /// A mesh of one primitive.
  int mesh(const Json& attributes, int indices = -1, int mode = 4) {
    Json primitive{{"attributes", attributes}, {"mode", mode}};
    if (indices >= 0) {
      primitive["indices"] = indices;
    }
    return add("meshes", {{"primitives", Json::array({primitive})}});
  }

  /// A node of the scene.
  int root(const Json& node) {
    const int index = add("nodes", node);
    document["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  std::string glb() const {
    Json json = document;
    std::string padded = binary;
    padded.append((4 - padded.size() % 4) % 4, '\0');
    if (!json.contains("buffers") && !padded.empty()) {
      json["buffers"] = Json::array({{{"byteLength", padded.size()}}});
    }
    return container(json.dump(), padded);
  }

  /// The same as JSON with the buffer in a file of its own.
  std::string gltf(const std::string& bufferFile) const {
    Json json = document;
    json["buffers"] = Json::array({{{"byteLength", binary.size()}, {"uri", bufferFile}}});
    return json.dump();
  }

  static std::string container(std::string json, const std::string& bin) {
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string file = "glTF" + word(2) + word(12 + 8 + json.size() + (bin.empty() ? 0 : 8 + bin.size()));
    file += word(json.size()) + "JSON" + json;
    if (!bin.empty()) {
      file += word(bin.size()) + std::string("BIN\0", 4) + bin;
    }
    return file;
  }

  static std::string word(std::size_t value) {
    return bytesOf(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
  }
};

/// Corners of the tetrahedron 0, x, y, z.
inline std::vector<float> tetrahedronCorners() {
  return {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
}

/// Its faces, outward.
inline std::vector<std::uint16_t> tetrahedronIndices() {
  return {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
}

/// A file with the tetrahedron on one node.
inline GlbBuilder tetrahedronFile() {
  GlbBuilder file;
  const int positions = file.accessor(tetrahedronCorners(), "VEC3");
  const int mesh = file.mesh({{"POSITION", positions}}, file.accessor(tetrahedronIndices(), "SCALAR"));
  file.root({{"mesh", mesh}, {"name", "tetrahedron"}});
  return file;
}

/// Column-major matrix that moves by (x, y, z), for inverse binds.
inline std::vector<float> translationMatrix(float x, float y, float z) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

/// The tetrahedron with corners 0 and 1 on joint `hip` at the origin, 2 and 3 on `knee` half a metre above it.
/// Accessors: 0 positions, 1 indices, 2 joints, 3 weights, 4 inverse binds. Nodes: 0 mesh, 1 hip, 2 knee.
inline GlbBuilder skinnedFile() {
  GlbBuilder file;
  const int positions = file.accessor(tetrahedronCorners(), "VEC3");
  const int indices = file.accessor(tetrahedronIndices(), "SCALAR");
  const int joints = file.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  const int weights = file.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  std::vector<float> binds = translationMatrix(0, 0, 0);
  const std::vector<float> knee = translationMatrix(0, -0.5F, 0);
  binds.insert(binds.end(), knee.begin(), knee.end());
  const int inverse = file.accessor(binds, "MAT4");
  const int mesh = file.mesh({{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}, indices);
  file.root({{"mesh", mesh}, {"skin", 0}, {"name", "skin"}});
  file.root({{"name", "hip"}, {"children", {2}}});
  file.add("nodes", {{"name", "knee"}, {"translation", {0, 0.5, 0}}});
  file.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", inverse}});
  return file;
}

/// An animation of one channel.
inline Json animation(int node, const std::string& path, int times, int values,
                      const std::string& interpolation = "LINEAR") {
  return {{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}})},
          {"samplers", Json::array({{{"input", times}, {"output", values}, {"interpolation", interpolation}}})}};
}

}  // namespace lorica::test
