/// \file
/// Parts of the engine, one by one, on the scene that `lorica-cli bench` measures or on that of a study:
/// lorica_benchmarks [STUDY [CLIP]] [--benchmark_...].

#include <benchmark/benchmark.h>

#include "bare_loops.h"
#include "bench_scene.h"
#include "lorica/geometry/measures.h"
#include "lorica/shotline/trace.h"
#include "lorica/study/study_file.h"

namespace {

using namespace lorica;

constexpr std::uint64_t shotsPerRound = 200000;

std::optional<std::filesystem::path> askedStudy;
std::string askedClip;

const analysis::LoadedStudy& sample() {
  static const analysis::LoadedStudy study = askedStudy
                                                 ? analysis::load(study::loadStudy(*askedStudy), *askedStudy, {2})
                                                 : bench::sampleScene(viscera::Deformer::softBody, {2});
  return study;
}

const human::Clip& sampleClip() {
  const auto& clips = sample().clips;
  const auto asked =
      std::find_if(clips.begin(), clips.end(), [](const human::Clip& clip) { return clip.name == askedClip; });
  return asked == clips.end() ? clips.front() : *asked;
}

shotline::Source frontOf(const analysis::PosedScene& posed) {
  shotline::PointSource source;
  source.target = geometry::bounds(posed.body().skin).center();
  source.position = source.target + geometry::Vec3d(0, 0, 5);
  const std::span<const geometry::Vec3f> skin(posed.body().skin);
  source.halfAngle = shotline::boundingHalfAngle(source.position, source.target, std::span(&skin, 1));
  return {"front", source};
}

void countRays(benchmark::State& state) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(shotsPerRound));
}

void traceAndCount(benchmark::State& state) {
  const analysis::PosedScene posed(sample(), {viscera::OrganModel::dynamic}, std::nullopt, raycast::SceneUse::manyRays,
                                   {2});
  const shotline::ShotGenerator shots(frontOf(posed), 1, 0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(shotline::trace(posed.scene(), posed.layout(), shots, shotsPerRound, {2}));
  }
  countRays(state);
}
BENCHMARK(traceAndCount)->Unit(benchmark::kMillisecond)->UseRealTime();

void bareAllHits(benchmark::State& state) {
  const analysis::PosedScene posed(sample(), {viscera::OrganModel::dynamic}, std::nullopt, raycast::SceneUse::manyRays,
                                   {2});
  const shotline::ShotGenerator shots(frontOf(posed), 1, 0);
  std::vector<raycast::Ray> rays;
  for (std::uint64_t i = 0; i < shotsPerRound; ++i) {
    rays.push_back(shots.shot(i));
  }
  const bench::BareScene bare(posed, bench::BareScene::Use::rays);
  for (auto _ : state) {
    benchmark::DoNotOptimize(bare.allHits(rays, {2}));
  }
  countRays(state);
}
BENCHMARK(bareAllHits)->Unit(benchmark::kMillisecond)->UseRealTime();

void poseFrames(benchmark::State& state, const analysis::LoadedStudy& study) {
  analysis::PosedScene posed(study, {viscera::OrganModel::dynamic}, std::nullopt, raycast::SceneUse::manyFrames, {2});
  const human::Clip& clip = sampleClip();
  int frame = 0;
  for (auto _ : state) {
    posed.move(human::sample(clip, *study.body->body().skeleton, clip.duration() * (frame++ % 30) / 30.0), {2});
  }
}
void poseFrame(benchmark::State& state) {
  poseFrames(state, sample());
}
BENCHMARK(poseFrame)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same with a plain lattice for each organ.
void poseFramePlain(benchmark::State& state) {
  study::Study plain = sample().study;
  plain.deformer = viscera::Deformer::lattice;
  analysis::LoadOptions options;
  options.previous = &sample();
  const analysis::LoadedStudy study = analysis::load(std::move(plain), askedStudy.value_or("sample"), {2}, {}, options);
  poseFrames(state, study);
}
BENCHMARK(poseFramePlain)->Unit(benchmark::kMillisecond)->UseRealTime();

parenting::PosedBody bodyAtHalfClip() {
  const human::Clip& clip = sampleClip();
  return sample().body->pose(human::sample(clip, *sample().body->body().skeleton, clip.duration() / 2), {2});
}

void poseBody(benchmark::State& state) {
  const human::Clip& clip = sampleClip();
  const human::Pose pose = human::sample(clip, *sample().body->body().skeleton, clip.duration() / 2);
  parenting::PosedBody posed;
  for (auto _ : state) {
    sample().body->poseInto(pose, {2}, posed);
  }
}
BENCHMARK(poseBody)->Unit(benchmark::kMillisecond)->UseRealTime();

void poseArmor(benchmark::State& state) {
  const human::Clip& clip = sampleClip();
  const human::Pose pose = human::sample(clip, *sample().body->body().skeleton, clip.duration() / 2);
  const parenting::PosedBody body = sample().body->pose(pose, {2});
  std::vector<geometry::Positions> posed;
  for (const auto& piece : sample().pieces) {
    posed.emplace_back(piece->rig.rest.positions.size());
  }
  for (auto _ : state) {
    for (std::size_t p = 0; p < posed.size(); ++p) {
      armor::posePiece(sample().pieces[p]->rig, body, posed[p], {2});
    }
  }
}
BENCHMARK(poseArmor)->Unit(benchmark::kMillisecond)->UseRealTime();

void placeOrgans(benchmark::State& state) {
  const parenting::PosedBody body = bodyAtHalfClip();
  const std::vector<geometry::Vec3f> offsets = sample().softBody->settle(body, {2});
  std::vector<geometry::Positions> posed;
  for (const auto& organ : sample().organs) {
    posed.emplace_back(organ->rig.rest.positions.size());
  }
  for (auto _ : state) {
    for (std::size_t o = 0; o < posed.size(); ++o) {
      sample().softBody->place(o, sample().organs[o]->rig.rest.positions, offsets, body, posed[o], {2});
    }
  }
}
BENCHMARK(placeOrgans)->Unit(benchmark::kMillisecond)->UseRealTime();

void bindOrgans(benchmark::State& state) {
  for (auto _ : state) {
    for (const auto& organ : sample().organs) {
      benchmark::DoNotOptimize(viscera::bindOrgan(organ->rig.rest, organ->name, *sample().body, {}, {2}));
    }
  }
}
void bindSoftBody(benchmark::State& state) {
  std::vector<viscera::SoftOrgan> organs;
  for (const auto& organ : sample().organs) {
    organs.push_back({organ->name, &organ->rig.rest});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(viscera::SoftBody(organs, *sample().body, {}, {2}).cells());
  }
}
BENCHMARK(bindSoftBody)->Unit(benchmark::kMillisecond)->UseRealTime();

void settleSoftBody(benchmark::State& state) {
  const parenting::PosedBody pose = bodyAtHalfClip();
  for (auto _ : state) {
    benchmark::DoNotOptimize(sample().softBody->settle(pose, {2}));
  }
}
BENCHMARK(settleSoftBody)->Unit(benchmark::kMillisecond)->UseRealTime();

BENCHMARK(bindOrgans)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc > 1) {
    askedStudy = argv[1];
  }
  if (argc > 2) {
    askedClip = argv[2];
  }
  benchmark::RunSpecifiedBenchmarks();
}
