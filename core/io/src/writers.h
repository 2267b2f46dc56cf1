#pragma once

/// \file
/// One writer per format of exported scenes; see sceneBytes().

#include <span>
#include <string>

#include "lorica/io/export.h"

namespace lorica::io {

std::string glbBytes(std::span<const SceneMesh> scene);
std::string plyBytes(std::span<const SceneMesh> scene);
std::string vtpBytes(std::span<const SceneMesh> scene);

/// Red, green, blue and opacity as other programs show them: sRGB, 0 to 255.
std::array<std::uint8_t, 4> displayColour(const std::array<float, 4>& linear);

}  // namespace lorica::io
