#include "bench_scene.h"

#include "lorica/study/study_file.h"

namespace lorica::bench {

analysis::LoadedStudy sampleScene(base::Threads threads) {
  return analysis::load(study::parseStudy(study::templateText("sample"), "sample"), "sample", threads);
}

}  // namespace lorica::bench
