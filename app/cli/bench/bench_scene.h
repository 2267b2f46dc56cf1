#pragma once

#include "lorica/analysis/loaded_study.h"

namespace lorica::bench {

/// The sample study, bound and ready to pose: the built-in human with its organs, vest and plates, a quarter of a
/// million triangles.
analysis::LoadedStudy sampleScene(base::Threads threads);

}  // namespace lorica::bench
