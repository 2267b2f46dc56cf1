#include "lorica/raycast/scene.h"

#include <mutex>

#include "embree.h"
#include "lorica/base/error.h"

namespace lorica::raycast {

namespace {

/// Embree's device, made when the first scene needs it and gone with the last one.
std::shared_ptr<RTCDeviceTy> sharedDevice() {
  static std::mutex mutex;
  static std::weak_ptr<RTCDeviceTy> known;
  const std::lock_guard lock(mutex);
  std::shared_ptr<RTCDeviceTy> device = known.lock();
  if (!device) {
#ifdef LORICA_PLAIN_THREADS
    device.reset(rtcNewDevice("threads=1,set_affinity=0"), rtcReleaseDevice);
#else
    device.reset(rtcNewDevice(nullptr), rtcReleaseDevice);
#endif
    if (!device) {
      throw base::Error("the ray tracer could not start");
    }
    known = device;
  }
  return device;
}

void throwOnFailure(RTCDevice device) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw base::Error("the ray tracer could not build its scene; there may be too little memory");
  }
}

}  // namespace

Scene::Impl::~Impl() {
  if (scene != nullptr) {
    rtcReleaseScene(scene);
  }
}

Scene::Scene(SceneUse use) : impl_(std::make_unique<Impl>()) {
  impl_->device = sharedDevice();
  impl_->use = use;
  impl_->scene = rtcNewScene(impl_->device.get());
  const bool frames = use == SceneUse::manyFrames;
  // A refit of compact leaves, which hold no vertices, takes far less time, as the bench prints; rays through them take
  // a little longer.
  auto flags = static_cast<unsigned>(RTC_SCENE_FLAG_ROBUST) |
               (frames ? unsigned{RTC_SCENE_FLAG_DYNAMIC} | unsigned{RTC_SCENE_FLAG_COMPACT} : 0U);
#if RTC_VERSION_MAJOR >= 4
  flags |= static_cast<unsigned>(RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
#else
  flags |= static_cast<unsigned>(RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
#endif
  rtcSetSceneFlags(impl_->scene, static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(impl_->scene, frames ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
}

Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

MeshIndex Scene::add(const geometry::Positions& positions, std::shared_ptr<const MeshTopology> topology) {
  LORICA_CHECK(topology != nullptr && positions.size() == topology->vertices, "positions fit the topology");
  RTCGeometry geometry = rtcNewGeometry(impl_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry,
                             impl_->use == SceneUse::manyFrames ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                             sizeof(geometry::Vec3f), positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, topology->triangles.data(), 0,
                             sizeof(geometry::Triangle), topology->triangles.size());
  rtcCommitGeometry(geometry);
  const unsigned id = rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  throwOnFailure(impl_->device.get());
  LORICA_CHECK(id == impl_->meshes.size(), "Embree numbers geometries in the order they come");
  impl_->meshes.push_back({positions.data(), std::move(topology), geometry});
  return MeshIndex{impl_->meshes.size() - 1};
}

void Scene::build() {
  rtcCommitScene(impl_->scene);
  throwOnFailure(impl_->device.get());
}

void Scene::refit() {
  std::vector<MeshIndex> all;
  for (std::size_t m = 0; m < impl_->meshes.size(); ++m) {
    all.emplace_back(m);
  }
  refit(all);
}

void Scene::refit(std::span<const MeshIndex> moved) {
  LORICA_CHECK(impl_->use == SceneUse::manyFrames, "the scene was not made for moving vertices");
  for (const MeshIndex mesh : moved) {
    rtcUpdateGeometryBuffer(impl_->meshes.at(mesh.value).geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(impl_->meshes[mesh.value].geometry);
  }
  build();
}

std::size_t Scene::meshes() const {
  return impl_->meshes.size();
}
const MeshTopology& Scene::topology(MeshIndex mesh) const {
  return *impl_->meshes.at(mesh.value).topology;
}
const geometry::Vec3f* Scene::positions(MeshIndex mesh) const {
  return impl_->meshes.at(mesh.value).positions;
}

}  // namespace lorica::raycast
