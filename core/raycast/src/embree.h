#pragma once

/// \file
/// The differences between Embree 3 and 4, in one place.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <vector>

#include "lorica/raycast/scene.h"

namespace lorica::raycast {

struct Scene::Impl {
  struct Mesh {
    const geometry::Vec3f* positions;
    std::shared_ptr<const MeshTopology> topology;
    RTCGeometry geometry;
  };

  ~Impl();
  std::shared_ptr<RTCDeviceTy> device;
  RTCScene scene = nullptr;
  SceneUse use = SceneUse::manyRays;
  std::vector<Mesh> meshes;
};

struct SceneAccess {
  static const Scene::Impl& of(const Scene& scene) { return *scene.impl_; }
};

}  // namespace lorica::raycast
