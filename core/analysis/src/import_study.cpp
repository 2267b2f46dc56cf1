#include "lorica/analysis/import_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <span>

#include "load_meshes.h"
#include "lorica/analysis/loaded_study.h"
#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"
#include "lorica/manikin/task_clips.h"
#include "lorica/parenting/skin_side.h"
#include "lorica/study/reserved_names.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {

namespace fs = std::filesystem;

namespace {

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool holdsAny(const std::string& text, std::span<const std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

constexpr std::array<std::string_view, 7> essentialWords = {"heart", "aort",  "vena_cava", "arter",
                                                            "vein",  "liver", "spleen"};
constexpr std::array<std::string_view, 8> desirableWords = {"lung",   "kidney",   "trachea", "bronch",
                                                            "spinal", "intestin", "colon",   "bowel"};
constexpr std::array<std::string_view, 5> rigidWords = {"plate", "helmet", "shield", "hard", "esapi"};
constexpr std::array<std::string_view, 9> nonProtectingWords = {"pouch",   "strap", "buckle", "stand",  "base_",
                                                                "webbing", "belt",  "clip",   "lanyard"};

/// Makes names unique by a number at their end.
class Names {
 public:
  std::string unique(const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; !taken_.insert(name).second; ++n) {
      name = fmt::format("{}_{}", wanted, n);
    }
    return name;
  }
  void take(const std::string& name) { taken_.insert(name); }

 private:
  std::set<std::string> taken_{study::reservedStructures.begin(), study::reservedStructures.end()};
};

class Importer {
 public:
  explicit Importer(const ImportRequest& request) : request_(request), library_(request.studyFile) {}

  ImportedStudy import(base::Threads threads, const base::Progress& progress);

 private:
  /// A file as the study names it.
  std::string pathOf(const fs::path& file) const;
  /// Reads a file too, so that it is hashed at the same time.
  study::InputFile inputOf(const fs::path& file);
  void understood(const study::InputFile& input, const io::Model& model, const std::string& as);
  void addSkin();
  void addOrgan(const fs::path& file);
  void addArmor(const ArmorRequest& armor);
  void addMotion(const fs::path& file);
  /// Names of clips that the body has or may have.
  Names clipNames();
  /// Whether the file says of all its parts that they do not protect; a note says so.
  bool leftOut(const fs::path& file);
  study::ArmorPiece pieceFrom(const fs::path& file);
  void addSource(const parenting::BodyRig& body);
  void startFrom(const study::Study& study);
  void noteWhatIsOdd(const LoadedStudy& loaded, base::Threads threads);
  void noteStrays(const LoadedPiece& piece, const parenting::BodyRig& body, base::Threads threads);
  void note(const std::string& file, const std::string& place, const std::string& text) {
    result_.issues.push_back({base::Severity::note, file, place, text});
  }

