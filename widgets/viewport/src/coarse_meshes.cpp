#include "coarse_meshes.h"

#include "coarse_triangles.h"

namespace lorica::viewport {

namespace {

std::vector<const geometry::TriangleMesh*> meshesOf(const analysis::LoadedStudy& study) {
  std::vector<const geometry::TriangleMesh*> meshes{&study.body->body().skin};
  for (const auto& organ : study.organs) {
    meshes.push_back(&organ->rig.rest);
  }
  for (const auto& piece : study.pieces) {
    meshes.push_back(&piece->rig.rest);
  }
  std::erase_if(meshes, [](const geometry::TriangleMesh* mesh) { return mesh->triangles.empty(); });
  return meshes;
}

}  // namespace

void CoarseMeshes::setStudy(std::shared_ptr<const analysis::LoadedStudy> study) {
  if (study == study_) {
    return;
  }
  if (job_ != nullptr) {
    // Nobody waits for the mesh it is at.
    jobs::Job* job = job_.release();
    job->disconnect(this);
    job->setParent(this);
    connect(job, &jobs::Job::ended, job, &QObject::deleteLater);
    job->cancel();
  }
  Found kept;
  if (study != nullptr) {
    // The study before still holds its meshes, so equal places are the same mesh.
    for (const geometry::TriangleMesh* mesh : meshesOf(*study)) {
      if (const auto known = found_.find(mesh->triangles.data()); known != found_.end()) {
        kept.insert(*known);
      }
    }
  }
  found_ = std::move(kept);
  study_ = std::move(study);
}

void CoarseMeshes::make() {
  if (study_ == nullptr || job_ != nullptr) {
    return;
  }
  std::vector<const geometry::TriangleMesh*> missing = meshesOf(*study_);
  std::erase_if(missing,
                [this](const geometry::TriangleMesh* mesh) { return found_.contains(mesh->triangles.data()); });
  if (missing.empty()) {
    return;
  }
  auto made = std::make_shared<Found>();
  job_ = std::make_unique<jobs::Job>(QString(), [study = study_, missing, made](const base::Progress& progress) {
    for (const geometry::TriangleMesh* mesh : missing) {
      progress.check();
      std::vector<geometry::Triangle> coarse = coarseTriangles(mesh->positions, mesh->triangles);
      const bool fewer = coarse.size() < mesh->triangles.size();
      made->emplace(mesh->triangles.data(),
                    fewer ? std::make_shared<const std::vector<geometry::Triangle>>(std::move(coarse)) : nullptr);
    }
  });
  connect(job_.get(), &jobs::Job::finished, this, [this, made] {
    found_.merge(*made);
    Q_EMIT this->made();
  });
  connect(job_.get(), &jobs::Job::ended, this, [this] { job_.release()->deleteLater(); });
  job_->start();
}

CoarseMeshes::Triangles CoarseMeshes::of(std::span<const geometry::Triangle> triangles) const {
  const auto found = found_.find(triangles.data());
  return found == found_.end() ? nullptr : found->second;
}

}  // namespace lorica::viewport
