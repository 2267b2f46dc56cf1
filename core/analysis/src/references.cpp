#include "references.h"

#include <fmt/format.h>

#include <algorithm>

#include "lorica/analysis/anatomy.h"
#include "lorica/analysis/gaps.h"
#include "lorica/base/error.h"

namespace lorica::analysis {

namespace {

template <class Things>
bool isNamed(const Things& things, const std::string& name) {
  return std::any_of(things.begin(), things.end(), [&](const auto& thing) { return thing->name == name; });
}

class References {
 public:
  explicit References(const LoadedStudy& study) : study_(study) {}

  void checkModels() {
    if (study_.study.models.empty()) {
      add("/models", "the study has no organ model to run with; add one, such as \"dynamic\"");
    }
  }
  void checkStopRule() {
    const std::optional<study::StopRule>& stop = study_.study.stop;
    if (!stop) {
      return;
    }
    for (std::size_t i = 0; i < stop->structures.size(); ++i) {
      if (!isNamed(study_.organs, stop->structures[i])) {
        add(fmt::format("/stop/structures/{}", i),
            fmt::format("the study has no organ named \"{}\"", stop->structures[i]));
      }
    }
    if (stop->maxTrials < study_.study.trials) {
      add("/stop/max_trials",
          fmt::format("{} is less than the {} trials that are shot in any case; raise it, or lower trials",
                      stop->maxTrials, study_.study.trials));
    }
  }
  void checkOverlap() {
    const std::vector<std::string>& order = study_.study.overlap.order;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (!isNamed(study_.organs, order[i]) && !isNamed(study_.pieces, order[i])) {
        add(fmt::format("/overlap/order/{}", i),
            fmt::format("the study has no organ and no armor piece named \"{}\"", order[i]));
      }
    }
  }
  void checkMotion() {
    const std::optional<study::MotionSettings>& motion = study_.study.analyses.motion;
    const bool known = !motion || std::any_of(study_.clips.begin(), study_.clips.end(),
                                              [&](const human::Clip& clip) { return clip.name == motion->clip; });
    if (!known) {
      std::vector<std::string> names;
      for (const human::Clip& clip : study_.clips) {
        names.push_back(clip.name);
      }
      add("/analyses/motion/clip", fmt::format("the body has no clip named \"{}\"; it has {}", motion->clip,
                                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    }
  }
  /// What another part of the program checks.
  template <class Check>
  void checkBy(bool wanted, const Check& check) {
    try {
      if (wanted) {
        check();
      }
    } catch (const base::InputError& error) {
      found_.push_back({base::Severity::error, error.file(), error.place(), error.text()});
    }
  }
  base::Issues found() && { return std::move(found_); }

 private:
  void add(std::string place, std::string text) {
    found_.push_back({base::Severity::error, study_.file.string(), std::move(place), std::move(text)});
  }

  const LoadedStudy& study_;
  base::Issues found_;
};

}  // namespace

base::Issues danglingReferences(const LoadedStudy& study) {
  References references(study);
  references.checkModels();
  references.checkStopRule();
  references.checkOverlap();
  references.checkMotion();
  references.checkBy(study.study.analyses.gaps.has_value(), [&] { checkGaps(study); });
  references.checkBy(study.study.analyses.anatomy.has_value(), [&] { jitterOf(study); });
  return std::move(references).found();
}

void requireReferences(const LoadedStudy& study) {
  if (const base::Issues dangling = danglingReferences(study); !dangling.empty()) {
    throw base::InputError(dangling[0].file, dangling[0].place, dangling[0].text);
  }
}

}  // namespace lorica::analysis
