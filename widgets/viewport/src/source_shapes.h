#pragma once

/// \file
/// How sources of shots and the directions of azimuth and elevation are drawn: lines, in the scene's metres.

#include <QString>
#include <optional>
#include <span>
#include <vector>

#include "lorica/study/study.h"

namespace lorica::viewport {

using Polyline = std::vector<geometry::Vec3d>;

struct SourceShape {
  std::vector<Polyline> lines;
  std::vector<geometry::Vec3d> balls;  ///< where shots start that start at one place
};

/// A point with its line of aim and the window it shoots through; a beam as arrows before the disk, or the square of
/// a grid, that they come through; a band as the strip of a sphere that its directions pass; every direction as that
/// sphere; a list as some of its lines.
/// \param aim middle of the shots \param radius of the ball around it that holds the posed skin
/// \param listed shots of a list
SourceShape shapeOf(const study::Source& source, const geometry::Vec3d& aim, double radius,
                    std::span<const raycast::Ray> listed = {});

struct CompassLabel {
  geometry::Vec3d place = geometry::Vec3d::Zero();
  QString text;
  bool strong = false;
  bool ofSource = false;  ///< says where the source is
};

/// A ring of azimuths with ticks on the floor, where it is seen from nearly everywhere, an arc of elevations around the
/// aim in the azimuth of the source, and the source's own direction.
struct Compass {
  std::vector<Polyline> lines;
  std::vector<Polyline> strong;  ///< of the source
  std::vector<CompassLabel> labels;
};

/// None for lists, which have no direction of their own. \param floor height of the floor
std::optional<Compass> compassOf(const study::Source& source, const geometry::Vec3d& aim, double radius, double floor);

}  // namespace lorica::viewport
