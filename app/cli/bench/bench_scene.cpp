#include "bench_scene.h"

#include <algorithm>
#include <map>

#include "lorica/armor/plates.h"
#include "lorica/manikin/plain_human.h"

namespace lorica::bench {

namespace {

using geometry::Triangle;
using geometry::TriangleMesh;

/// Cuts every triangle into four at the middles of its sides.
struct Refined {
  TriangleMesh mesh;
  std::vector<std::array<std::uint32_t, 2>> parents;  // of every new vertex, in their order
};

Refined refine(const TriangleMesh& mesh) {
  Refined result;
  result.mesh.positions = mesh.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.mesh.positions.size()));
    if (isNew) {
      result.mesh.positions.emplace_back(0.5F * (mesh.positions[a] + mesh.positions[b]));
      result.parents.push_back({a, b});
    }
    return place->second;
  };
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]);
    const std::uint32_t bc = middle(t[1], t[2]);
    const std::uint32_t ca = middle(t[2], t[0]);
    result.mesh.triangles.insert(result.mesh.triangles.end(),
                                 {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  return result;
}

human::SkinWeights refine(const human::SkinWeights& weights, const Refined& refined) {
  std::vector<human::Influence> influences;
  const std::size_t stride = 2 * weights.influences;
  const auto add = [&](std::uint32_t vertex, double share) {
    for (std::size_t k = 0; k < weights.influences; ++k) {
      const std::size_t at = vertex * weights.influences + k;
      influences.push_back({weights.joints[at], share * static_cast<double>(weights.weights[at])});
    }
  };
  for (std::uint32_t v = 0; v < weights.vertices(); ++v) {
    add(v, 0.5);
    add(v, 0.5);
  }
  for (const auto& [a, b] : refined.parents) {
    add(a, 0.5);
    add(b, 0.5);
  }
  return human::normaliseWeights(influences, stride, 4).weights;
}

}  // namespace

analysis::LoadedStudy refinedSample(base::Threads threads) {
  const manikin::PlainHuman plain = manikin::plainHuman();
  analysis::LoadedStudy study;
  parenting::Body body;
  const Refined skin = refine(plain.skin);
  body.skin = skin.mesh;
  body.weights = refine(plain.weights, skin);
  body.skeleton = plain.skeleton;
  body.regions = human::bodyRegions(body.skin, *body.weights, *body.skeleton);
  study.clips = plain.clips;
  parenting::RigOptions options;
  options.thesisSites = false;
  study.body = std::make_shared<const parenting::BodyRig>(std::move(body), options, threads);
  for (const manikin::PlainOrgan& plainOrgan : plain.organs) {
    analysis::LoadedOrgan organ;
    organ.name = plainOrgan.name;
    organ.rig = viscera::bindOrgan(refine(plainOrgan.mesh).mesh, plainOrgan.name, *study.body, {}, threads);
    organ.topology = raycast::makeTopology(organ.rig.rest);
    study.organs.push_back(std::make_shared<const analysis::LoadedOrgan>(std::move(organ)));
  }
  study.study.systems.emplace_back().name = "plates";
  for (const armor::PlateSide side : {armor::PlateSide::front, armor::PlateSide::back}) {
    analysis::LoadedPiece piece;
    piece.name = side == armor::PlateSide::front ? "front_plate" : "back_plate";
    const armor::PlacedPlate placed =
        armor::placePlate(study.body->body().skin, &plain.skeleton, side, armor::mediumSapi());
    piece.rig = armor::bindPiece(refine(placed.mesh).mesh, piece.name, armor::Carriage::rigid, *study.body, nullptr,
                                 nullptr, threads);
    piece.topology = raycast::makeTopology(piece.rig.rest);
    study.pieces.push_back(std::make_shared<const analysis::LoadedPiece>(std::move(piece)));
    study.systemOfPiece.push_back(0);
  }
  return study;
}

}  // namespace lorica::bench
