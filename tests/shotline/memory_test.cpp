#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "lorica/geometry/primitives.h"
#include "lorica/shotline/trace.h"

// Every allocation of this program is counted, so that the memory of a run is a number and not a guess.

namespace {

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> most{0};

void* taken(void* memory) {
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  const std::size_t now = held += malloc_usable_size(memory);
  std::size_t seen = most;
  while (now > seen && !most.compare_exchange_weak(seen, now)) {
  }
  return memory;
}

void givenBack(void* memory) noexcept {
  held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return taken(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return taken(std::aligned_alloc(static_cast<std::size_t>(alignment), size));
}
void operator delete(void* memory) noexcept {
  givenBack(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  givenBack(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  givenBack(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  givenBack(memory);
}

namespace lorica::shotline {
namespace {

/// Bytes that tracing takes at its peak.
std::size_t peakOf(std::uint64_t shots) {
  const geometry::TriangleMesh sphere = geometry::ellipsoid({0, 0, 0}, {1, 1, 1}, 4);
  raycast::Scene scene(raycast::SceneUse::manyRays);
  scene.add(sphere.positions, raycast::makeTopology(sphere));
  scene.build();
  const std::vector<std::uint16_t> regions(sphere.triangles.size(), 0);
  TargetLayout layout;
  layout.regionOfTriangle = regions;
  layout.regions = 1;
  PointSource point;
  point.position = {0, 0, 8};
  point.halfAngle = 0.16;
  const ShotGenerator generator({"front", point}, 1, 0);
  const std::size_t before = held;
  most = before;
  EXPECT_EQ(trace(scene, layout, generator, shots, {2}).tally.shots(), shots);
  return most - before;
}

TEST(Memory, OfATraceDoesNotGrowWithTheNumberOfShots) {
  constexpr std::uint64_t shots = CoherentBlock::mostShots;
  const std::size_t once = peakOf(shots);
  const std::size_t eightTimes = peakOf(8 * shots);
  EXPECT_GT(once, shots) << "the count sees what a block takes";
  EXPECT_LT(once, 64 * shots) << "60 bytes a shot, and little else";
  EXPECT_LT(eightTimes, once + (std::size_t{1} << 20));
}

}  // namespace
}  // namespace lorica::shotline
