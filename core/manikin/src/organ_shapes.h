#pragma once

/// \file
/// Shapes of the organs in the canonical man (see organ_frame.h): fields that are negative inside and near the surface
/// about the distance to it, and tubes. They have the form and the place of the textbooks; their volume is set later.

#include <functional>
#include <span>
#include <vector>

#include "fields.h"

namespace lorica::manikin {

using ShapeField = double (*)(const Vec3d& canonical);

double heartShape(const Vec3d& p);
double lungLeftShape(const Vec3d& p);
double lungRightShape(const Vec3d& p);
double liverShape(const Vec3d& p);
double stomachShape(const Vec3d& p);
double kidneyLeftShape(const Vec3d& p);
double kidneyRightShape(const Vec3d& p);
double spleenShape(const Vec3d& p);
double pancreasShape(const Vec3d& p);
/// What the coils of the small intestine are wound around.
double intestineCore(const Vec3d& p);
double bladderShape(const Vec3d& p);
double brainShape(const Vec3d& p);
/// What is cut into the finished shape: fissures and furrows, metres of depth.
double lungLeftFurrows(const Vec3d& p);
double lungRightFurrows(const Vec3d& p);
double brainFurrows(const Vec3d& p);
double thyroidShape(const Vec3d& p);
/// Vertebrae and pubic bone: nothing else may lie there.
double boneShape(const Vec3d& p);

/// Tubes: stations a few millimetres apart, canonical.
std::vector<Station> largeIntestineTube();
std::vector<Station> smallIntestineTube();
std::vector<Station> spinalCordTube();
/// Windpipe, right and left main bronchus.
std::vector<std::vector<Station>> tracheaTubes();

/// A smooth curve through the stations (centripetal Catmull-Rom), cut into pieces of about `step` metres.
std::vector<Station> smoothTube(std::span<const Station> stations, double step);

}  // namespace lorica::manikin
