#pragma once

#include "lorica/analysis/loaded_study.h"

namespace lorica::bench {

/// The embedded sample human with its organs and plates, every mesh refined once: about a quarter of a million
/// triangles, bound and ready to pose.
analysis::LoadedStudy refinedSample(base::Threads threads);

}  // namespace lorica::bench
