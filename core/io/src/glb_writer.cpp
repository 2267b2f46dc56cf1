#include <cstring>
#include <nlohmann/json.hpp>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "reading.h"
#include "writers.h"

namespace lorica::io {

using geometry::Triangle;
using geometry::Vec3f;
using Json = nlohmann::ordered_json;

namespace {

constexpr int arrayBuffer = 34962;
constexpr int elementArrayBuffer = 34963;
constexpr int float32 = 5126;
constexpr int uint32 = 5125;

class GlbWriter {
 public:
  std::string write(std::span<const SceneMesh> scene) {
    for (const SceneMesh& mesh : scene) {
      add(mesh);
    }
    Json nodes = Json::array();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      nodes.push_back(n);
    }
    Json root{{"asset", {{"version", "2.0"}, {"generator", "Lorica"}}}, {"scene", 0}};
    root["scenes"] = Json::array({nodes_.empty() ? Json::object() : Json{{"nodes", nodes}}});
    for (const auto& [name, list] : {std::pair{"nodes", &nodes_},
                                     {"meshes", &meshes_},
                                     {"materials", &materials_},
                                     {"accessors", &accessors_},
                                     {"bufferViews", &views_}}) {
      if (!list->empty()) {
        root[name] = *list;
      }
    }
    if (!binary_.empty()) {
      root["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    }
    return container(root.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

 private:
  void add(const SceneMesh& mesh) {
    Json node{{"name", oneLine(mesh.name)}};
    if (!mesh.triangles.empty()) {  // glTF has no empty accessors
      node["mesh"] = meshes_.size();
      addMesh(mesh);
    }
    node["extras"] = {{"kind", mesh.kind}};
    nodes_.push_back(std::move(node));
  }

  void addMesh(const SceneMesh& mesh) {
    std::vector<Vec3f> normals = geometry::vertexNormals(mesh.positions, mesh.triangles);
    for (Vec3f& normal : normals) {
      if (normal.isZero(0.0F)) {
        normal = Vec3f::UnitY();  // glTF wants unit length everywhere
      }
    }
    const std::size_t position = addAccessor(mesh.positions, "VEC3", float32, arrayBuffer);
    Vec3f low = mesh.positions.front();
    Vec3f high = low;
    for (const Vec3f& p : mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    accessors_.back()["min"] = {low.x(), low.y(), low.z()};
    accessors_.back()["max"] = {high.x(), high.y(), high.z()};
    const std::size_t normal = addAccessor(std::span<const Vec3f>(normals), "VEC3", float32, arrayBuffer);
    const std::size_t indices = addAccessor(mesh.triangles, "SCALAR", uint32, elementArrayBuffer);
    Json primitive{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                   {"indices", indices},
                   {"material", materials_.size()}};
    meshes_.push_back({{"name", oneLine(mesh.name)}, {"primitives", Json::array({std::move(primitive)})}});
    const auto& c = mesh.colour;
    Json material{{"name", oneLine(mesh.name)},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {c[0], c[1], c[2], c[3]}}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}},
                  {"doubleSided", true}};
    if (c[3] < 1.0F) {
      material["alphaMode"] = "BLEND";
    }
    materials_.push_back(std::move(material));
  }

  template <class T>
  std::size_t addAccessor(std::span<const T> values, const char* type, int componentType, int target) {
    const std::size_t bytes = values.size_bytes();
    views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}});
    binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
    const std::size_t count = std::is_same_v<T, Triangle> ? 3 * values.size() : values.size();
    accessors_.push_back(
        {{"bufferView", views_.size() - 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
  }

  std::string container(std::string json) const {
    json.append((4 - json.size() % 4) % 4, ' ');
    std::uint64_t length = 12 + 8 + json.size();
    length += binary_.empty() ? 0 : 8 + binary_.size();  // floats and indices: a multiple of 4 already
    LORICA_CHECK(length <= UINT32_MAX, "a .glb is at most 4 GB");
    std::string file = "glTF";
    appendWord(file, 2);
    appendWord(file, length);
    appendWord(file, json.size());
    file += "JSON" + json;
    if (!binary_.empty()) {
      appendWord(file, binary_.size());
      file.append("BIN\0", 4);
      file += binary_;
    }
    return file;
  }

  static void appendWord(std::string& file, std::uint64_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    std::array<char, sizeof word> raw{};
    std::memcpy(raw.data(), &word, sizeof word);
    file.append(raw.data(), raw.size());
  }

  Json nodes_ = Json::array();
  Json meshes_ = Json::array();
  Json materials_ = Json::array();
  Json accessors_ = Json::array();
  Json views_ = Json::array();
  std::string binary_;
};

}  // namespace

std::string glbBytes(std::span<const SceneMesh> scene) {
  return GlbWriter().write(scene);
}

}  // namespace lorica::io
