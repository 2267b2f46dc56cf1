#include "lorica/io/export.h"

#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "writers.h"

namespace lorica::io {

std::array<std::uint8_t, 4> displayColour(const std::array<float, 4>& linear) {
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const double value = std::clamp(static_cast<double>(linear[k]), 0.0, 1.0);
    const bool isOpacity = k == 3;
    const double shown = isOpacity            ? value
                         : value <= 0.0031308 ? 12.92 * value
                                              : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    bytes[k] = static_cast<std::uint8_t>(std::lround(255.0 * shown));
  }
  return bytes;
}

std::string sceneBytes(std::span<const SceneMesh> scene, SceneFormat format) {
  for (const SceneMesh& mesh : scene) {
    for (const geometry::Triangle& triangle : mesh.triangles) {
      LORICA_CHECK(std::max({triangle[0], triangle[1], triangle[2]}) < mesh.positions.size(), "corners are vertices");
    }
  }
  switch (format) {
    case SceneFormat::glb:
      return glbBytes(scene);
    case SceneFormat::ply:
      return plyBytes(scene);
    case SceneFormat::vtp:
      return vtpBytes(scene);
  }
  return {};
}

void writeScene(std::span<const SceneMesh> scene, SceneFormat format, const std::filesystem::path& path) {
  base::writeFileAtomically(path, sceneBytes(scene, format));
}

}  // namespace lorica::io
