#include "load_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/human/retarget.h"
#include "lorica/io/motion.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {

namespace fs = std::filesystem;

namespace {

/// One motion on its way from the file to the body.
struct Recorded {
  const LoadedStudy& loaded;
  std::size_t index;

  const study::Motion& wanted() const { return loaded.study.motions[index]; }
  fs::path path() const { return study::resolve(wanted().file, loaded.file); }
  [[noreturn]] void fail(const std::string& key, const std::string& text) const {
    throw base::InputError(loaded.file.string(), fmt::format("/motions/{}{}", index, key), text);
  }

  human::RoleMap roles(const human::Skeleton& skeleton) const {
    try {
      return wanted().jointRoles.empty() ? human::findRoles(skeleton)
                                         : human::rolesFromNames(skeleton, wanted().jointRoles);
    } catch (const base::InputError& error) {
      if (!wanted().jointRoles.empty()) {
        fail("/joint_roles/" + error.place(), error.text());
      }
      throw base::InputError(path().string(), error.place(), error.text());
    }
  }

  human::RoleMap rolesOfBody() const {
    const auto& skeleton = loaded.body->body().skeleton;
    if (!skeleton) {
      fail("", "the body has no skeleton, so it cannot do a recorded motion");
    }
    try {
      return bodyRoles(loaded.study, *skeleton);
    } catch (const base::InputError& error) {
      fail("", fmt::format("the body cannot do a recorded motion: {}: {}", error.place(), error.text()));
    }
  }
};

void noteWhatWasUnderstood(const Recorded& recorded, const io::Motion& motion, const human::Retargeted& done,
                           base::Issues& issues) {
  const std::string& file = recorded.wanted().file.path;
  base::append(issues, motion.issues);
  issues.push_back({base::Severity::note, file, "",
                    fmt::format("read as the motion {}: {} frames of {:.2f} ms, {} joints, {} up{}",
                                recorded.wanted().name, motion.frames, 1000.0 * motion.frameSeconds,
                                motion.skeleton.size(), motion.up == io::UpAxis::y ? "y" : "z",
                                motion.upGuessed ? " (guessed from its shape; \"up\" in the study decides)" : "")});
  constexpr double far = 0.5;  // m, at which a source that was near may be passed
  if (done.travelled > far && !recorded.wanted().inPlace) {
    issues.push_back(
        {base::Severity::note, file, "",
         fmt::format("goes {:.1f} m through the room; \"in_place\": true in the study keeps it on the spot",
                     done.travelled)});
  }
  if (std::abs(done.turned) >= 1.0) {
    issues.push_back(
        {base::Severity::note, file, "",
         fmt::format("is turned by {:.0f} degrees about the vertical, so that it begins facing ahead", done.turned)});
  }
}

human::Clip read(const Recorded& recorded, base::Issues& issues) {
  const fs::path path = recorded.path();
  std::optional<io::UpAxis> up;
  if (recorded.wanted().file.up) {
    up = *recorded.wanted().file.up == 'z' ? io::UpAxis::z : io::UpAxis::y;
  }
  const io::Motion motion = io::importMotion(path, study::readInput(path), up);
  const human::RoleMap doer = recorded.rolesOfBody();
  const human::RoleMap shown = recorded.roles(motion.skeleton);
  try {
    human::Retargeted done =
        human::retarget(motion.clip, {motion.skeleton, shown}, {*recorded.loaded.body->body().skeleton, doer},
                        {recorded.wanted().inPlace});
    done.clip.name = recorded.wanted().name;
    noteWhatWasUnderstood(recorded, motion, done, issues);
    return std::move(done.clip);
  } catch (const base::InputError& error) {
    throw base::InputError(path.string(), error.place(), error.text());
  }
}

/// The same motion as an earlier loading read it.
const human::Clip* known(const Recorded& recorded, const LoadedStudy* previous) {
  if (previous == nullptr || recorded.wanted().file.sha256.empty()) {
    return nullptr;
  }
  const auto& motions = previous->study.motions;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    if (motions[m] == recorded.wanted() && study::resolve(motions[m].file, previous->file) == recorded.path()) {
      return &previous->clips[previous->clips.size() - motions.size() + m];
    }
  }
  return nullptr;
}

}  // namespace

human::RoleMap bodyRoles(const study::Study& study, const human::Skeleton& skeleton) {
  return study.jointRoles.empty() ? human::findRoles(skeleton) : human::rolesFromNames(skeleton, study.jointRoles);
}

base::Issues addMotions(LoadedStudy& study, const LoadedStudy* previous, const base::Progress& progress) {
  base::Issues issues;
  for (std::size_t m = 0; m < study.study.motions.size(); ++m) {
    progress.check();
    const Recorded recorded{study, m};
    const std::string& name = recorded.wanted().name;
    if (std::any_of(study.clips.begin(), study.clips.end(), [&](const human::Clip& c) { return c.name == name; })) {
      recorded.fail("/name", fmt::format("the body has a clip named \"{}\" already; choose another name", name));
    }
    const human::Clip* clip = known(recorded, previous);
    study.clips.push_back(clip != nullptr ? *clip : read(recorded, issues));
  }
  return issues;
}

}  // namespace lorica::analysis
