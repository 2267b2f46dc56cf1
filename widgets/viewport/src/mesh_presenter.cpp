#include "mesh_presenter.h"

#include <vtkProperty.h>

#include "coarse_meshes.h"
#include "colour_scale.h"

namespace lorica::viewport {

namespace {

const QColor unknownColour(168, 172, 176);

}  // namespace

MeshPresenter::~MeshPresenter() {
  rebuild({});
}

void MeshPresenter::rebuild(const std::vector<Mesh>& meshes) {
  for (const auto& actor : actors_) {
    renderer()->RemoveActor(actor->actor());
  }
  actors_.clear();
  structures_.clear();
  for (const Mesh& mesh : meshes) {
    actors_.push_back(std::make_unique<MeshActor>(mesh.triangles));
    structures_.push_back(mesh.structure);
    renderer()->AddActor(actors_.back()->actor());
  }
}

void MeshPresenter::showFrame(const std::shared_ptr<const jobs::Frame>& frame) {
  const std::vector<Mesh> meshes = frame == nullptr ? std::vector<Mesh>{} : meshesOf(*frame);
  const bool sameStudy = frame != nullptr && frame_ != nullptr && frame->study == frame_->study;
  if (!sameStudy || meshes.size() != actors_.size()) {
    rebuild(meshes);
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    actors_[m]->show(meshes[m].positions, meshes[m].normals);
  }
  frame_ = frame;
}

void MeshPresenter::restyle(const document::StudyDocument& document) {
  const auto& selection = document.selection();
  for (std::size_t m = 0; m < actors_.size(); ++m) {
    const document::Appearance look = document::drawnAppearance(document, structures_[m]);
    const QColor colour = colourOf(document, look);
    vtkActor* actor = actors_[m]->actor();
    actor->SetVisibility(look.visible && look.opacity > 0.0 ? 1 : 0);
    vtkProperty* property = actor->GetProperty();
    const bool selected =
        selection && ((selection->kind == document::ItemKind::organ || selection->kind == document::ItemKind::piece) &&
                      selection->name == structures_[m]);
    property->SetColor(colour.redF(), colour.greenF(), colour.blueF());
    property->SetOpacity(look.opacity);
    // A selected structure glows a little, whatever its colour.
    const bool coloured = document.inspection().colouring != document::Colouring::own;
    // Where colours are numbers, light must not change them much.
    property->SetAmbient(coloured ? (selected ? 0.45 : 0.30) : (selected ? 0.55 : 0.15));
    property->SetDiffuse(coloured ? 0.70 : 0.85);
    property->SetAmbientColor(selected ? 1.0 : colour.redF(), selected ? 0.85 : colour.greenF(),
                              selected ? 0.2 : colour.blueF());
  }
}

void MeshPresenter::drawCoarsely(const CoarseMeshes* meshes) {
  for (const auto& actor : actors_) {
    actor->drawCoarsely(meshes == nullptr ? nullptr : meshes->of(actor->triangles()));
  }
}

QColor MeshPresenter::colourOf(const document::StudyDocument& /*document*/, const document::Appearance& look) const {
  return look.colour;
}

QColor OrganPresenter::colourOf(const document::StudyDocument& document, const document::Appearance& look) const {
  // A colour that says nothing, until there is one that does.
  return document.inspection().colouring == document::Colouring::own ? look.colour : unknownColour;
}

void OrganPresenter::showColours(const jobs::OrganColours* colours, const ColourScale& scale) {
  for (std::size_t m = 0; m < actors().size(); ++m) {
    std::vector<MeshActor::Rgb> rgb;
    if (colours != nullptr && !colours->values.empty()) {
      const std::vector<float>& values = colours->values[model_ * actors().size() + m];
      rgb.reserve(values.size());
      for (const float value : values) {
        const QColor colour = scale.at(value);
        rgb.push_back({static_cast<unsigned char>(colour.red()), static_cast<unsigned char>(colour.green()),
                       static_cast<unsigned char>(colour.blue())});
      }
    }
    actors()[m]->colourVertices(rgb);
  }
}

std::vector<MeshPresenter::Mesh> SkinPresenter::meshesOf(const jobs::Frame& frame) const {
  return {{"body", frame.study->body->body().skin.triangles, frame.scene->body().skin, frame.skinNormals}};
}

std::vector<MeshPresenter::Mesh> OrganPresenter::meshesOf(const jobs::Frame& frame) const {
  std::vector<Mesh> meshes;
  const auto& organs = frame.study->organs;
  for (std::size_t o = 0; o < organs.size(); ++o) {
    meshes.push_back({organs[o]->name, organs[o]->rig.rest.triangles, frame.scene->organ(o, model_),
                      frame.organNormals[model_ * organs.size() + o]});
  }
  return meshes;
}

std::vector<MeshPresenter::Mesh> ArmorPresenter::meshesOf(const jobs::Frame& frame) const {
  std::vector<Mesh> meshes;
  for (std::size_t p = 0; p < frame.study->pieces.size(); ++p) {
    const analysis::LoadedPiece& piece = *frame.study->pieces[p];
    meshes.push_back({piece.name, piece.rig.rest.triangles, frame.scene->piece(p), frame.pieceNormals[p]});
  }
  return meshes;
}

}  // namespace lorica::viewport
