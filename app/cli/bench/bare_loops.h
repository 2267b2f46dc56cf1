#pragma once

/// \file
/// The same work done with bare libraries: what Lorica is measured against.

#include <filesystem>
#include <span>

#include "lorica/analysis/posed_scene.h"

namespace lorica::bench {

/// Embree by itself over the meshes of a posed scene; robust flag, as ours.
class BareScene {
 public:
  enum class Use {
    rays,           ///< built once
    frames,         ///< for refit()
    compactFrames,  ///< for refit() of leaves without vertices
  };
  BareScene(const analysis::PosedScene& posed, Use use);
  ~BareScene();
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  /// Stores all hits of each ray in a filter and sorts them. Returns their number.
  std::uint64_t allHits(std::span<const raycast::Ray> rays, base::Threads threads) const;
  /// Shoots the nearest-hit ray again from behind each hit until it leaves the scene. Returns the number of hits.
  std::uint64_t reshoot(std::span<const raycast::Ray> rays, base::Threads threads) const;
  /// Embree's refit alone.
  void refit();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

/// tinygltf's parse of a file, and nothing else. Returns the number of meshes.
std::size_t bareParse(const std::filesystem::path& glb);

}  // namespace lorica::bench
