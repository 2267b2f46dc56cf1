#include "lorica/analysis/shot_paths.h"

#include <algorithm>

#include "lorica/geometry/measures.h"
#include "prepare_source.h"

namespace lorica::analysis {

StructureRef structureOfMesh(const shotline::TargetLayout& layout, std::uint32_t mesh) {
  if (mesh == 0) {
    return {};
  }
  const std::size_t piece = mesh - 1;
  if (piece < layout.pieces()) {
    return {StructureRef::Kind::piece, piece, 0};
  }
  const std::size_t slot = piece - layout.pieces();
  return {StructureRef::Kind::organ, slot % layout.organs, slot / layout.organs};
}

namespace {

/// Box around an organ, in all models of a scene, or around a piece.
geometry::Box3d boxIn(const LoadedStudy& study, const PosedScene& scene, const std::string& structure) {
  geometry::Box3d box;
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    for (std::size_t m = 0; study.organs[o]->name == structure && m < scene.models().size(); ++m) {
      box.extend(geometry::bounds(scene.organ(o, m)));
    }
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    if (study.pieces[p]->name == structure) {
      box.extend(geometry::bounds(scene.piece(p)));
    }
  }
  return box;
}

}  // namespace

ShotSource shotSourceFor(const LoadedStudy& study, std::size_t source, const PosedScene& scene) {
  const Aim aim{PosedSkins(scene.body().skin),
                [&](const std::string& structure) { return boxIn(study, scene, structure); }};
  base::Issues issues;
  return prepareSource(study, source, aim, issues);
}

std::vector<ShotPath> shotPaths(const PosedScene& scene, const ShotSource& source, std::uint64_t seed,
                                std::size_t count) {
  const shotline::ShotGenerator shots(source.source, seed, 0);
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, source.shots));
  const std::uint64_t stride = source.source.sequence == shotline::Sequence::grid ? source.shots / count : 1;
  std::vector<raycast::Ray> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    rays.push_back(shots.shot(i * stride));
  }
  std::vector<ShotPath> paths(count);
  raycast::Caster caster(scene.scene());
  caster.castMany(rays, [&](std::size_t i, std::span<const raycast::Hit> hits) {
    const double length = rays[i].direction.cast<double>().norm();
    ShotPath& path = paths[i];
    path.number = i * stride;
    path.origin = rays[i].origin;
    path.direction = (rays[i].direction.cast<double>() / length).cast<float>();
    for (const raycast::Hit& hit : hits) {
      path.crossings.push_back({structureOfMesh(scene.layout(), hit.mesh), hit.t * length, hit.entering});
    }
  });
  return paths;
}

}  // namespace lorica::analysis
