#include "bench_scene.h"

#include "lorica/study/study_file.h"

namespace lorica::bench {

analysis::LoadedStudy sampleScene(viscera::Deformer deformer, base::Threads threads,
                                  const analysis::LoadedStudy* like) {
  study::Study study = study::parseStudy(study::templateText("sample"), "sample");
  study.deformer = deformer;
  analysis::LoadOptions options;
  options.previous = like;
  return analysis::load(std::move(study), "sample", threads, {}, options);
}

}  // namespace lorica::bench