  const ImportRequest& request_;
  MeshLibrary library_;
  Names names_;
  std::set<std::string> added_;  ///< names of the pieces that were not there before
  ImportedStudy result_;
};

std::string Importer::pathOf(const fs::path& file) const {
  std::error_code failure;
  const fs::path absolute = fs::absolute(file, failure);
  const fs::path home = fs::absolute(request_.studyFile, failure).parent_path();
  const fs::path relative = absolute.lexically_normal().lexically_relative(home.lexically_normal());
  return relative.empty() ? absolute.generic_string() : relative.generic_string();
}

study::InputFile Importer::inputOf(const fs::path& file) {
  study::InputFile input;
  input.path = pathOf(file);
  input.units = request_.units;
  input.up = request_.up;
  library_.newFile(input);
  return input;
}

void Importer::understood(const study::InputFile& input, const io::Model& model, const std::string& as) {
  std::size_t triangles = 0;
  geometry::Box3d box;
  for (const io::Part& part : model.parts) {
    triangles += part.mesh.triangles.size();
    box.extend(geometry::bounds(part.mesh.positions));
  }
  note(input.path, "",
       fmt::format("read as {}: {} part(s), {} triangles, {:.3f} x {:.3f} x {:.3f} m, unit {}{}, {} up{}", as,
                   model.parts.size(), triangles, box.sizes().x(), box.sizes().y(), box.sizes().z(),
                   base::name(model.units), model.unitsGuessed ? " (guessed from its size; --units decides)" : "",
                   model.up == io::UpAxis::y ? "y" : "z",
                   model.upGuessed ? " (guessed from its shape; --up decides)" : ""));
}

void Importer::addSkin() {
  const study::InputFile input = inputOf(request_.skin);
  const io::Model& model = library_.file(input);
  result_.study.human.from = input;
  understood(input, model, "the body");
  if (!model.skeleton) {
    note(input.path, "", "has no skeleton: the body can be shot but not posed");
    return;
  }
  note(input.path, "", fmt::format("has a skeleton of {} joints", model.skeleton->size()));
  for (const human::Clip& clip : model.clips) {
    note(input.path, clip.name,
         fmt::format("motion clip of {:.3f} s; a pose of it is written {}@SECONDS", clip.duration(), clip.name));
  }
}

void Importer::addOrgan(const fs::path& file) {
  const study::InputFile input = inputOf(file);
  const io::Model& model = library_.file(input);
  const std::string stem = file.stem().string();
  understood(input, model, request_.split ? "organs" : "organ " + stem);
  const auto add = [&](const std::string& name, std::vector<std::string> parts) {
    study::Organ organ;
    organ.name = names_.unique(name);
    if (organ.name != name) {
      result_.issues.push_back(
          {base::Severity::warning, input.path, "",
           fmt::format("the name \"{}\" is taken; this one is \"{}\". Is a file given twice?", name, organ.name)});
    }
    organ.mesh.from = input;
    organ.mesh.parts = std::move(parts);
    organ.injuryClass = injuryClassOf(organ.name);
    result_.study.organs.push_back(std::move(organ));
  };
  if (!request_.split) {
    add(stem, {});
    return;
  }
  for (const io::Part& part : model.parts) {
    add(part.name, {part.name});
  }
}

study::ArmorPiece Importer::pieceFrom(const fs::path& file) {
  study::ArmorPiece piece;
  const study::InputFile input = inputOf(file);
  const io::Model& model = library_.file(input);
  piece.mesh.from = input;
  piece.name = names_.unique(file.stem().string());
  understood(input, model, "armor piece " + piece.name);
  const bool hasWeights =
      std::any_of(model.parts.begin(), model.parts.end(), [](const io::Part& p) { return p.weights.has_value(); });
  const bool soundsRigid = holdsAny(lowerCase(piece.name), rigidWords);
  piece.carriage = !hasWeights && soundsRigid ? study::Carriage::rigid : study::Carriage::skinned;
  note(input.path, "",
       piece.carriage == study::Carriage::rigid
           ? "is taken for a rigid piece by its name; \"carriage\" in the study decides"
           : fmt::format("is taken for a soft piece that follows the skin{}; \"carriage\" in the study decides",
                         hasWeights ? " by its own weights" : ""));
  std::size_t protecting = model.parts.size();
  for (const io::Part& part : model.parts) {
    if (!part.protects || (model.parts.size() > 1 && holdsAny(lowerCase(part.name), nonProtectingWords))) {
      piece.nonProtecting.push_back(part.name);
      --protecting;
    }
  }
  if (protecting == 0) {
    piece.nonProtecting.clear();
  } else if (!piece.nonProtecting.empty()) {
    note(input.path, "",
         fmt::format("parts that do not protect, by their names or as the file says: {}; \"non_protecting\" in the "
                     "study decides",
                     fmt::join(piece.nonProtecting, ", ")));
  }
  return piece;
}

bool Importer::leftOut(const fs::path& file) {
  const study::InputFile input = inputOf(file);
  const io::Model& model = library_.file(input);
  if (std::any_of(model.parts.begin(), model.parts.end(), [](const io::Part& part) { return part.protects; })) {
    return false;
  }
  note(input.path, "", "does not protect, as the file says, and is left out");
  return true;
}

void Importer::addArmor(const ArmorRequest& armor) {
  if (const auto* file = std::get_if<fs::path>(&armor.from); file != nullptr && leftOut(*file)) {
    return;
  }
  auto& systems = result_.study.systems;
  auto system =
      std::find_if(systems.begin(), systems.end(), [&](const study::ArmorSystem& s) { return s.name == armor.system; });
  if (system == systems.end()) {
    study::ArmorSystem made;
    made.name = armor.system;
    systems.push_back(std::move(made));
    system = systems.end() - 1;
  }
  if (const auto* file = std::get_if<fs::path>(&armor.from)) {
    system->pieces.push_back(pieceFrom(*file));
    added_.insert(system->pieces.back().name);
    return;
  }
  study::ArmorPiece plate;
  plate.mesh.from = std::get<study::Builtin>(armor.from);
  plate.name = names_.unique(std::get<study::Builtin>(armor.from).name);
  plate.carriage = study::Carriage::rigid;
  added_.insert(plate.name);
  system->pieces.push_back(std::move(plate));
}

Names Importer::clipNames() {
  Names names;
  for (const std::string& task : manikin::taskClipNames()) {
    names.take(task);
  }
  if (const auto* body = std::get_if<study::InputFile>(&result_.study.human.from)) {
    for (const human::Clip& clip : library_.file(*body).clips) {
      names.take(clip.name);
    }
  }
  for (const study::Motion& motion : result_.study.motions) {
    names.take(motion.name);
  }
  return names;
}

void Importer::addMotion(const fs::path& file) {
  study::Motion motion;
  motion.name = clipNames().unique(file.stem().string());
  motion.file.path = pathOf(file);
  motion.file.sha256 = study::sha256OfInput(file);
  motion.file.up = request_.up;
  result_.study.motions.push_back(std::move(motion));
}

void Importer::addSource(const parenting::BodyRig& body) {
  const geometry::Box3d box = geometry::bounds(body.body().skin.positions);
  study::Source front;
  front.name = "front";
  // Whole millimetres read better, and 5 m are no less 5 m.
  const auto millimetres = [](double x) { return std::round(x * 1000.0) / 1000.0; };
  front.position = {millimetres(box.center().x()), millimetres(box.center().y()), millimetres(box.center().z() + 5.0)};
  result_.study.sources.push_back(std::move(front));
}

void Importer::startFrom(const study::Study& study) {
  result_.study = study;
  for (const study::Organ& organ : study.organs) {
    names_.take(organ.name);
  }
  for (const study::ArmorSystem& system : study.systems) {
    for (const study::ArmorPiece& piece : system.pieces) {
      names_.take(piece.name);
    }
  }
}

void Importer::noteStrays(const LoadedPiece& piece, const parenting::BodyRig& body, base::Threads threads) {
  const parenting::Strays strays = parenting::insideSkin(piece.rig.rest.positions, body, threads);
  if (strays.strayed > 0) {
    result_.issues.push_back({base::Severity::warning, "", piece.name,
                              fmt::format("reaches into the body at rest: {} of {} vertices are inside, the deepest "
                                          "by {:.1f} mm",
                                          strays.strayed, strays.points, 1000.0 * strays.farthest)});
  }
}

void Importer::noteWhatIsOdd(const LoadedStudy& loaded, base::Threads threads) {
  if (request_.addTo == nullptr) {
    base::append(result_.issues, loaded.issues);
    for (const auto& piece : loaded.pieces) {
      noteStrays(*piece, *loaded.body, threads);
    }
    return;
  }
  // What the study had is known to its owner: only what is new is told.
  for (std::size_t i = request_.addTo->organs.size(); i < loaded.organs.size(); ++i) {
    base::append(result_.issues, loaded.organs[i]->issues);
  }
  for (const auto& piece : loaded.pieces) {
    if (added_.contains(piece->name)) {
      base::append(result_.issues, piece->issues);
      noteStrays(*piece, *loaded.body, threads);
    }
  }
  const std::vector<study::InputFile> known = study::inputFiles(*request_.addTo);
  for (const base::Issue& issue : loaded.fileIssues) {
    if (std::none_of(known.begin(), known.end(),
                     [&](const study::InputFile& input) { return input.path == issue.file; })) {
      result_.issues.push_back(issue);
    }
  }
}

ImportedStudy Importer::import(base::Threads threads, const base::Progress& progress) {
  if (request_.addTo != nullptr) {
    startFrom(*request_.addTo);
  } else {
    result_.study.name = request_.studyFile.stem().stem().string();
    addSkin();
  }
  for (std::size_t i = 0; i < request_.organs.size(); ++i) {
    progress.check();
    addOrgan(request_.organs[i]);
    progress.report(0.3 * static_cast<double>(i + 1) / static_cast<double>(request_.organs.size()));
  }
  for (const ArmorRequest& armor : request_.armor) {
    progress.check();
    addArmor(armor);
  }
  for (const fs::path& motion : request_.motions) {
    addMotion(motion);
  }
  // Loading the result shows that it holds together, and finds what does not fit.
  study::Study trial = result_.study;
  trial.sources.clear();
  LoadOptions options;
  options.previous = request_.previous;
  const LoadedStudy loaded = load(std::move(trial), request_.studyFile, threads, progress.part(0.3, 1.0), options);
  if (request_.addTo == nullptr) {
    addSource(*loaded.body);
  }
  noteWhatIsOdd(loaded, threads);
  return std::move(result_);
}

}  // namespace

std::string injuryClassOf(std::string_view name) {
  const std::string lower = lowerCase(name);
  if (holdsAny(lower, desirableWords)) {
    return "desirable";
  }
  return holdsAny(lower, essentialWords) ? "essential" : "";
}

ImportedStudy importStudy(const ImportRequest& request, base::Threads threads, const base::Progress& progress) {
  return Importer(request).import(threads, progress);
}

}  // namespace lorica::analysis
