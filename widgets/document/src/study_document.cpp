#include "lorica/document/study_document.h"

#include <QUndoStack>
#include <algorithm>
#include <utility>

#include "lorica/base/error.h"
#include "lorica/study/study_file.h"

namespace lorica::document {

namespace fs = std::filesystem;

namespace {

template <class Items>
bool hasNamed(const Items& items, const std::string& name) {
  return std::any_of(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
}

bool hasPose(const study::Study& study, const std::string& name) {
  return name == "rest" || hasNamed(study.poses, name);
}

bool canBeShown(const study::Study& study, const std::string& pose) {
  return hasPose(study, pose) || study::clipPoseNamed(pose).has_value();
}

bool hasRegion(const StudyDocument& document, const std::string& name) {
  if (document.loaded() == nullptr || document.loaded()->body == nullptr) {
    return false;
  }
  const std::vector<std::string>& regions = document.loaded()->body->body().regions.names;
  return std::find(regions.begin(), regions.end(), name) != regions.end();
}

fs::path absoluteFile(const fs::path& file) {
  return fs::absolute(file).lexically_normal();
}

}  // namespace

bool sameNumbers(const study::Study& a, const study::Study& b) {
  const auto bare = [](study::Study study) {
    study.name.clear();
    study.description.clear();
    study.displays.clear();
    const auto undescribed = [](auto& things) {
      for (auto& thing : things) {
        thing.description.clear();
      }
    };
    undescribed(study.organs);
    undescribed(study.systems);
    undescribed(study.poses);
    undescribed(study.sources);
    for (study::ArmorSystem& system : study.systems) {
      undescribed(system.pieces);
      for (study::ArmorPiece& piece : system.pieces) {
        // Kept for the record.
        piece.material.clear();
        piece.arealDensity.reset();
      }
    }
    return study;
  };
  return bare(a) == bare(b);
}

bool exists(const StudyDocument& document, const ItemRef& item) {
  if (!document.hasStudy()) {
    return false;
  }
  const study::Study& study = document.study();
  switch (item.kind) {
    case ItemKind::study:
    case ItemKind::body:
      return item.name.empty();
    case ItemKind::region:
      return hasRegion(document, item.name);
    case ItemKind::organ:
      return hasNamed(study.organs, item.name);
    case ItemKind::system:
      return hasNamed(study.systems, item.name);
    case ItemKind::piece:
      return std::any_of(study.systems.begin(), study.systems.end(),
                         [&](const study::ArmorSystem& system) { return hasNamed(system.pieces, item.name); });
    case ItemKind::pose:
      return hasPose(study, item.name);
    case ItemKind::source:
      return hasNamed(study.sources, item.name);
    case ItemKind::run:
      return std::any_of(document.runs().begin(), document.runs().end(),
                         [&](const auto& run) { return run->name == item.name; });
  }
  return false;
}

namespace {

/// What an organ is called after an edit that took its name; empty when it went itself.
std::string newNameOf(const std::string& organ, const std::vector<study::Organ>& before,
                      const std::vector<study::Organ>& after) {
  const auto old =
      std::find_if(before.begin(), before.end(), [&](const study::Organ& one) { return one.name == organ; });
  if (old == before.end() || before.size() != after.size()) {
    return {};
  }
  study::Organ renamed = *old;
  renamed.name = after[static_cast<std::size_t>(old - before.begin())].name;
  const bool same = after[static_cast<std::size_t>(old - before.begin())] == renamed;
  return same && !hasNamed(before, renamed.name) ? renamed.name : std::string();
}

}  // namespace

StudyDocument::StudyDocument(QObject* parent) : QObject(parent), undoStack_(new QUndoStack(this)) {
  connect(undoStack_, &QUndoStack::cleanChanged, this, &StudyDocument::fileChanged);
}

StudyDocument::~StudyDocument() {
  // The stack says that it becomes clean when it goes; by then this is half gone.
  undoStack_->disconnect(this);
}

bool StudyDocument::isModified() const {
  return hasStudy_ && (neverSaved_ || !undoStack_->isClean());
}

QString StudyDocument::displayName() const {
  if (!hasStudy_) {
    return {};
  }
  if (hasFile()) {
    return QString::fromStdString(savedFile_.filename().string());
  }
  return study_.name.empty() ? tr("untitled") : QString::fromStdString(study_.name);
}

void StudyDocument::setStudy(study::Study study, const fs::path& suggestedFile) {
  replace(std::move(study), suggestedFile, false, true);
}

void StudyDocument::open(const fs::path& file) {
  replace(study::loadStudy(file), file, true, false);
}

void StudyDocument::restore(study::Study study, const fs::path& file, bool hadFile) {
  replace(std::move(study), file, hadFile, true);
}

void StudyDocument::save() {
  LORICA_CHECK(hasFile(), "a study without a file is saved by giving it one");
  writeTo(savedFile_);
}

void StudyDocument::saveAs(const fs::path& file) {
  LORICA_CHECK(hasStudy_, "there is no study to save");
  writeTo(absoluteFile(file));
}

void StudyDocument::writeTo(const fs::path& file) {
  study::saveStudy(study::rebased(study_, file_, file), file);
  savedFile_ = file;
  neverSaved_ = false;
  {
    const QSignalBlocker once(this);
    undoStack_->setClean();
  }
  Q_EMIT fileChanged();
}

void StudyDocument::close() {
  replace(std::nullopt, {}, false, false);
}

void StudyDocument::replace(std::optional<study::Study> study, const fs::path& file, bool hasFile, bool neverSaved) {
  hasStudy_ = study.has_value();
  study_ = std::move(study).value_or(study::Study());
  file_ = hasStudy_ ? absoluteFile(file) : fs::path();
  savedFile_ = hasFile ? file_ : fs::path();
  neverSaved_ = neverSaved;
  selection_.reset();
  shownPose_ = "rest";
  shownModels_ = {viscera::OrganModel::dynamic};
  inspection_ = {};
  loaded_.reset();
  plan_.reset();
  problems_.clear();
  runs_.clear();
  {
    // Listeners hear of the new study before anything else.
    const QSignalBlocker later(this);
    undoStack_->clear();
  }
  Q_EMIT replaced();
  Q_EMIT studyChanged(everything);
  Q_EMIT fileChanged();
  Q_EMIT selectionChanged();
  Q_EMIT shownPoseChanged();
  Q_EMIT shownModelsChanged();
  Q_EMIT inspectionChanged();
  Q_EMIT loadedChanged();
  Q_EMIT problemsChanged();
  Q_EMIT runsChanged();
}

void StudyDocument::select(std::optional<ItemRef> item) {
  if (item && !exists(*this, *item)) {
    item.reset();
  }
  if (item != selection_) {
    selection_ = std::move(item);
    Q_EMIT selectionChanged();
  }
}

bool StudyDocument::dropStaleSelection() {
  const bool stale = selection_ && !exists(*this, *selection_);
  if (stale) {
    selection_.reset();
  }
  return stale;
}

void StudyDocument::showPose(std::string pose) {
  LORICA_CHECK(canBeShown(study_, pose), "a pose of the study, rest or CLIP@SECONDS can be shown");
  if (pose != shownPose_) {
    shownPose_ = std::move(pose);
    Q_EMIT shownPoseChanged();
  }
}

void StudyDocument::showModels(std::vector<viscera::OrganModel> models) {
  LORICA_CHECK(models.size() == 1 || (models.size() == 2 && models[0] != models[1]),
               "one organ model is shown, or two different ones");
  if (models != shownModels_) {
    shownModels_ = std::move(models);
    Q_EMIT shownModelsChanged();
  }
}

void StudyDocument::inspect(Inspection inspection) {
  LORICA_CHECK(inspection.organ.empty() || hasNamed(study_.organs, inspection.organ), "an organ of the study");
  if (inspection != inspection_) {
    inspection_ = std::move(inspection);
    Q_EMIT inspectionChanged();
  }
}

void StudyDocument::setLoaded(std::shared_ptr<const analysis::LoadedStudy> loaded) {
  loaded_ = std::move(loaded);
  const bool selectionGone = dropStaleSelection();
  Q_EMIT loadedChanged();
  if (selectionGone) {
    Q_EMIT selectionChanged();
  }
}

void StudyDocument::setPlan(std::shared_ptr<const RunPlan> plan) {
  plan_ = std::move(plan);
  Q_EMIT planChanged();
}

void StudyDocument::setProblems(base::Issues problems) {
  problems_ = std::move(problems);
  Q_EMIT problemsChanged();
}

void StudyDocument::addRun(std::shared_ptr<const analysis::LoadedStudy> study, analysis::RunResult result) {
  RunRecord run;
  run.name = tr("Run %1").arg(runs_.size() + 1).toStdString();
  run.summary = analysis::summaryRows(*study, result);
  run.study = std::move(study);
  run.result = std::move(result);
  runs_.push_back(std::make_shared<const RunRecord>(std::move(run)));
  Q_EMIT runsChanged();
}

void StudyDocument::edit(EditKey, Changes what, const std::function<void(study::Study&)>& change) {
  const std::vector<study::Organ> organsBefore = study_.organs;
  change(study_);
  const bool selectionGone = dropStaleSelection();
  const bool poseGone = !canBeShown(study_, shownPose_);
  if (poseGone) {
    shownPose_ = "rest";
  }
  const bool organGone = !inspection_.organ.empty() && !hasNamed(study_.organs, inspection_.organ);
  if (organGone) {
    inspection_.organ = newNameOf(inspection_.organ, organsBefore, study_.organs);
  }
  Q_EMIT studyChanged(what);
  if (selectionGone) {
    Q_EMIT selectionChanged();
  }
  if (poseGone) {
    Q_EMIT shownPoseChanged();
  }
  if (organGone) {
    Q_EMIT inspectionChanged();
  }
}

}  // namespace lorica::document
