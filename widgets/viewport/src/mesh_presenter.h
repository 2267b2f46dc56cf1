#pragma once

/// \file
/// Presenters of what is made of triangles: the skin, the organs of one model, the armor.

#include <string>
#include <vector>

#include "lorica/document/inspection.h"
#include "mesh_actor.h"
#include "presenter.h"

namespace lorica::viewport {

/// What the three have in common: a list of named meshes that move with the frame.
class MeshPresenter : public Presenter {
 public:
  using Presenter::Presenter;
  ~MeshPresenter() override;
  void showFrame(const std::shared_ptr<const jobs::Frame>& frame) final;
  void restyle(const document::StudyDocument& document) final;
  void drawCoarsely(const CoarseMeshes* meshes) final;

 protected:
  struct Mesh {
    std::string structure;
    std::span<const geometry::Triangle> triangles;
    std::span<const geometry::Vec3f> positions;
    std::span<const geometry::Vec3f> normals;
  };
  virtual std::vector<Mesh> meshesOf(const jobs::Frame& frame) const = 0;
  /// The colour of all of a mesh, where its vertices have none of their own.
  virtual QColor colourOf(const document::StudyDocument& document, const document::Appearance& look) const;
  const std::vector<std::unique_ptr<MeshActor>>& actors() const { return actors_; }

 private:
  void rebuild(const std::vector<Mesh>& meshes);

  std::shared_ptr<const jobs::Frame> frame_;
  std::vector<std::string> structures_;
  std::vector<std::unique_ptr<MeshActor>> actors_;
};

class SkinPresenter final : public MeshPresenter {
 public:
  using MeshPresenter::MeshPresenter;

 private:
  std::vector<Mesh> meshesOf(const jobs::Frame& frame) const override;
};

class OrganPresenter final : public MeshPresenter {
 public:
  /// \param model index into the frame's models
  OrganPresenter(vtkRenderer* renderer, std::size_t model) : MeshPresenter(renderer), model_(model) {}
  void showColours(const jobs::OrganColours* colours, const ColourScale& scale) override;

 private:
  std::vector<Mesh> meshesOf(const jobs::Frame& frame) const override;
  QColor colourOf(const document::StudyDocument& document, const document::Appearance& look) const override;
  std::size_t model_;
};

class ArmorPresenter final : public MeshPresenter {
 public:
  using MeshPresenter::MeshPresenter;

 private:
  std::vector<Mesh> meshesOf(const jobs::Frame& frame) const override;
};

}  // namespace lorica::viewport
