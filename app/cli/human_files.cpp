#include "human_files.h"

#include <array>
#include <string_view>

#include "lorica/io/model_writer.h"

namespace lorica::cli {

namespace {

using Colour = std::array<float, 4>;

constexpr Colour skinColour{0.60F, 0.38F, 0.27F, 1.0F};
constexpr Colour clothColour{0.10F, 0.12F, 0.07F, 1.0F};
constexpr Colour hardColour{0.16F, 0.16F, 0.15F, 1.0F};

/// Linear, after the colours of anatomical atlases.
Colour organColour(std::string_view name) {
  struct Known {
    std::string_view begin;
    Colour colour;
  };
  static constexpr std::array<Known, 17> known{{
      {"heart", {0.45F, 0.05F, 0.05F, 1.0F}},
      {"lung", {0.70F, 0.35F, 0.35F, 1.0F}},
      {"liver", {0.30F, 0.07F, 0.04F, 1.0F}},
      {"stomach", {0.62F, 0.32F, 0.25F, 1.0F}},
      {"kidney", {0.33F, 0.08F, 0.06F, 1.0F}},
      {"spleen", {0.25F, 0.05F, 0.10F, 1.0F}},
      {"pancreas", {0.70F, 0.50F, 0.25F, 1.0F}},
      {"small_intestine", {0.72F, 0.42F, 0.34F, 1.0F}},
      {"large_intestine", {0.60F, 0.38F, 0.26F, 1.0F}},
      {"trachea", {0.70F, 0.66F, 0.55F, 1.0F}},
      {"bladder", {0.70F, 0.60F, 0.25F, 1.0F}},
      {"brain", {0.68F, 0.45F, 0.42F, 1.0F}},
      {"spinal_cord", {0.75F, 0.68F, 0.35F, 1.0F}},
      {"thyroid", {0.50F, 0.12F, 0.10F, 1.0F}},
      {"eyes", {0.85F, 0.85F, 0.82F, 1.0F}},
      {"arteries", {0.55F, 0.02F, 0.02F, 1.0F}},
      {"veins", {0.05F, 0.08F, 0.40F, 1.0F}},
  }};
  for (const Known& one : known) {
    if (name.starts_with(one.begin)) {
      return one.colour;
    }
  }
  return {0.5F, 0.3F, 0.3F, 1.0F};
}

std::string bodyBytes(const manikin::Human& human) {
  const manikin::Body& body = human.body;
  return io::modelBytes({{{{"skin", "body", body.skin.positions, body.skin.triangles, skinColour}, &body.weights}},
                         &body.skeleton,
                         human.clips});
}

std::string organBytes(const manikin::Organ& organ) {
  return io::modelBytes(
      {{{{organ.name, "organ", organ.mesh.positions, organ.mesh.triangles, organColour(organ.name)}}}, nullptr, {}});
}

/// What follows the skin has the body's joints; what rides on it is plain.
std::string pieceBytes(const manikin::ArmorPiece& piece, const human::Skeleton& skeleton) {
  const bool soft = piece.weights.has_value();
  return io::modelBytes({{{{piece.name, "armor", piece.mesh.positions, piece.mesh.triangles,
                            piece.carriage == armor::Carriage::skinned ? clothColour : hardColour},
                           soft ? &*piece.weights : nullptr,
                           piece.protecting}},
                         soft ? &skeleton : nullptr,
                         {}});
}

}  // namespace

std::vector<base::FileBytes> humanFiles(const manikin::Human& human, const std::filesystem::path& folder,
                                        const base::Progress& progress) {
  std::vector<base::FileBytes> files;
  files.push_back({folder / "body.glb", bodyBytes(human)});
  for (const manikin::Organ& organ : human.organs) {
    progress.check();
    files.push_back({folder / "organs" / (organ.name + ".glb"), organBytes(organ)});
  }
  progress.report(0.5);
  for (const manikin::ArmorSystem& system : human.systems) {
    for (const manikin::ArmorPiece& piece : system.pieces) {
      progress.check();
      files.push_back({folder / "armor" / system.name / (piece.name + ".glb"), pieceBytes(piece, human.body.skeleton)});
    }
  }
  progress.check();
  files.push_back({folder / "facts.json", humanFacts(human)});
  progress.report(1.0);
  return files;
}

}  // namespace lorica::cli
