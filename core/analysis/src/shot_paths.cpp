#include "lorica/analysis/shot_paths.h"

#include <array>

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

ShotSource shotSourceFor(const LoadedStudy& study, std::size_t source, const PosedScene& scene) {
  const std::array skins{std::span<const geometry::Vec3f>(scene.body().skin)};
  base::Issues issues;
  return prepareSource(study, source, skins, issues);
}

std::vector<ShotPath> shotPaths(const PosedScene& scene, const shotline::PointSource& source, std::uint64_t seed,
                                std::size_t count) {
  const shotline::ShotGenerator shots(source, seed, 0);
  std::vector<raycast::Ray> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    rays.push_back(shots.shot(i));
  }
  std::vector<ShotPath> paths(count);
  raycast::Caster caster(scene.scene());
  caster.castMany(rays, [&](std::size_t i, std::span<const raycast::Hit> hits) {
    const double length = rays[i].direction.cast<double>().norm();
    ShotPath& path = paths[i];
    path.number = i;
    path.origin = rays[i].origin;
    path.direction = (rays[i].direction.cast<double>() / length).cast<float>();
    for (const raycast::Hit& hit : hits) {
      path.crossings.push_back({structureOfMesh(scene.layout(), hit.mesh), hit.t * length, hit.entering});
    }
  });
  return paths;
}

}  // namespace lorica::analysis
