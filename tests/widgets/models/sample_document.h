#pragma once

/// \file
/// The sample study, loaded and run once for all tests of a program.

#include "lorica/document/study_document.h"
#include "lorica/study/study_file.h"

namespace lorica::testsupport {

inline std::shared_ptr<const analysis::LoadedStudy> loadedSample() {
  static const auto loaded = std::make_shared<const analysis::LoadedStudy>(analysis::load(
      study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json", base::Threads{}));
  return loaded;
}

inline const analysis::RunResult& sampleResult() {
  static const analysis::RunResult result = [] {
    analysis::RunOptions options;
    options.shots = 2000;
    options.trials = 2;
    options.poses = {"rest", "toe_touch@2"};
    return analysis::run(*loadedSample(), options);
  }();
  return result;
}

inline void openSample(document::StudyDocument& document) {
  document.setStudy(study::parseStudy(study::templateText("sample"), "sample"), "sample.lorica.json");
}

inline void openLoadedSample(document::StudyDocument& document) {
  openSample(document);
  document.setLoaded(loadedSample());
}

inline void addSampleRun(document::StudyDocument& document) {
  document.addRun(loadedSample(), sampleResult());
}

}  // namespace lorica::testsupport
