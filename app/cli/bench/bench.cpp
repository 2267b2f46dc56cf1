#include "bench.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "bare_loops.h"
#include "bench_scene.h"
#include "lorica/analysis/directions.h"
#include "lorica/analysis/hashed_model.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/io/export.h"
#include "lorica/shotline/trace.h"
#include "tree_loops.h"

namespace lorica::bench {

namespace {

constexpr int repetitions = 7;
constexpr std::uint64_t rayCount = 1000000;

template <class Work>
double secondsOf(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median over interleaved runs of a's time over b's.
template <class First, class Second>
std::array<double, 3> interleaved(const First& first, const Second& second, const base::Progress& progress) {
  std::vector<double> ratios;
  std::vector<double> firstTimes;
  std::vector<double> secondTimes;
  first();  // warm caches and buffers
  second();
  for (int r = 0; r < repetitions; ++r) {
    progress.check();
    firstTimes.push_back(secondsOf(first));
    secondTimes.push_back(secondsOf(second));
    ratios.push_back(firstTimes.back() / secondTimes.back());
    progress.report((r + 1.0) / repetitions);
  }
  return {median(ratios), median(firstTimes), median(secondTimes)};
}

/// Keeps a result alive that nobody reads.
volatile std::uint64_t sink = 0;

shotline::ShotGenerator shotsAt(const analysis::PosedScene& posed) {
  shotline::PointSource source;
  const geometry::Box3d box = geometry::bounds(posed.body().skin);
  source.target = box.center();
  source.position = box.center() + geometry::Vec3d(0, 0, 5);
  const std::span<const geometry::Vec3f> skin(posed.body().skin);
  source.halfAngle = shotline::boundingHalfAngle(source.position, source.target, std::span(&skin, 1));
  return {{"front", source}, 1, 0};
}

void measureShots(Report& report, const analysis::PosedScene& posed, base::Threads threads,
                  const base::Progress& progress) {
  const shotline::ShotGenerator shots = shotsAt(posed);
  std::vector<raycast::Ray> rays(rayCount);
  shots.shots(0, rays);
  const BareScene bare(posed, BareScene::Use::rays);
  const auto ours = [&] {
    sink = sink + shotline::trace(posed.scene(), posed.layout(), shots, rayCount, threads).tally.body(0).any;
  };
  const auto against = [&](const char* name, double bar, const char* meaning, const auto& loop,
                           const base::Progress& share) {
    const auto [ratio, mine, theirs] = interleaved(ours, loop, share);
    report.ratios.push_back({name, 1.0 / ratio, bar, true, meaning});
    report.rates.emplace_back(std::string(name) + "_ours_rays_per_s", static_cast<double>(rayCount) / mine);
    report.rates.emplace_back(std::string(name) + "_bare_rays_per_s", static_cast<double>(rayCount) / theirs);
  };
  against(
      "shotline_vs_bare_all_hits", 0.85, "shots sampled, traced, paired and counted, per bare Embree all-hits ray",
      [&] { sink = sink + bare.allHits(rays, threads); }, progress.part(0.0, 0.5));
  against(
      "shotline_vs_reshoot", 1.25, "the same, per ray shot again from behind each nearest hit",
      [&] { sink = sink + bare.reshoot(rays, threads); }, progress.part(0.5, 1.0));
}

/// Against the trees of other libraries: fewer rays, one thread on either side.
void measureTrees(Report& report, const analysis::PosedScene& posed, const base::Progress& progress) {
  const shotline::ShotGenerator shots = shotsAt(posed);
  const auto against = [&](const char* name, std::uint64_t count, const char* meaning, const auto& tree,
                           const base::Progress& share) {
    std::vector<raycast::Ray> rays(count);
    shots.shots(0, rays);
    raycast::Caster caster(posed.scene());
    std::uint64_t expected = 0;
    caster.castMany(rays, [&](std::size_t, std::span<const raycast::Hit> hits) { expected += hits.size(); });
    std::uint64_t found = 0;
    const auto [ratio, mine, theirs] = interleaved(
        [&] { sink = sink + shotline::trace(posed.scene(), posed.layout(), shots, count, {1}).tally.body(0).any; },
        [&] { found = tree.allHits(rays); }, share);
    report.ratios.push_back({name, 1.0 / ratio, std::nullopt, true, meaning});
    report.rates.emplace_back(std::string(name) + "_ours_rays_per_s", static_cast<double>(count) / mine);
    report.rates.emplace_back(std::string(name) + "_tree_rays_per_s", static_cast<double>(count) / theirs);
    report.rates.emplace_back(std::string(name) + "_ours_hits", static_cast<double>(expected));
    report.rates.emplace_back(std::string(name) + "_tree_hits", static_cast<double>(found));
  };
  if (CgalTree::available()) {
    against("shotline_vs_cgal_tree", 50000, "shot-line run per CGAL AABB-tree all-intersections ray, one thread each",
            CgalTree(posed), progress.part(0.0, 0.5));
  } else {
    report.notes.emplace_back("no ratio to a CGAL tree: CGAL was not there when this program was built");
  }
  against("shotline_vs_vtk_obbtree", 100, "the same, per ray through a vtkOBBTree of each mesh", VtkTrees(posed),
          progress.part(0.5, 1.0));
}

/// One frame of a study against Embree's refit of the same scene.
void measureFrames(Report& report, const analysis::LoadedStudy& study, Ratio wanted, const std::string& rate,
                   base::Threads threads, const base::Progress& progress) {
  analysis::PosedScene posed(study, {viscera::OrganModel::dynamic}, std::nullopt, raycast::SceneUse::manyFrames,
                             threads);
  BareScene bare(posed, BareScene::Use::frames);
  BareScene compact(posed, BareScene::Use::compactFrames);
  const human::Clip& clip = study.clips.front();
  int frame = 0;
  const auto ours = [&] {
    const double seconds = clip.duration() * (frame++ % 30) / 30.0;
    posed.move(human::sample(clip, *study.body->body().skeleton, seconds), threads);
  };
  const auto tenTimes = [](const auto& work) {
    return [&work] {
      for (int i = 0; i < 10; ++i)
        work();
    };
  };
  const auto refit = [&] { bare.refit(); };
  const auto compactRefit = [&] { compact.refit(); };
  const auto [ratio, mine, theirs] = interleaved(tenTimes(ours), tenTimes(refit), progress.part(0.0, 0.8));
  const double compactTime = interleaved(tenTimes(compactRefit), tenTimes(refit), progress.part(0.8, 1.0))[1];
  wanted.value = ratio;
  report.ratios.push_back(std::move(wanted));
  report.rates.emplace_back(rate + "_ours_ms", 100.0 * mine);
  report.rates.emplace_back(rate + "_bare_refit_ms", 100.0 * theirs);
  report.rates.emplace_back(rate + "_bare_compact_refit_ms", 100.0 * compactTime);
}

/// A motion of a study, frame by frame with 100,000 shots at each, against the shots alone.
void measureMotion(Report& report, analysis::LoadedStudy study, base::Threads threads, const base::Progress& progress) {
  constexpr std::uint64_t shots = 100000;
  constexpr double frames = 12.0;
  const human::Clip& clip = study.clips.front();
  study.study.models = {viscera::OrganModel::dynamic};
  study.study.analyses.motion = {clip.name, 1, (frames - 1.0) / clip.duration()};
  study.study.sources.resize(1);
  analysis::RunOptions options;
  options.trials = 1;
  options.shots = shots;
  options.threads = threads;
  const analysis::PosedScene posed(study, study.study.models, std::nullopt, raycast::SceneUse::manyFrames, threads);
  const shotline::ShotGenerator generator = shotsAt(posed);
  const auto [ratio, mine, theirs] = interleaved(
      [&] { sink = sink + analysis::overMotion(study, options).frames.size(); },
      [&] {
        for (int frame = 0; frame < static_cast<int>(frames); ++frame) {
          sink = sink + shotline::trace(posed.scene(), posed.layout(), generator, shots, threads).tally.body(0).any;
        }
      },
      progress);
  report.ratios.push_back({"motion_vs_shots", ratio, std::nullopt, false,
                           "a motion, 100,000 shots a frame: planned, posed, refitted, shot and counted, per its shots "
                           "alone"});
  report.rates.emplace_back("motion_frame_ours_ms", 1000.0 * mine / frames);
  report.rates.emplace_back("motion_frame_shots_ms", 1000.0 * theirs / frames);
}

/// What it takes to tie the organs to the body.
void measureBinding(Report& report, const analysis::LoadedStudy& study, base::Threads threads) {
  std::uint64_t vertices = 0;
  const double seconds = secondsOf([&] {
    std::vector<viscera::OrganRig> rigs;
    std::vector<viscera::SoftOrgan> organs;
    for (const auto& organ : study.organs) {
      rigs.push_back(viscera::bindOrgan(organ->rig.rest, organ->name, *study.body, {}, threads));
      organs.push_back({organ->name, &organ->rig.rest});
      vertices += organ->rig.rest.positions.size();
    }
    sink = sink + viscera::SoftBody(organs, *study.body, {}, threads).cells();
  });
  report.rates.emplace_back("bind_organs_ms", 1000.0 * seconds);
  report.rates.emplace_back("bind_organs_vertices", static_cast<double>(vertices));
}

void measureImport(Report& report, const analysis::LoadedStudy& study, const base::Progress& progress) {
  // One mesh of 100,000 triangles or a few more: the skin, then organs.
  geometry::TriangleMesh mesh = study.body->body().skin;
  for (std::size_t o = 0; o < study.organs.size() && mesh.triangles.size() < 100000; ++o) {
    geometry::append(mesh, study.organs[o]->rig.rest);
  }
  const std::filesystem::path glb =
      std::filesystem::temp_directory_path() / fmt::format("lorica-bench-{}.glb", ::getpid());
  const io::SceneMesh scene{"body", "body", mesh.positions, mesh.triangles};
  // Memory once had stays with the program, so that neither side waits for the system to hand it out and take it back.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  io::writeScene(std::span(&scene, 1), io::SceneFormat::glb, glb);
  constexpr int rounds = 20;  // one import is too short to be timed by itself
  const auto repeated = [&](const auto& work) {
    return [&] {
      for (int i = 0; i < rounds; ++i) {
        sink = sink + work();
      }
    };
  };
  const auto ours = [&] { return analysis::importHashed(glb).model.parts.size(); };
  const auto bare = [&] { return bareParse(glb); };
  const auto [ratio, mine, theirs] = interleaved(repeated(ours), repeated(bare), progress);
  std::filesystem::remove(glb);
  report.ratios.push_back(
      {"import_vs_bare_parse", ratio, 10.0, false, "a GLB hashed, checked, welded and built, per bare tinygltf parse"});
  report.rates.emplace_back("import_triangles", static_cast<double>(mesh.triangles.size()));
  report.rates.emplace_back("import_ours_ms", 1000.0 * mine / rounds);
  report.rates.emplace_back("import_bare_parse_ms", 1000.0 * theirs / rounds);
}

}  // namespace

Report measure(const base::Progress& progress) {
  Report report;
  report.threads = std::min(2, base::machineThreads());
  report.rays = rayCount;
  const base::Threads threads{report.threads};
  const analysis::LoadedStudy study = sampleScene(viscera::Deformer::softBody, threads);
  progress.report(0.1);
  {
    const analysis::PosedScene posed(study, {viscera::OrganModel::dynamic}, std::nullopt, raycast::SceneUse::manyRays,
                                     threads);
    report.triangles = posed.triangles();
    measureShots(report, posed, threads, progress.part(0.1, 0.6));
    measureTrees(report, posed, progress.part(0.6, 0.7));
  }
  measureFrames(report, sampleScene(viscera::Deformer::lattice, threads, &study),
                {"frame_vs_refit", 0.0, 1.6, false,
                 "skin, organs and armor posed and refitted, organs by plain lattices, per Embree refit alone"},
                "frame", threads, progress.part(0.7, 0.77));
  measureFrames(report, study,
                {"frame_full_vs_refit", 0.0, 5.0, false, "the same with organs that keep their volume and contacts"},
                "frame_full", threads, progress.part(0.77, 0.85));
  measureMotion(report, study, threads, progress.part(0.85, 0.95));
  measureBinding(report, study, threads);
  measureImport(report, study, progress.part(0.95, 1.0));
  return report;
}

}  // namespace lorica::bench
