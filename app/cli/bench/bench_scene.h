#pragma once

#include "lorica/analysis/loaded_study.h"

namespace lorica::bench {

/// The sample study, bound and ready to pose: the built-in human with its organs, vest and plates, a quarter of a
/// million triangles.
/// \param like what it has in common with another one is taken from there; may be null
analysis::LoadedStudy sampleScene(viscera::Deformer deformer, base::Threads threads,
                                  const analysis::LoadedStudy* like = nullptr);

}  // namespace lorica::bench
