#include "study_upgrade.h"

#include <fmt/format.h>

#include <cmath>

#include "lorica/study/study_file.h"

namespace lorica::study {

std::span<const UpgradeStep> upgradeSteps() {
  static_assert(studyVersion == 1, "a new version needs the step that leads to it");
  return {};
}

Json upgraded(Json tree, const std::string& file, std::span<const UpgradeStep> steps) {
  const std::size_t newest = steps.size() + 1;
  const Node root(&tree, file, "");
  if (!tree.is_object()) {
    root.failExpected("a study (an object)");
  }
  const Node place = root["lorica_study"];
  if (!place.present()) {
    place.fail(fmt::format("expected {}, the version of the study format, found nothing; is this a study?", newest));
  }
  const char* words = "the version of the study format, a whole number from 1";
  const double version = place.number({1.0, std::numeric_limits<double>::max(), true, words});
  if (version != std::floor(version)) {
    place.failExpected(words);
  }
  if (version > static_cast<double>(newest)) {
    place.fail(
        fmt::format("the study has version {}, this program reads versions up to {}; update Lorica", version, newest));
  }
  for (std::size_t done = static_cast<std::size_t>(version); done < newest; ++done) {
    tree = steps[done - 1](std::move(tree));
    tree["lorica_study"] = done + 1;
  }
  return tree;
}

}  // namespace lorica::study
