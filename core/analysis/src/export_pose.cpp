#include "lorica/analysis/export_pose.h"

#include <array>

#include "lorica/analysis/posed_scene.h"

namespace lorica::analysis {

namespace {

// Told apart on a light and on a dark ground, and by readers who do not see red and green (after Okabe and Ito).
constexpr std::array<std::array<float, 4>, 8> palette = {{{0.74F, 0.14F, 0.08F, 1.0F},
                                                          {0.90F, 0.60F, 0.62F, 1.0F},
                                                          {0.35F, 0.12F, 0.08F, 1.0F},
                                                          {0.79F, 0.36F, 0.00F, 1.0F},
                                                          {0.00F, 0.34F, 0.53F, 1.0F},
                                                          {0.00F, 0.39F, 0.23F, 1.0F},
                                                          {0.60F, 0.19F, 0.40F, 1.0F},
                                                          {0.88F, 0.72F, 0.10F, 1.0F}}};

}  // namespace

std::string exportPose(const LoadedStudy& study, const std::string& pose, viscera::OrganModel model,
                       io::SceneFormat format, base::Threads threads) {
  const PosedScene posed(study, {model}, resolvePose(study, pose).pose, raycast::SceneUse::manyFrames, threads);
  std::vector<io::SceneMesh> scene;
  scene.push_back({"body", "body", posed.body().skin, study.body->body().skin.triangles, {0.80F, 0.61F, 0.50F, 0.35F}});
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    scene.push_back({study.organs[o]->name, "organ", posed.organ(o, 0), study.organs[o]->rig.rest.triangles,
                     palette[o % palette.size()]});
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    scene.push_back({study.pieces[p]->name,
                     "armor",
                     posed.piece(p),
                     study.pieces[p]->rig.rest.triangles,
                     {0.23F, 0.26F, 0.20F, 1.0F}});
  }
  return io::sceneBytes(scene, format);
}

}  // namespace lorica::analysis
