#pragma once

#include <functional>

#include "body_field.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"

namespace lorica::manikin {

/// Volume inside a field, m3, to about 0.2 %.
double volumeInside(const std::function<double(const Vec3d&)>& field, const geometry::Box3d& box, double cell,
                    base::Threads threads);

/// The multipliers for which the tape reads the survey's girths and the body has its volume.
BodyFit fitBody(const Anthropometry& sizes, const BodyJoints& joints, base::Threads threads,
                const base::Progress& progress);

/// Box around the skin with some room.
geometry::Box3d bodyBox(const Anthropometry& sizes, const BodyJoints& joints);

}  // namespace lorica::manikin
