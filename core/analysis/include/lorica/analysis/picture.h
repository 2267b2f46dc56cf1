#pragma once

/// \file
/// Pictures of a scene made with rays, for where there is neither a display nor a graphics card: parallel view, all
/// surfaces in order, translucent ones over what lies behind them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"
#include "lorica/raycast/scene.h"

namespace lorica::analysis {

/// How a mesh of the scene is painted.
struct MeshLook {
  std::array<std::uint8_t, 3> colour{};  ///< red, green, blue, sRGB
  double opacity = 1.0;                  ///< of a surface seen straight on; 0: not drawn
};

/// What a picture shows: a rectangle seen along its normal.
struct PictureFrame {
  geometry::Vec3d centre = geometry::Vec3d::Zero();     ///< m
  geometry::Vec3d towards = -geometry::Vec3d::UnitZ();  ///< where the viewer looks
  geometry::Vec3d up = geometry::Vec3d::UnitY();        ///< \pre not along `towards`
  double pixel = 0.002;                                 ///< m, its side
  std::size_t columns = 0;
  std::size_t rows = 0;
};

struct Picture {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<std::uint8_t> rgb;  ///< three bytes a pixel, from the upper left, row by row
};

/// Draws a scene on white. Of closed components the sides that face the viewer are painted, of open ones all; a
/// translucent surface is denser where it is seen at a slant. Light comes over the viewer's left shoulder. Pixels at
/// edges are means over a grid of 3 x 3 rays. The same picture at any number of threads.
/// \pre looks has an entry for every mesh; the scene is built
/// \throw base::Cancelled. Cost: one ray a pixel and 9 at an edge
Picture drawScene(const raycast::Scene& scene, std::span<const MeshLook> looks, const PictureFrame& frame,
                  base::Threads threads, const base::Progress& progress = {});

}  // namespace lorica::analysis
