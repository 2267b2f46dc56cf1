#include "lorica/analysis/loaded_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "load_meshes.h"
#include "load_motions.h"
#include "lorica/armor/plates.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/manikin/task_clips.h"
#include "lorica/manikin/test_cases.h"
#include "lorica/parenting/skin_side.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {

namespace fs = std::filesystem;

namespace {

using study::Builtin;
using study::InputFile;

/// What names of the built-in human's organs and armor begin with.
const std::string kHumanPrefix = "human/";

/// Everything one loading needs to know.
struct Loading {
  LoadedStudy& result;
  MeshLibrary& library;
  base::Threads threads;
  /// Of an earlier loading on the same body; null when there is none.
  const LoadedStudy* previous = nullptr;

  std::string fileName() const { return result.file.string(); }
  [[noreturn]] void fail(const std::string& place, const std::string& text) const {
    throw base::InputError(fileName(), place, text);
  }
};

/// The human of the study, for the names that begin with "human".
const manikin::Human& builtinHuman(Loading& loading, const base::Progress& progress) {
  const human::Person& person = loading.result.study.person;
  try {
    return loading.library.human(person, loading.threads, progress);
  } catch (const base::InputError& error) {
    loading.fail(error.place() == "stature" ? "/human/stature_m" : "/human/mass_kg", error.text());
  }
}

/// The task motions on a file's own skeleton, beside the motions the file has. Without roles for the joints there are
/// none, which is worth saying only where the study names roles.
void addTaskClips(Loading& loading, const human::Skeleton& skeleton) {
  const study::Study& study = loading.result.study;
  std::vector<human::Clip>& clips = loading.result.clips;
  human::RoleMap roles;
  try {
    roles = bodyRoles(study, skeleton);
  } catch (const base::InputError& error) {
    if (!study.jointRoles.empty()) {
      loading.fail("/human/joint_roles/" + error.place(), error.text());
    }
    loading.result.bodyIssues.push_back(
        {base::Severity::note, std::get<InputFile>(study.human.from).path, "",
         fmt::format("the task motions cannot run on its skeleton: {}: {}", error.place(), error.text())});
    return;
  }
  for (human::Clip& clip : manikin::taskClips(skeleton, roles)) {
    const bool taken =
        std::any_of(clips.begin(), clips.end(), [&](const human::Clip& known) { return known.name == clip.name; });
    if (!taken) {
      clips.push_back(std::move(clip));
    }
  }
}

parenting::Body loadBody(Loading& loading, const base::Progress& progress) {
  const study::MeshSource& source = loading.result.study.human;
  parenting::Body body;
  if (const auto* builtin = std::get_if<Builtin>(&source.from)) {
    if (builtin->name != "human") {
      loading.fail("/human/builtin",
                   fmt::format("there is no built-in body named \"{}\"; it is named \"human\"", builtin->name));
    }
    const manikin::Human& human = builtinHuman(loading, progress);
    body.skin = human.body.skin;
    body.skeleton = human.body.skeleton;
    body.weights = human.body.weights;
    loading.result.clips = human.clips;
  } else {
    const InputFile& input = std::get<InputFile>(source.from);
    const io::Model& model = loading.library.file(input);
    MeshLibrary::checkParts(source, model, input.path);
    MergedMesh merged = mergeParts(
        model, [&](const std::string& part) { return selects(source, part); }, model.skeleton.has_value());
    if (merged.mesh.triangles.empty()) {
      throw base::InputError(input.path, "", "none of the parts that make the body is skinned to its skeleton");
    }
    if (merged.unskinnedParts > 0) {
      loading.result.bodyIssues.push_back(
          {base::Severity::warning, input.path, "",
           fmt::format("{} part(s) without skin weights are not part of the body", merged.unskinnedParts)});
    }
    body.skin = std::move(merged.mesh);
    body.weights = std::move(merged.weights);
    body.skeleton = body.weights ? model.skeleton : std::nullopt;
    if (body.skeleton) {
      loading.result.clips = model.clips;
      addTaskClips(loading, *body.skeleton);
    }
  }
  if (body.skeleton) {
    body.regions = human::bodyRegions(body.skin, *body.weights, *body.skeleton);
  } else {
    body.regions.names = {"unassigned"};
    body.regions.ofTriangle.assign(body.skin.triangles.size(), 0);
  }
  return body;
}

geometry::TriangleMesh loadOrganMesh(Loading& loading, const study::Organ& organ, const std::string& place) {
  if (const auto* builtin = std::get_if<Builtin>(&organ.mesh.from)) {
    if (builtin->name == "test_case_1/cube") {
      return manikin::shoulderCube(builtinHuman(loading, {}).body);
    }
    if (builtin->name == "test_case_2/box") {
      return manikin::forearmBox(builtinHuman(loading, {}).body);
    }
    const std::vector<std::string>& names = manikin::organNames();
    if (std::none_of(names.begin(), names.end(),
                     [&](const std::string& name) { return kHumanPrefix + name == builtin->name; })) {
      loading.fail(place + "/builtin", fmt::format("there is no built-in organ named \"{}\"; they are named human/{}",
                                                   builtin->name, fmt::join(names, ", human/")));
    }
    const manikin::Human& human = builtinHuman(loading, {});
    return std::find_if(human.organs.begin(), human.organs.end(),
                        [&](const manikin::Organ& o) { return kHumanPrefix + o.name == builtin->name; })
        ->mesh;
  }
  const InputFile& input = std::get<InputFile>(organ.mesh.from);
  const io::Model& model = loading.library.file(input);
  MeshLibrary::checkParts(organ.mesh, model, input.path);
  return mergeParts(
             model, [&](const std::string& part) { return selects(organ.mesh, part); }, false)
      .mesh;
}

/// Says when an organ reaches out of the skin at rest, and by how much.
void checkInside(const Loading& loading, LoadedOrgan& organ) {
  const parenting::BodyRig& body = *loading.result.body;
  const bool skinCloses = std::all_of(body.skinTopology()->closed.begin(), body.skinTopology()->closed.end(),
                                      [](bool closed) { return closed; });
  if (!skinCloses) {
    return;
  }
  const parenting::Strays strays = parenting::outsideSkin(organ.rig.rest.positions, body, loading.threads);
  if (strays.strayed > 0) {
    organ.issues.push_back(
        {base::Severity::warning, "", organ.name,
         fmt::format("is not inside the skin at rest: {} of {} vertices are outside, the farthest by {:.1f} mm",
                     strays.strayed, strays.points, 1000.0 * strays.farthest)});
  }
}

LoadedOrgan loadOrgan(Loading& loading, const study::Organ& organ, const std::string& place) {
  viscera::OrganOptions options;
  options.lattice = organ.lattice;
  if (organ.joint) {
    const auto& skeleton = loading.result.body->body().skeleton;
    options.joint = skeleton ? skeleton->find(*organ.joint) : std::nullopt;
    if (!options.joint) {
      loading.fail(place + "/joint", fmt::format("the body has no joint named \"{}\"", *organ.joint));
    }
  }
  geometry::TriangleMesh mesh = loadOrganMesh(loading, organ, place);
  const double asked = viscera::controlPointsAsked(geometry::bounds(mesh.positions), options.lattice);
  if (asked > viscera::latticeLimit) {
    loading.fail(place + "/lattice",
                 fmt::format("asks for {:.3g} control points; at most {:.0g} are possible, so take larger cells", asked,
                             viscera::latticeLimit));
  }
  LoadedOrgan loaded;
  loaded.name = organ.name;
  loaded.rig = viscera::bindOrgan(std::move(mesh), organ.name, *loading.result.body, options, loading.threads);
  loaded.topology = raycast::makeTopology(loaded.rig.rest);
  loaded.issues = loaded.rig.issues;
  checkInside(loading, loaded);
  return loaded;
}

/// Whether two mesh sources of two studies are the same bytes read in the same way.
bool sameMesh(const study::MeshSource& a, const fs::path& fileA, const study::MeshSource& b, const fs::path& fileB) {
  const auto* inputA = std::get_if<InputFile>(&a.from);
  const auto* inputB = std::get_if<InputFile>(&b.from);
  if (inputA == nullptr || inputB == nullptr) {
    return a == b;
  }
  return study::resolve(*inputA, fileA) == study::resolve(*inputB, fileB) && !inputA->sha256.empty() &&
         inputA->sha256 == inputB->sha256 && inputA->units == inputB->units && inputA->up == inputB->up &&
         a.parts == b.parts;
}

std::shared_ptr<const LoadedOrgan> reusableOrgan(const Loading& loading, const study::Organ& organ) {
  const LoadedStudy* previous = loading.previous;
  for (std::size_t i = 0; previous != nullptr && i < previous->organs.size(); ++i) {
    const study::Organ& known = previous->study.organs[i];
    if (known.name == organ.name && known.joint == organ.joint && known.lattice == organ.lattice &&
        sameMesh(known.mesh, previous->file, organ.mesh, loading.result.file)) {
      return previous->organs[i];
    }
  }
  return nullptr;
}

void loadOrgans(Loading& loading, const base::Progress& progress) {
  const auto& organs = loading.result.study.organs;
  for (std::size_t i = 0; i < organs.size(); ++i) {
    progress.check();
    std::shared_ptr<const LoadedOrgan> organ = reusableOrgan(loading, organs[i]);
    if (organ == nullptr) {
      organ = std::make_shared<const LoadedOrgan>(loadOrgan(loading, organs[i], fmt::format("/organs/{}", i)));
    }
    loading.result.organs.push_back(std::move(organ));
    progress.report(static_cast<double>(i + 1) / static_cast<double>(organs.size()));
  }
}

/// Joins the organs to one soft body where the study has them deformed so.
void loadSoftBody(Loading& loading, const LoadOptions& options, const base::Progress& progress) {
  LoadedStudy& result = loading.result;
  const std::vector<viscera::OrganModel>& models = result.study.models;
  const bool used =
      options.allModels || std::find(models.begin(), models.end(), viscera::OrganModel::dynamic) != models.end();
  if (!used || result.study.deformer != viscera::Deformer::softBody || result.organs.empty() ||
      !result.body->body().skeleton) {
    return;
  }
  const LoadedStudy* previous = loading.previous;
  if (previous != nullptr && previous->softBody != nullptr && previous->organs == result.organs) {
    result.softBody = previous->softBody;
    return;
  }
  std::vector<viscera::SoftOrgan> organs;
  for (const auto& organ : result.organs) {
    organs.push_back({organ->name, &organ->rig.rest});
  }
  result.softBody = std::make_shared<const viscera::SoftBody>(organs, *result.body, viscera::SoftBodyOptions{},
                                                              loading.threads, progress);
}

struct BuiltinPiece {
  const manikin::ArmorSystem& system;
  const manikin::ArmorPiece& piece;
};

/// A piece of the built-in human's armor, made to its measure.
BuiltinPiece builtinPiece(Loading& loading, const Builtin& builtin, const std::string& place) {
  std::vector<std::string> names;
  for (const manikin::ArmorSystem& system : builtinHuman(loading, {}).systems) {
    for (const manikin::ArmorPiece& piece : system.pieces) {
      const std::string name = fmt::format("{}{}/{}", kHumanPrefix, system.name, piece.name);
      if (name == builtin.name) {
        if (!piece.protecting) {
          loading.fail(place + "/builtin", fmt::format("\"{}\" does not protect, so it is no piece of armor", name));
        }
        return {system, piece};
      }
      if (piece.protecting) {
        names.push_back(name);
      }
    }
  }
  loading.fail(place + "/builtin", fmt::format("there is no built-in armor named \"{}\"; there are front_plate, "
                                               "back_plate, {}",
                                               builtin.name, fmt::join(names, ", ")));
}

/// A generated plate, laid on the body.
geometry::TriangleMesh loadPlate(const Loading& loading, const study::ArmorPiece& piece, const Builtin& builtin,
                                 base::Issues& issues) {
  const parenting::Body& body = loading.result.body->body();
  armor::PlacedPlate placed = armor::placePlate(
      body.skin, body.skeleton ? &*body.skeleton : nullptr,
      builtin.name == "front_plate" ? armor::PlateSide::front : armor::PlateSide::back, armor::mediumSapi());
  for (base::Issue& issue : placed.issues) {
    issue.place = issue.place.empty() ? piece.name : issue.place;
  }
  base::append(issues, std::move(placed.issues));
  return std::move(placed.mesh);
}

/// A pattern that fits no part is a slip that would count a strap as armor.
void warnOfIdlePatterns(const study::ArmorPiece& piece, const io::Model& model, const std::string& place,
                        base::Issues& issues) {
  for (std::size_t n = 0; n < piece.nonProtecting.size(); ++n) {
    const std::string& pattern = piece.nonProtecting[n];
    if (std::any_of(model.parts.begin(), model.parts.end(),
                    [&](const io::Part& part) { return fits(part.name, pattern); })) {
      continue;
    }
    constexpr std::size_t shown = 12;
    std::vector<std::string> names;
    for (std::size_t p = 0; p < std::min(shown, model.parts.size()); ++p) {
      names.push_back(model.parts[p].name);
    }
    issues.push_back({base::Severity::warning, "", fmt::format("{}/non_protecting/{}", place, n),
                      fmt::format("\"{}\" names no part of the piece; its parts are {}{}", pattern,
                                  fmt::join(names, ", "), model.parts.size() > shown ? " and others" : "")});
  }
}

/// Says when a piece hangs in the air: most of it is far from the body.
void checkWorn(const Loading& loading, LoadedPiece& piece) {
  constexpr std::size_t looks = 1000;
  constexpr double far = 0.15;
  const geometry::Positions& positions = piece.rig.rest.positions;
  const std::size_t stride = std::max<std::size_t>(1, positions.size() / looks);
  std::vector<double> distances;
  for (std::size_t v = 0; v < positions.size(); v += stride) {
    const auto nearest = raycast::closestPoint(loading.result.body->restScene(), positions[v].cast<double>());
    distances.push_back(nearest ? nearest->distance : 0.0);
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  if (*middle > far) {
    piece.issues.push_back(
        {base::Severity::warning, "", piece.name,
         fmt::format("is not worn: half of it is more than {:.0f} mm from the skin at rest; check its place and unit",
                     1000.0 * *middle)});
  }
}

LoadedPiece loadPiece(Loading& loading, const study::ArmorPiece& piece, const std::string& place) {
  LoadedPiece loaded;
  loaded.name = piece.name;
  if (const auto* builtin = std::get_if<Builtin>(&piece.mesh.from)) {
    if (builtin->name == "front_plate" || builtin->name == "back_plate") {
      loaded.rig =
          armor::bindPiece(loadPlate(loading, piece, *builtin, loaded.issues), piece.name, piece.carriage,
                           *loading.result.body, nullptr, nullptr, loading.threads, {armor::CarriedBy::skin, {}, {}});
      return loaded;
    }
    const auto [system, made] = builtinPiece(loading, *builtin, place);
    loaded.rig = armor::bindPiece(made.mesh, piece.name, piece.carriage, *loading.result.body,
                                  made.weights ? &*made.weights : nullptr,
                                  made.weights ? &builtinHuman(loading, {}).body.skeleton : nullptr, loading.threads,
                                  manikin::carrierOf(system, made), armor::SoftFit::heldOff);
    return loaded;
  }
  const InputFile& input = std::get<InputFile>(piece.mesh.from);
  const io::Model& model = loading.library.file(input);
  MeshLibrary::checkParts(piece.mesh, model, input.path);
  warnOfIdlePatterns(piece, model, place, loaded.issues);
  const auto protects = [&](const std::string& part) {
    return std::none_of(piece.nonProtecting.begin(), piece.nonProtecting.end(),
                        [&](const std::string& pattern) { return fits(part, pattern); });
  };
  MergedMesh merged = mergeParts(
      model, [&](const std::string& part) { return selects(piece.mesh, part) && protects(part); }, false);
  if (merged.mesh.triangles.empty()) {
    loading.fail(place + "/non_protecting", "leaves no part of the piece that protects");
  }
  for (const io::Part& part : model.parts) {
    if (selects(piece.mesh, part.name) && !protects(part.name)) {
      loaded.nonProtecting.push_back(part.mesh);
    }
  }
  loaded.rig = armor::bindPiece(std::move(merged.mesh), piece.name, piece.carriage, *loading.result.body,
                                merged.weights ? &*merged.weights : nullptr,
                                model.skeleton ? &*model.skeleton : nullptr, loading.threads);
  return loaded;
}

std::shared_ptr<const LoadedPiece> reusablePiece(const Loading& loading, const study::ArmorPiece& piece) {
  const LoadedStudy* previous = loading.previous;
  std::size_t index = 0;
  for (std::size_t s = 0; previous != nullptr && s < previous->study.systems.size(); ++s) {
    for (const study::ArmorPiece& known : previous->study.systems[s].pieces) {
      if (known.name == piece.name && known.carriage == piece.carriage && known.nonProtecting == piece.nonProtecting &&
          sameMesh(known.mesh, previous->file, piece.mesh, loading.result.file)) {
        return previous->pieces[index];
      }
      ++index;
    }
  }
  return nullptr;
}

void loadArmor(Loading& loading, const base::Progress& progress) {
  const auto& systems = loading.result.study.systems;
  for (std::size_t s = 0; s < systems.size(); ++s) {
    for (std::size_t p = 0; p < systems[s].pieces.size(); ++p) {
      progress.check();
      std::shared_ptr<const LoadedPiece> piece = reusablePiece(loading, systems[s].pieces[p]);
      if (piece == nullptr) {
        LoadedPiece made = loadPiece(loading, systems[s].pieces[p], fmt::format("/armor/{}/pieces/{}", s, p));
        made.topology = raycast::makeTopology(made.rig.rest);
        checkWorn(loading, made);
        base::append(made.issues, made.rig.issues);
        piece = std::make_shared<const LoadedPiece>(std::move(made));
      }
      loading.result.pieces.push_back(std::move(piece));
      loading.result.systemOfPiece.push_back(s);
    }
    progress.report(static_cast<double>(s + 1) / static_cast<double>(systems.size()));
  }
}

const human::Clip* clipNamed(const LoadedStudy& study, const std::string& name) {
  const auto found =
      std::find_if(study.clips.begin(), study.clips.end(), [&](const human::Clip& c) { return c.name == name; });
  return found == study.clips.end() ? nullptr : &*found;
}

const human::Skeleton& skeletonFor(const LoadedStudy& study, const std::string& pose) {
  const auto& skeleton = study.body->body().skeleton;
  if (!skeleton) {
    throw base::InputError(study.file.string(), "",
                           fmt::format("pose \"{}\" cannot be taken: the body has no skeleton, so it is only shot at "
                                       "rest",
                                       pose));
  }
  return *skeleton;
}

human::Pose clipPose(const LoadedStudy& study, const study::ClipPose& wanted, const std::string& pose) {
  const human::Skeleton& skeleton = skeletonFor(study, pose);
  const human::Clip* clip = clipNamed(study, wanted.clip);
  if (clip == nullptr) {
    std::vector<std::string> names;
    std::transform(study.clips.begin(), study.clips.end(), std::back_inserter(names),
                   [](const human::Clip& c) { return c.name; });
    throw base::InputError(study.file.string(), "",
                           fmt::format("pose \"{}\": the body has no clip named \"{}\"; it has {}", pose, wanted.clip,
                                       names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  if (!(wanted.seconds >= 0.0 && wanted.seconds <= clip->duration())) {
    throw base::InputError(study.file.string(), "",
                           fmt::format("pose \"{}\": {} s lies beyond the clip, which lasts {} s", pose, wanted.seconds,
                                       clip->duration()));
  }
  return human::sample(*clip, skeleton, wanted.seconds);
}

human::Pose turnedPose(const LoadedStudy& study, const study::TurnedPose& wanted, const std::string& pose) {
  const human::Skeleton& skeleton = skeletonFor(study, pose);
  std::vector<human::JointTurn> turns;
  for (const study::TurnedPose::Turn& turn : wanted.turns) {
    const auto joint = skeleton.find(turn.joint);
    if (!joint) {
      throw base::InputError(
          study.file.string(), "",
          fmt::format("pose \"{}\": the body has no joint named \"{}\"; `lorica-cli check` on its file lists them",
                      pose, turn.joint));
    }
    turns.push_back({*joint, turn.degrees});
  }
  return human::turnedPose(skeleton, turns, wanted.rootOffset);
}

}  // namespace

namespace {

/// Whether an earlier loading read this input, so that its hash is known to be right.
bool wasRead(const InputFile& input, const fs::path& file, const LoadedStudy& previous) {
  const std::vector<InputFile> known = study::inputFiles(previous.study);
  return !input.sha256.empty() && std::any_of(known.begin(), known.end(), [&](const InputFile& other) {
    return other.sha256 == input.sha256 && study::resolve(other, previous.file) == study::resolve(input, file);
  });
}

void checkHashes(const study::Study& study, const fs::path& file, const LoadedStudy* previous) {
  const std::vector<InputFile> inputs = study::inputFiles(study);
  if (previous != nullptr && std::all_of(inputs.begin(), inputs.end(),
                                         [&](const InputFile& input) { return wasRead(input, file, *previous); })) {
    return;
  }
  for (const base::Issue& issue : study::checkInputs(study, file)) {
    throw base::InputError(issue.file, issue.place, issue.text);
  }
}

/// Issues of files that were not read again but are still part of the study, then those just found.
base::Issues mergedFileIssues(const LoadedStudy& result, const LoadedStudy* previous, base::Issues found) {
  base::Issues merged;
  const std::vector<InputFile> inputs = study::inputFiles(result.study);
  for (const base::Issue& issue : previous != nullptr ? previous->fileIssues : base::Issues{}) {
    const bool stillUsed =
        std::any_of(inputs.begin(), inputs.end(), [&](const InputFile& input) { return input.path == issue.file; });
    const bool readAgain =
        std::any_of(found.begin(), found.end(), [&](const base::Issue& other) { return other.file == issue.file; });
    if (stillUsed && !readAgain) {
      merged.push_back(issue);
    }
  }
  base::append(merged, std::move(found));
  return merged;
}

/// The shots of sources that are given as a file, one list per source.
std::vector<shotline::ShotList> readShotLists(const study::Study& study, const fs::path& file) {
  std::vector<shotline::ShotList> lists(study.sources.size());
  for (std::size_t s = 0; s < lists.size(); ++s) {
    if (study.sources[s].type == study::SourceType::list) {
      const fs::path path = study::resolve(study.sources[s].list, file);
      lists[s] = shotline::readShotList(base::readFile(path), path.string());
    }
  }
  return lists;
}

bool usesThesisModel(const study::Study& study) {
  return std::find(study.models.begin(), study.models.end(), viscera::OrganModel::dynamicThesis) != study.models.end();
}

bool sameBody(const LoadedStudy& result, const LoadedStudy& previous) {
  return result.study.siteSpacing == previous.study.siteSpacing && result.study.skinning == previous.study.skinning &&
         (previous.thesisSites || !result.thesisSites) && result.study.person == previous.study.person &&
         result.study.jointRoles == previous.study.jointRoles &&
         sameMesh(result.study.human, result.file, previous.study.human, previous.file);
}

}  // namespace

LoadedStudy load(study::Study study, const std::filesystem::path& file, base::Threads threads,
                 const base::Progress& progress, const LoadOptions& options) {
  checkHashes(study, file, options.previous);
  progress.report(0.05);
  LoadedStudy result;
  result.study = std::move(study);
  result.file = file;
  result.shotLists = readShotLists(result.study, file);
  MeshLibrary library(file);
  Loading loading{result, library, threads};
  result.thesisSites = options.allModels || usesThesisModel(result.study);
  if (options.previous != nullptr && sameBody(result, *options.previous)) {
    loading.previous = options.previous;
    result.body = options.previous->body;
    result.thesisSites = options.previous->thesisSites;
    // Without the motions, which addMotions() puts behind them.
    const auto& clips = options.previous->clips;
    result.clips.assign(clips.begin(),
                        clips.end() - static_cast<std::ptrdiff_t>(options.previous->study.motions.size()));
    result.bodyIssues = options.previous->bodyIssues;
  } else {
    parenting::Body body = loadBody(loading, progress.part(0.05, 0.25));
    progress.report(0.25);
    parenting::RigOptions rig;
    rig.siteSpacing = result.study.siteSpacing;
    rig.thesisSites = result.thesisSites;
    rig.skinning = result.study.skinning;
    result.body = std::make_shared<const parenting::BodyRig>(std::move(body), rig, threads, progress.part(0.25, 0.5));
  }
  base::Issues motionIssues = addMotions(result, loading.previous, progress);
  loadOrgans(loading, progress.part(0.5, 0.75));
  loadSoftBody(loading, options, progress.part(0.75, 0.85));
  loadArmor(loading, progress.part(0.85, 1.0));
  base::append(motionIssues, library.takeIssues());
  result.fileIssues = mergedFileIssues(result, loading.previous, std::move(motionIssues));
  base::append(result.issues, result.bodyIssues);
  base::append(result.issues, result.body->issues());
  if (usesThesisModel(result.study)) {
    base::append(result.issues, result.body->thesisIssues());
  }
  for (const auto& organ : result.organs) {
    base::append(result.issues, organ->issues);
  }
  if (result.softBody != nullptr) {
    base::append(result.issues, result.softBody->issues());
  }
  for (const auto& piece : result.pieces) {
    base::append(result.issues, piece->issues);
  }
  base::append(result.issues, result.fileIssues);
  return result;
}

NamedPose resolvePose(const LoadedStudy& study, const std::string& name) {
  if (name == "rest") {
    return {name, std::nullopt};
  }
  const auto& poses = study.study.poses;
  const auto found =
      std::find_if(poses.begin(), poses.end(), [&](const study::Pose& pose) { return pose.name == name; });
  if (found == poses.end()) {
    const auto clip = study::clipPoseNamed(name);
    if (!clip && clipNamed(study, name) != nullptr) {
      throw base::InputError(study.file.string(), "",
                             fmt::format("\"{}\" is a motion clip; say at which time, as in {}@1.5", name, name));
    }
    if (!clip) {
      throw base::InputError(
          study.file.string(), "",
          fmt::format(
              "there is no pose named \"{}\"; give a pose of the study, rest, or a clip at a time such as toe_touch@2",
              name));
    }
    return {name, clipPose(study, *clip, name)};
  }
  if (const auto* clip = std::get_if<study::ClipPose>(&found->what)) {
    return {name, clipPose(study, *clip, name)};
  }
  return {name, turnedPose(study, std::get<study::TurnedPose>(found->what), name)};
}

std::vector<std::string> defaultPoses(const study::Study& study) {
  if (!study.runPoses.empty()) {
    return study.runPoses;
  }
  std::vector<std::string> names{"rest"};
  for (const study::Pose& pose : study.poses) {
    names.push_back(pose.name);
  }
  return names;
}

}  // namespace lorica::analysis
