#include <QString>
#include <set>

#include "find.h"
#include "lorica/commands/edits.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/reserved_names.h"
#include "lorica/study/study_file.h"

namespace lorica::commands {

using document::Change;
using document::Changes;
using document::ItemKind;

namespace {

void push(StudyDocument& document, study::Study after, Changes what, const QString& text) {
  if (after == document.study()) {
    return;
  }
  document.undoStack().push(new ReplaceStudy(document, std::move(after), what, text));
}

/// What an edit of such an item touches.
Changes touched(ItemKind kind) {
  switch (kind) {
    case ItemKind::organ:
      return Change::organs | Change::sources | Change::run | Changes(Change::display);
    case ItemKind::system:
    case ItemKind::piece:
      return Change::armor | Change::sources | Change::run | Changes(Change::display);
    case ItemKind::pose:
      return Change::poses;
    case ItemKind::source:
      return Change::sources;
    default:
      return document::everything;
  }
}

QString kindText(ItemKind kind) {
  switch (kind) {
    case ItemKind::organ:
      return Text::tr("organ");
    case ItemKind::system:
      return Text::tr("armor system");
    case ItemKind::piece:
      return Text::tr("armor piece");
    case ItemKind::pose:
      return Text::tr("pose");
    default:
      return Text::tr("source");
  }
}

template <class Items>
void eraseNamed(Items& items, const std::string& name) {
  std::erase_if(items, [&](const auto& item) { return item.name == name; });
}

/// Displays of what is gone go too. What looked as the default wanted it before does so afterwards, even where removing
/// a system made another the first.
void settleDisplays(const study::Study& before, study::Study& after) {
  const std::vector<std::string> drawnBefore = document::drawnStructures(before);
  const std::vector<std::string> drawn = document::drawnStructures(after);
  const std::set<std::string> were(drawnBefore.begin(), drawnBefore.end());
  const std::set<std::string> are(drawn.begin(), drawn.end());
  std::erase_if(after.displays, [&](const study::Display& display) {
    return were.contains(display.structure) && !are.contains(display.structure);
  });
  bool defaultsMoved = false;
  for (study::Display& display : after.displays) {
    if (!are.contains(display.structure)) {
      continue;
    }
    const bool was = document::defaultAppearance(before, display.structure).visible;
    const bool is = document::defaultAppearance(after, display.structure).visible;
    defaultsMoved = defaultsMoved || was != is;
    if (was != is && display.visible == was) {
      display.visible = is;
    }
  }
  if (defaultsMoved) {
    after.displays = minimalDisplays(after, std::move(after.displays));
  }
}

/// The item of a study that the reference names. \pre there is one, and it can be renamed
std::string& nameOf(study::Study& study, const ItemRef& item) {
  switch (item.kind) {
    case ItemKind::organ:
      return named(study.organs, item.name).name;
    case ItemKind::system:
      return named(study.systems, item.name).name;
    case ItemKind::piece:
      return named(systemWith(study, item.name).pieces, item.name).name;
    case ItemKind::pose:
      return named(study.poses, item.name).name;
    default:
      LORICA_CHECK(item.kind == ItemKind::source, "such an item has no name of its own");
      return named(study.sources, item.name).name;
  }
}

/// Why structures of that name cannot be: rows of the results, other structures.
QString structureTrouble(const study::Study& study, const std::string& name) {
  if (study::isReservedStructure(name)) {
    return Text::tr("The name \"%1\" is kept for a row of the results.").arg(shown(name));
  }
  if (hasNamed(study.organs, name)) {
    return Text::tr("There is an organ named \"%1\" already.").arg(shown(name));
  }
  for (const study::ArmorSystem& system : study.systems) {
    if (hasNamed(system.pieces, name)) {
      return Text::tr("There is an armor piece named \"%1\" already.").arg(shown(name));
    }
  }
  return {};
}

QString poseTrouble(const study::Study& study, const study::Pose& pose, const std::string& name) {
  if (name == study::restPose) {
    return Text::tr("The name \"%1\" is kept for the pose the body was made in.").arg(shown(name));
  }
  if (hasNamed(study.poses, name)) {
    return Text::tr("There is a pose named \"%1\" already.").arg(shown(name));
  }
  const std::optional<study::ClipPose> meant = study::clipPoseNamed(name);
  const auto* clip = std::get_if<study::ClipPose>(&pose.what);
  if (meant && (clip == nullptr || *clip != *meant)) {
    return Text::tr("\"%1\" reads as a clip at a time, and this pose is another.").arg(shown(name));
  }
  return {};
}

/// Whether the study's file can hold the pose.
bool isWellFormed(const study::Pose& pose) {
  if (const auto* clip = std::get_if<study::ClipPose>(&pose.what)) {
    return isName(clip->clip) && clip->seconds >= 0.0 && clip->seconds <= 1e6;
  }
  const auto holds = [](const geometry::Vec3d& numbers) { return numbers.cwiseAbs().maxCoeff() < 1e5; };
  const auto& turned = std::get<study::TurnedPose>(pose.what);
  std::set<std::string> joints;
  return holds(turned.rootOffset) &&
         std::all_of(turned.turns.begin(), turned.turns.end(), [&](const study::TurnedPose::Turn& turn) {
           return isName(turn.joint) && holds(turn.degrees) && joints.insert(turn.joint).second;
         });
}

/// Names in a list forget one that is gone. \return whether it was the last
bool forget(std::vector<std::string>& names, const std::string& gone) {
  return std::erase(names, gone) > 0 && names.empty();
}

/// A new name in a list, where it stands once.
void renameIn(std::vector<std::string>& names, const std::string& before, const std::string& name) {
  if (name != before && std::find(names.begin(), names.end(), before) != names.end()) {
    std::erase(names, name);
  }
  std::replace(names.begin(), names.end(), before, name);
}

/// Sources, the rule for stopping, the order of overlaps and analyses forget structures that are gone.
void forgetStructures(const study::Study& before, study::Study& after) {
  const std::vector<std::string> drawnBefore = document::drawnStructures(before);
  const std::vector<std::string> drawn = document::drawnStructures(after);
  const std::set<std::string> are(drawn.begin(), drawn.end());
  for (const std::string& gone : drawnBefore) {
    if (are.contains(gone)) {
      continue;
    }
    for (study::Source& source : after.sources) {
      source.targetStructure = source.targetStructure == gone ? std::string() : source.targetStructure;
    }
    std::erase(after.overlap.order, gone);
    if (after.stop && forget(after.stop->structures, gone)) {
      after.stop.reset();
    }
    if (after.analyses.gaps && forget(after.analyses.gaps->structures, gone)) {
      after.analyses.gaps.reset();
    }
    if (after.analyses.anatomy) {
      std::erase_if(after.analyses.anatomy->deviations, [&](const auto& given) { return given.organ == gone; });
    }
  }
}

/// A new name wherever an organ or a piece is referred to.
void renameStructure(const std::string& before, const std::string& name, study::Study& study) {
  // The file may speak of things of that name that it does not have.
  if (name != before) {
    std::erase_if(study.displays, [&](const study::Display& display) { return display.structure == name; });
    std::erase(study.overlap.order, name);
  }
  for (study::Display& display : study.displays) {
    display.structure = display.structure == before ? name : display.structure;
  }
  for (study::Source& source : study.sources) {
    source.targetStructure = source.targetStructure == before ? name : source.targetStructure;
  }
  std::replace(study.overlap.order.begin(), study.overlap.order.end(), before, name);
  if (study.stop) {
    renameIn(study.stop->structures, before, name);
  }
  if (study.analyses.gaps) {
    renameIn(study.analyses.gaps->structures, before, name);
  }
  if (study.analyses.anatomy) {
    auto& deviations = study.analyses.anatomy->deviations;
    const auto isOf = [](const std::string& organ) {
      return [&organ](const study::AnatomySettings::Deviation& given) { return given.organ == organ; };
    };
    if (name != before && std::any_of(deviations.begin(), deviations.end(), isOf(before))) {
      std::erase_if(deviations, isOf(name));
    }
    for (study::AnatomySettings::Deviation& given : deviations) {
      given.organ = given.organ == before ? name : given.organ;
    }
  }
}

}  // namespace

std::string addSource(StudyDocument& document) {
  study::Study after = document.study();
  study::Source source;
  for (int number = 1; source.name.empty() || hasNamed(after.sources, source.name); ++number) {
    source.name = (number == 1 ? Text::tr("source") : Text::tr("source %1").arg(number)).toStdString();
  }
  source.position = {0.0, 1.0, 5.0};
  if (document.loaded() != nullptr && document.loaded()->body != nullptr) {
    const geometry::Box3d box = geometry::bounds(document.loaded()->body->body().skin.positions);
    if (!box.isEmpty()) {
      const geometry::Vec3d middle = box.center() + geometry::Vec3d(0.0, 0.0, 5.0);
      source.position = (middle * 1000.0).array().round().matrix() / 1000.0;
    }
  }
  const std::string name = source.name;
  after.sources.push_back(std::move(source));
  push(document, std::move(after), Change::sources, Text::tr("Add source %1").arg(shown(name)));
  document.select(ItemRef{ItemKind::source, name});
  return name;
}

void addPose(StudyDocument& document, const study::Pose& pose) {
  if (pose.name != study::restPose && !hasNamed(document.study().poses, pose.name)) {
    LORICA_CHECK(isName(pose.name) && poseTrouble(document.study(), pose, pose.name).isEmpty() && isWellFormed(pose),
                 "a study can hold the pose");
    study::Study after = document.study();
    after.poses.push_back(pose);
    push(document, std::move(after), Change::poses, Text::tr("Add pose %1").arg(shown(pose.name)));
  }
  document.select(ItemRef{ItemKind::pose, pose.name});
}

void replaceStudy(StudyDocument& document, study::Study study, const QString& text) {
  push(document, std::move(study), document::everything, text);
}

bool canRemove(const ItemRef& item) {
  switch (item.kind) {
    case ItemKind::organ:
    case ItemKind::system:
    case ItemKind::piece:
    case ItemKind::source:
      return true;
    case ItemKind::pose:
      return item.name != study::restPose;
    default:
      return false;
  }
}

void removeItem(StudyDocument& document, const ItemRef& item) {
  LORICA_CHECK(canRemove(item) && document::exists(document, item), "the study has the item and can be without it");
  const study::Study& before = document.study();
  study::Study after = before;
  switch (item.kind) {
    case ItemKind::organ:
      eraseNamed(after.organs, item.name);
      break;
    case ItemKind::system:
      eraseNamed(after.systems, item.name);
      break;
    case ItemKind::piece:
      eraseNamed(systemWith(after, item.name).pieces, item.name);
      break;
    case ItemKind::pose:
      eraseNamed(after.poses, item.name);
      std::erase(after.runPoses, item.name);
      break;
    default:
      eraseNamed(after.sources, item.name);
      break;
  }
  settleDisplays(before, after);
  forgetStructures(before, after);
  push(document, std::move(after), touched(item.kind),
       Text::tr("Remove %1 %2").arg(kindText(item.kind), shown(item.name)));
}

QString renameTrouble(const StudyDocument& document, const ItemRef& item, const std::string& name) {
  const study::Study& study = document.study();
  if (name == item.name) {
    return {};
  }
  if (shown(name).simplified().isEmpty()) {
    return Text::tr("A name cannot be empty.");
  }
  if (!isName(name)) {
    return Text::tr("A name cannot hold tabs, line breaks or other control characters.");
  }
  switch (item.kind) {
    case ItemKind::organ:
    case ItemKind::piece:
      return structureTrouble(study, name);
    case ItemKind::system:
      if (name == study::unarmored) {
        return Text::tr("The name \"%1\" is kept for the body without armor.").arg(shown(name));
      }
      return hasNamed(study.systems, name) ? Text::tr("There is an armor system named \"%1\" already.").arg(shown(name))
                                           : QString();
    case ItemKind::pose:
      return poseTrouble(study, named(study.poses, item.name), name);
    default:
      return hasNamed(study.sources, name) ? Text::tr("There is a source named \"%1\" already.").arg(shown(name))
                                           : QString();
  }
}

void renameItem(StudyDocument& document, const ItemRef& item, const std::string& name) {
  LORICA_CHECK(canRemove(item) && renameTrouble(document, item, name).isEmpty(), "the item can be named so");
  study::Study after = document.study();
  const std::string before = item.name;
  nameOf(after, item) = name;
  if (item.kind == ItemKind::organ || item.kind == ItemKind::piece) {
    renameStructure(before, name, after);
  }
  if (item.kind == ItemKind::pose && name != before) {
    // A run may list the new name as a clip at a time already: it is the same pose.
    std::erase(after.runPoses, name);
    std::replace(after.runPoses.begin(), after.runPoses.end(), before, name);
  }
  const bool wasShown = item.kind == ItemKind::pose && document.shownPose() == before;
  push(document, std::move(after), touched(item.kind), Text::tr("Rename %1 to %2").arg(shown(before), shown(name)));
  if (wasShown) {
    document.showPose(name);
  }
  document.select(ItemRef{item.kind, name});
}

}  // namespace lorica::commands
