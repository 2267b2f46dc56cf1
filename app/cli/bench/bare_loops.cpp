#include "bare_loops.h"

#include <embree3/rtcore.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace lorica::bench {

struct BareScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<RTCGeometry> geometries;
};

namespace {

struct StoredHit {
  float t;
  unsigned geometry;
  unsigned primitive;
};

struct StoringContext {
  RTCIntersectContext base;
  std::vector<StoredHit>* hits;
};

void store(const RTCFilterFunctionNArguments* arguments) {
  auto* context = reinterpret_cast<StoringContext*>(arguments->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  context->hits->push_back({ray->tfar, hit->geomID, hit->primID});
  arguments->valid[0] = 0;
}

RTCRayHit queryOf(const raycast::Ray& ray) {
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x();
  query.ray.org_y = ray.origin.y();
  query.ray.org_z = ray.origin.z();
  query.ray.dir_x = ray.direction.x();
  query.ray.dir_y = ray.direction.y();
  query.ray.dir_z = ray.direction.z();
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xFFFFFFFFU;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

BareScene::BareScene(const analysis::PosedScene& posed, Use use) : handles_(std::make_unique<Handles>()) {
  const bool dynamic = use != Use::rays;
  handles_->device = rtcNewDevice(nullptr);
  handles_->scene = rtcNewScene(handles_->device);
  const unsigned flags =
      static_cast<unsigned>(RTC_SCENE_FLAG_ROBUST) |
      static_cast<unsigned>(dynamic ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION) |
      static_cast<unsigned>(use == Use::compactFrames ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE);
  rtcSetSceneFlags(handles_->scene, static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(handles_->scene, dynamic ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
  for (std::size_t m = 0; m < posed.scene().meshes(); ++m) {
    const raycast::MeshIndex mesh{m};
    const raycast::MeshTopology& topology = posed.scene().topology(mesh);
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, dynamic ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, posed.scene().positions(mesh), 0,
                               sizeof(geometry::Vec3f), topology.vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, topology.triangles.data(), 0,
                               sizeof(geometry::Triangle), topology.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    handles_->geometries.push_back(geometry);
  }
  rtcCommitScene(handles_->scene);
}

BareScene::~BareScene() {
  rtcReleaseScene(handles_->scene);
  rtcReleaseDevice(handles_->device);
}

std::uint64_t BareScene::allHits(std::span<const raycast::Ray> rays, base::Threads threads) const {
  std::atomic<std::uint64_t> sum{0};
  base::parallelFor(rays.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<StoredHit> hits;
    std::uint64_t found = 0;
    for (std::size_t i = begin; i < end; ++i) {
      hits.clear();
      StoringContext context{};
      rtcInitIntersectContext(&context.base);
      context.base.filter = store;
      context.hits = &hits;
      RTCRayHit query = queryOf(rays[i]);
      rtcIntersect1(handles_->scene, &context.base, &query);
      std::sort(hits.begin(), hits.end(), [](const StoredHit& a, const StoredHit& b) { return a.t < b.t; });
      found += hits.size();
    }
    sum += found;
  });
  return sum;
}

std::uint64_t BareScene::reshoot(std::span<const raycast::Ray> rays, base::Threads threads) const {
  std::atomic<std::uint64_t> sum{0};
  base::parallelFor(rays.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<StoredHit> hits;
    std::uint64_t found = 0;
    for (std::size_t i = begin; i < end; ++i) {
      hits.clear();
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      float start = 0.0F;
      for (;;) {
        RTCRayHit query = queryOf(rays[i]);
        query.ray.tnear = start;
        rtcIntersect1(handles_->scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
          break;
        }
        hits.push_back({query.ray.tfar, query.hit.geomID, query.hit.primID});
        start = std::nextafter(query.ray.tfar, std::numeric_limits<float>::infinity());
      }
      found += hits.size();
    }
    sum += found;
  });
  return sum;
}

void BareScene::refit() {
  for (RTCGeometry geometry : handles_->geometries) {
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry);
  }
  rtcCommitScene(handles_->scene);
}

std::size_t bareParse(const std::filesystem::path& glb) {
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string errors;
  std::string warnings;
  loader.LoadBinaryFromFile(&model, &errors, &warnings, glb.string());
  return model.meshes.size();
}

}  // namespace lorica::bench
