#include "lorica/analysis/check.h"

#include <fmt/format.h>

#include <algorithm>

#include "lorica/analysis/loaded_study.h"
#include "lorica/analysis/threats.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"
#include "lorica/io/import.h"
#include "lorica/io/motion.h"
#include "lorica/study/study_file.h"
#include "lorica/threat/read_threat.h"
#include "prepare_source.h"
#include "references.h"

namespace lorica::analysis {

namespace {

using base::Issue;
using base::Severity;

/// What an analyst wants to know of one part.
Issue auditPart(const io::Part& part, const std::string& file) {
  const geometry::MeshAudit audit = geometry::audit(part.mesh);
  const std::string size = fmt::format("{} triangles, {} piece(s), {:.1f} cm2", part.mesh.triangles.size(),
                                       audit.components.size(), 1e4 * geometry::area(part.mesh));
  if (audit.closed()) {
    return {Severity::note, file, part.name,
            fmt::format("closed: {}, {:.1f} cm3", size, 1e6 * geometry::signedVolume(part.mesh))};
  }
  return {Severity::warning, file, part.name,
          fmt::format("open: {}, {} boundary edges, {} edges that do not pair; it counts hits, without thickness", size,
                      audit.boundaryEdges, audit.oddEdges)};
}

base::Issues checkMesh(const std::filesystem::path& path) {
  const io::Model model = io::importModel(path);
  base::Issues issues = model.issues;
  for (const io::Part& part : model.parts) {
    issues.push_back(auditPart(part, path.string()));
  }
  if (model.skeleton) {
    std::vector<std::string> names;
    for (const human::Joint& joint : model.skeleton->joints()) {
      names.push_back(joint.name);
    }
    issues.push_back(
        {Severity::note, path.string(), "", fmt::format("{} joints: {}", names.size(), fmt::join(names, ", "))});
  }
  for (const human::Clip& clip : model.clips) {
    issues.push_back({Severity::note, path.string(), clip.name, fmt::format("clip of {:.3f} s", clip.duration())});
  }
  return issues;
}

bool isMotion(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".bvh" || ending == ".BVH";
}

base::Issues checkMotion(const std::filesystem::path& path) {
  const io::Motion motion = io::importMotion(path);
  base::Issues issues = motion.issues;
  const std::string file = path.string();
  std::vector<std::string> names;
  for (const human::Joint& joint : motion.skeleton.joints()) {
    names.push_back(joint.name);
  }
  issues.push_back(
      {Severity::note, file, "",
       fmt::format("motion of {} frames, {:.3f} s, {} up{}", motion.frames, motion.clip.duration(),
                   motion.up == io::UpAxis::y ? "y" : "z", motion.upGuessed ? " (guessed from its shape)" : "")});
  issues.push_back({Severity::note, file, "", fmt::format("{} joints: {}", names.size(), fmt::join(names, ", "))});
  try {
    human::findRoles(motion.skeleton);
  } catch (const base::InputError& error) {
    issues.push_back({Severity::warning, file, error.place(), error.text()});
  }
  return issues;
}

/// A line for each structure with patches that do not close.
base::Issues openStructures(const LoadedStudy& study) {
  base::Issues issues;
  const auto judge = [&](const std::string& name, const geometry::TriangleMesh& mesh) {
    const geometry::MeshAudit audit = geometry::audit(mesh);
    const auto open = std::count_if(audit.components.begin(), audit.components.end(),
                                    [](const geometry::Component& component) { return !component.closed; });
    if (open > 0) {
      issues.push_back({Severity::warning, study.file.string(), name,
                        fmt::format("{} of its {} piece(s) do not close: {} boundary edges, {} edges that do not pair; "
                                    "what is open counts hits, without thickness",
                                    open, audit.components.size(), audit.boundaryEdges, audit.oddEdges)});
    }
  };
  judge("body", study.body->body().skin);
  for (const auto& organ : study.organs) {
    judge(organ->name, organ->rig.rest);
  }
  for (const auto& piece : study.pieces) {
    judge(piece->name, piece->rig.rest);
  }
  return issues;
}

/// A table may be a list of shots or threat data.
base::Issues checkCsv(const std::filesystem::path& path, const base::Progress& progress) {
  const std::string bytes = base::readFile(path);
  if (!shotline::isShotList(bytes)) {
    return checkThreatFile(path, progress);
  }
  const shotline::ShotList list = shotline::readShotList(bytes, path.string());
  return {{Severity::note, path.string(), "", fmt::format("list of {} shots", list.rays->size())}};
}

/// What sources are aimed at when the body is at rest.
Aim restAim(const LoadedStudy& study) {
  const auto boxOf = [&study](const std::string& structure) {
    for (const auto& organ : study.organs) {
      if (organ->name == structure) {
        return geometry::bounds(organ->rig.rest.positions);
      }
    }
    for (const auto& piece : study.pieces) {
      if (piece->name == structure) {
        return geometry::bounds(piece->rig.rest.positions);
      }
    }
    return geometry::Box3d();
  };
  return {PosedSkins(study.body->body().skin.positions), boxOf};
}

base::Issues checkStudy(const std::filesystem::path& path, base::Threads threads, const base::Progress& progress) {
  study::Study study = study::loadStudy(path);
  base::Issues issues = study::checkInputs(study, path);
  if (!issues.empty()) {
    return issues;
  }
  const LoadedStudy loaded = load(std::move(study), path, threads, progress);
  issues = loaded.issues;
  base::append(issues, openStructures(loaded));
  if (loaded.study.sources.empty()) {
    issues.push_back({Severity::warning, path.string(), "/sources", "the study has no source to shoot from; add one"});
  }
  for (std::size_t s = 0; s < loaded.study.sources.size(); ++s) {
    try {
      base::Issues remarks;
      prepareSource(loaded, s, restAim(loaded), remarks);
      base::append(issues, std::move(remarks));
    } catch (const base::InputError& error) {
      issues.push_back({Severity::error, error.file(), error.place(), error.text()});
    }
  }
  base::append(issues, checkThreats(loaded, threads));
  base::append(issues, danglingReferences(loaded));
  for (const std::string& pose : defaultPoses(loaded.study)) {
    try {
      resolvePose(loaded, pose);
    } catch (const base::InputError& error) {
      issues.push_back({Severity::error, error.file(), error.place(), error.text()});
    }
  }
  return issues;
}

}  // namespace

base::Issues checkFile(const std::filesystem::path& path, base::Threads threads, const base::Progress& progress) {
  try {
    if (path.extension() == ".json") {
      return checkStudy(path, threads, progress);
    }
    if (isMotion(path)) {
      return checkMotion(path);
    }
    if (path.extension() == ".csv") {
      return checkCsv(path, progress);
    }
    return threat::isThreatFile(path) ? checkThreatFile(path, progress) : checkMesh(path);
  } catch (const base::InputError& error) {
    return {{Severity::error, error.file(), error.place(), error.text()}};
  }
}

}  // namespace lorica::analysis
