#include <fmt/format.h>

#include <array>
#include <cstring>
#include <iterator>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "reading.h"
#include "writers.h"

namespace lorica::io {

using geometry::Vec3f;

namespace {

template <class T>
void append(std::string& bytes, const T& value) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

std::string header(std::span<const SceneMesh> scene, std::size_t vertices, std::size_t faces) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by Lorica, metres, y up\n";
  auto out = std::back_inserter(text);
  for (std::size_t s = 0; s < scene.size(); ++s) {
    fmt::format_to(out, "comment structure {} {}\n", s, oneLine(scene[s].name));
  }
  fmt::format_to(out, "element vertex {}\n", vertices);
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz"}) {
    fmt::format_to(out, "property float {}\n", property);
  }
  fmt::format_to(out, "element face {}\nproperty list uchar uint vertex_indices\n", faces);
  for (const char* property : {"red", "green", "blue", "alpha"}) {
    fmt::format_to(out, "property uchar {}\n", property);
  }
  return text + "property int structure\nend_header\n";
}

}  // namespace

std::string plyBytes(std::span<const SceneMesh> scene) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const SceneMesh& mesh : scene) {
    vertices += mesh.positions.size();
    faces += mesh.triangles.size();
  }
  LORICA_CHECK(vertices <= UINT32_MAX, "indices of a PLY file have 32 bits");
  std::string bytes = header(scene, vertices, faces);
  bytes.reserve(bytes.size() + 24 * vertices + 21 * faces);
  for (const SceneMesh& mesh : scene) {
    const std::vector<Vec3f> normals = geometry::vertexNormals(mesh.positions, mesh.triangles);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      append(bytes, std::array{mesh.positions[v].x(), mesh.positions[v].y(), mesh.positions[v].z(), normals[v].x(),
                               normals[v].y(), normals[v].z()});
    }
  }
  std::uint32_t first = 0;
  for (std::size_t s = 0; s < scene.size(); ++s) {
    const std::array<std::uint8_t, 4> colour = displayColour(scene[s].colour);
    for (const geometry::Triangle& t : scene[s].triangles) {
      append(bytes, std::uint8_t{3});
      append(bytes, std::array{t[0] + first, t[1] + first, t[2] + first});
      append(bytes, colour);
      append(bytes, static_cast<std::int32_t>(s));
    }
    first += static_cast<std::uint32_t>(scene[s].positions.size());
  }
  return bytes;
}

}  // namespace lorica::io
