#include "lorica/analysis/gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>

#include "lorica/analysis/posed_scene.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/units.h"
#include "lorica/geometry/closest_point.h"
#include "lorica/io/export.h"
#include "lorica/shotline/trace.h"

namespace lorica::analysis {

using geometry::Vec3d;

namespace {

/// What the run watches: for each structure of the study's `gaps` the place of its counts, model by model.
struct Watch {
  std::vector<shotline::WatchedStructure> structures;
  std::vector<std::vector<std::size_t>> countsOf;
};

Watch watchOf(const LoadedStudy& study, std::size_t models) {
  Watch watch;
  for (const std::string& name : study.study.analyses.gaps->structures) {
    const auto organ = std::find_if(study.organs.begin(), study.organs.end(),
                                    [&](const auto& candidate) { return candidate->name == name; });
    std::vector<std::size_t>& places = watch.countsOf.emplace_back();
    for (std::size_t m = 0; m < models; ++m) {
      if (organ != study.organs.end()) {
        places.push_back(watch.structures.size());
        watch.structures.push_back({static_cast<std::size_t>(organ - study.organs.begin()), m});
      } else {
        places.push_back(m == 0 ? watch.structures.size() : places.front());
        if (m == 0) {
          watch.structures.push_back({});
        }
      }
    }
  }
  return watch;
}

/// One source at one posed scene, with all its shots counted.
struct Block {
  const LoadedStudy& study;
  const RunResult& result;
  const PosedScene& scene;
  const Watch& watch;
  const std::vector<shotline::GapCounts>& counts;
  const std::vector<std::uint64_t>& entries;
  std::size_t source;
  std::size_t pose;
};

/// Counts pose by pose and source by source and hands each to `use`.
void forEachBlock(const LoadedStudy& study, const RunResult& result, base::Threads threads,
                  const base::Progress& progress, const std::function<void(const Block&)>& use) {
  const Watch watch = watchOf(study, result.models.size());
  const std::size_t steps = result.poses.size() * result.sources.size();
  for (std::size_t p = 0; p < result.poses.size(); ++p) {
    const PosedScene scene(study, result.models, resolvePose(study, result.poses[p]).pose, raycast::SceneUse::manyRays,
                           threads);
    for (std::size_t s = 0; s < result.sources.size(); ++s) {
      const SourcePoseResult& run = result.results[s * result.poses.size() + p];
      shotline::GapCounter counter(scene.scene(), scene.layout(), watch.structures);
      const double step = static_cast<double>(p * result.sources.size() + s);
      for (std::uint32_t trial = 0; trial < run.trials.size(); ++trial) {
        const double trials = static_cast<double>(run.trials.size());
        const shotline::ShotGenerator shots(result.sources[s].source, result.seed, trial);
        shotline::observeShots(scene.scene(), shots, {0, result.sources[s].shots}, threads,
                               progress.part((step + trial / trials) / static_cast<double>(steps),
                                             (step + (trial + 1) / trials) / static_cast<double>(steps)),
                               counter);
      }
      use({study, result, scene, watch, counter.counts(), counter.entries(), s, p});
    }
  }
}

/// The pieces of a posed scene, to measure distances to.
class Pieces {
 public:
  explicit Pieces(const Block& block) : block_(block), trees_(block.study.pieces.size()) {}

  std::vector<Gap::Neighbour> near(const shotline::OpenPatch& patch, std::size_t system) {
    std::vector<Gap::Neighbour> found;
    for (std::size_t p = 0; p < trees_.size(); ++p) {
      if (block_.study.systemOfPiece[p] + 1 != system) {
        continue;
      }
      double nearest = neighbourReach;
      bool reached = false;
      for (const std::uint32_t t : patch.triangles) {
        for (const std::uint32_t corner : block_.study.body->body().skin.triangles[t]) {
          const Vec3d point = block_.scene.body().skin[corner].cast<double>();
          if (const auto closest = tree(p).closest(point, nearest)) {
            nearest = closest->distance;
            reached = true;
          }
        }
      }
      if (reached) {
        found.push_back({block_.study.pieces[p]->name, nearest});
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
    return found;
  }

 private:
  const geometry::ClosestPointTree& tree(std::size_t piece) {
    if (!trees_[piece]) {
      geometry::TriangleMesh mesh;
      mesh.positions = block_.scene.piece(piece);
      mesh.triangles = block_.study.pieces[piece]->rig.rest.triangles;
      trees_[piece] = std::make_unique<geometry::ClosestPointTree>(mesh);
    }
    return *trees_[piece];
  }

  const Block& block_;
  std::vector<std::unique_ptr<geometry::ClosestPointTree>> trees_;
};

/// The region that most of the unprotected shots of a patch enter.
std::string regionOf(const LoadedStudy& study, const shotline::OpenPatch& patch, std::span<const std::uint64_t> open) {
  const human::BodyRegions& regions = study.body->body().regions;
  std::vector<std::uint64_t> shots(regions.names.size());
  for (const std::uint32_t t : patch.triangles) {
    shots[regions.ofTriangle[t]] += open[t];
  }
  const auto most = std::max_element(shots.begin(), shots.end());
  return most == shots.end() ? "" : regions.names[static_cast<std::size_t>(most - shots.begin())];
}

Vec3d meanTowards(const shotline::OpenPatch& patch, std::span<const std::int64_t> sums) {
  std::array<std::int64_t, 3> total{};
  for (const std::uint32_t t : patch.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      total[k] += sums[3 * t + k];
    }
  }
  const double scale = shotline::GapCounter::directionUnit * static_cast<double>(patch.open);
  return Vec3d(static_cast<double>(total[0]), static_cast<double>(total[1]), static_cast<double>(total[2])) / scale;
}

/// Whether the shots of a source pass a place in one direction only.
bool isOneWay(const shotline::Source& source) {
  return std::holds_alternative<shotline::PointSource>(source.shape) ||
         std::holds_alternative<shotline::ParallelBeam>(source.shape);
}

void appendGaps(const Block& block, std::vector<Gap>& gaps) {
  const study::GapSettings& wanted = *block.study.study.analyses.gaps;
  const shotline::PatchRule rule{wanted.openShare, wanted.minShots, wanted.radius};
  Pieces pieces(block);
  for (std::size_t system = 0; system < block.result.systems.size(); ++system) {
    for (std::size_t model = 0; model < block.result.models.size(); ++model) {
      for (std::size_t i = 0; i < wanted.structures.size(); ++i) {
        const shotline::GapCounts& counts = block.counts[block.watch.countsOf[i][model]];
        const auto open = counts.skin.openUnder(system);
        const std::size_t triangles = counts.skin.hits.size();
        const auto sums = std::span(counts.towards).subspan(3 * triangles * system, 3 * triangles);
        Gap gap{block.source, system, model, block.pose, wanted.structures[i]};
        gap.openShots = std::accumulate(open.begin(), open.end(), std::uint64_t{0});
        shotline::OpenPatch rest;  // what enters no patch
        rest.hits = std::accumulate(counts.skin.hits.begin(), counts.skin.hits.end(), std::uint64_t{0});
        rest.open = gap.openShots;
        const bool partly = block.watch.structures[block.watch.countsOf[i][model]].organ.has_value() &&
                            isOneWay(block.result.sources[block.source].source);
        const auto through = partly ? std::span(block.entries) : std::span<const std::uint64_t>();
        for (shotline::OpenPatch& patch : shotline::openPatches(
                 *block.study.body->skinTopology(), block.scene.body().skin, counts.skin.hits, open, rule, through)) {
          ++gap.number;
          gap.region = regionOf(block.study, patch, open);
          gap.towards = meanTowards(patch, sums);
          gap.neighbours = pieces.near(patch, system);
          rest.hits -= patch.hits;
          rest.open -= patch.open;
          gap.patch = std::move(patch);
          gaps.push_back(gap);
        }
        if (rest.open > 0) {
          Gap scattered{block.source, system, model, block.pose, wanted.structures[i]};
          scattered.openShots = gap.openShots;
          scattered.patch = std::move(rest);
          gaps.push_back(std::move(scattered));
        }
      }
    }
  }
}

void sortAsTables(std::vector<Gap>& gaps) {
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) {
    return std::tie(a.source, a.system, a.model, a.pose) < std::tie(b.source, b.system, b.model, b.pose);
  });
}

/// Triangles of a scene in the order of its meshes, with the counts of one structure on those that have them.
struct MapFields {
  std::vector<double> hits;
  std::vector<double> open;
  std::vector<double> share;

  void add(std::span<const std::uint64_t> someHits, std::span<const std::uint64_t> someOpen) {
    for (std::size_t t = 0; t < someHits.size(); ++t) {
      const auto all = static_cast<double>(someHits[t]);
      hits.push_back(all);
      open.push_back(static_cast<double>(someOpen[t]));
      share.push_back(someHits[t] == 0 ? std::numeric_limits<double>::quiet_NaN() : open.back() / all);
    }
  }
  void addNothing(std::size_t triangles) {
    hits.insert(hits.end(), triangles, 0.0);
    open.insert(open.end(), triangles, 0.0);
    share.insert(share.end(), triangles, std::numeric_limits<double>::quiet_NaN());
  }
};

/// The number of the patch that each triangle of a scene is part of; 0 for none.
std::vector<double> patchNumbers(std::span<const Gap> gaps, const std::string& structure, std::size_t triangles) {
  std::vector<double> numbers(triangles, 0.0);
  for (const Gap& gap : gaps) {
    for (const std::uint32_t t : gap.patch.triangles) {
      numbers[t] = gap.structure == structure ? static_cast<double>(gap.number) : numbers[t];
    }
  }
  return numbers;
}

/// The heat map of one system and model.
/// \param gaps of the two
std::string mapBytes(const Block& block, std::size_t system, std::size_t model, std::span<const Gap> gaps) {
  const study::GapSettings& wanted = *block.study.study.analyses.gaps;
  std::vector<io::SceneMesh> meshes{
      {"body", "body", block.scene.body().skin, block.study.body->body().skin.triangles, {0.8F, 0.61F, 0.5F, 1.0F}}};
  std::vector<std::size_t> countsOfMesh{SIZE_MAX};
  for (std::size_t i = 0; i < wanted.structures.size(); ++i) {
    const std::size_t place = block.watch.countsOf[i][model];
    if (const auto organ = block.watch.structures[place].organ) {
      meshes.push_back({wanted.structures[i], "organ", block.scene.organ(*organ, model),
                        block.study.organs[*organ]->rig.rest.triangles});
      countsOfMesh.push_back(place);
    }
  }
  for (std::size_t p = 0; p < block.study.pieces.size(); ++p) {
    if (block.study.systemOfPiece[p] + 1 == system) {
      meshes.push_back({block.study.pieces[p]->name,
                        "armor",
                        block.scene.piece(p),
                        block.study.pieces[p]->rig.rest.triangles,
                        {0.23F, 0.26F, 0.2F, 1.0F}});
      countsOfMesh.push_back(SIZE_MAX);
    }
  }
  std::vector<io::TriangleField> fields;
  for (std::size_t i = 0; i < wanted.structures.size(); ++i) {
    const std::size_t place = block.watch.countsOf[i][model];
    const shotline::GapCounts& counts = block.counts[place];
    MapFields map;
    map.add(counts.skin.hits, counts.skin.openUnder(system));
    for (std::size_t m = 1; m < meshes.size(); ++m) {
      if (countsOfMesh[m] == place) {
        map.add(counts.own.hits, counts.own.openUnder(system));
      } else {
        map.addNothing(meshes[m].triangles.size());
      }
    }
    fields.push_back({wanted.structures[i] + " patch", patchNumbers(gaps, wanted.structures[i], map.hits.size())});
    fields.push_back({wanted.structures[i] + " hits", std::move(map.hits)});
    fields.push_back({wanted.structures[i] + " unprotected", std::move(map.open)});
    fields.push_back({wanted.structures[i] + " share", std::move(map.share)});
  }
  return io::fieldsVtpBytes(meshes, fields);
}

/// A name of a file made of names of the study: what a file system may not like becomes '_'.
std::string mapName(const Block& block, std::size_t system, std::size_t model, std::set<std::string>& taken) {
  std::string name =
      fmt::format("gaps.{}.{}.{}.{}", block.result.sources[block.source].source.name, block.result.systems[system],
                  viscera::name(block.result.models[model]), block.result.poses[block.pose]);
  for (char& letter : name) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9') || std::string_view("._-@+").find(letter) != std::string::npos;
    letter = plain ? letter : '_';
  }
  std::string free = name;
  for (int copy = 2; !taken.insert(free).second; ++copy) {
    free = fmt::format("{}_{}", name, copy);
  }
  return free + ".vtp";
}

std::string tenths(double value) {
  return fmt::format("{:.1f}", value == 0.0 ? 0.0 : value);
}

}  // namespace

void checkGaps(const LoadedStudy& study) {
  const std::vector<std::string>& structures = study.study.analyses.gaps->structures;
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const bool known =
        structures[i] == "body" || std::any_of(study.organs.begin(), study.organs.end(),
                                               [&](const auto& organ) { return organ->name == structures[i]; });
    if (!known) {
      throw base::InputError(
          study.file.string(), fmt::format("/analyses/gaps/structures/{}", i),
          fmt::format("the study has no organ named \"{}\"; name one, or \"body\" for the skin", structures[i]));
    }
  }
  for (std::size_t s = 0; s < study.study.systems.size(); ++s) {
    if (study.study.systems[s].pieces.empty()) {
      throw base::InputError(study.file.string(), fmt::format("/armor/{}", s),
                             fmt::format("the system \"{}\" has no pieces, so there are no gaps in it; give it one, or "
                                         "remove it",
                                         study.study.systems[s].name));
    }
  }
}

std::vector<Gap> findGaps(const LoadedStudy& study, const RunResult& result, base::Threads threads,
                          const base::Progress& progress) {
  checkGaps(study);
  std::vector<Gap> gaps;
  forEachBlock(study, result, threads, progress, [&](const Block& block) { appendGaps(block, gaps); });
  sortAsTables(gaps);
  return gaps;
}

GapBearing bearingOf(const Gap& gap) {
  const double resultant = std::min(1.0, gap.towards.norm());
  const Vec3d towards = gap.towards / (resultant > 0.0 ? resultant : 1.0);
  const double azimuth = base::degrees(std::atan2(towards.x(), towards.z()));
  // What would be written as -0.0 or 360.0 is 0.
  return {azimuth < -0.05 ? azimuth + 360.0 : std::max(azimuth, 0.0),
          base::degrees(std::asin(std::clamp(towards.y(), -1.0, 1.0))),
          base::degrees(std::sqrt(2.0 * (1.0 - resultant)))};
}

std::string gapsCsv(const RunResult& result, const std::vector<Gap>& gaps) {
  std::string text =
      "source,system,model,pose,structure,patch,region,area_cm2,extent_cm2,centre_x_m,centre_y_m,centre_z_m,"
      "azimuth_deg,elevation_deg,spread_deg,any_hit,unprotected_hit,unprotected_share,pct_of_unprotected,neighbours\n";
  for (const Gap& gap : gaps) {
    const GapBearing bearing = bearingOf(gap);
    std::string neighbours;
    for (const Gap::Neighbour& neighbour : gap.neighbours) {
      neighbours += fmt::format("{}{} ({} mm)", neighbours.empty() ? "" : "; ", neighbour.piece,
                                tenths(1000.0 * neighbour.distance));
    }
    const auto open = static_cast<double>(gap.patch.open);
    // Shots of no patch have no place.
    const auto ofPatch = [&](std::string value) { return gap.number == 0 ? std::string() : std::move(value); };
    text += io::csvRow(std::array{result.sources[gap.source].source.name,
                                  result.systems[gap.system],
                                  std::string(viscera::name(result.models[gap.model])),
                                  result.poses[gap.pose],
                                  gap.structure,
                                  std::to_string(gap.number),
                                  gap.region,
                                  ofPatch(io::csvNumber(1e4 * gap.patch.area)),
                                  ofPatch(io::csvNumber(1e4 * gap.patch.extent)),
                                  ofPatch(io::csvNumber(gap.patch.centre.x())),
                                  ofPatch(io::csvNumber(gap.patch.centre.y())),
                                  ofPatch(io::csvNumber(gap.patch.centre.z())),
                                  ofPatch(tenths(bearing.azimuth)),
                                  ofPatch(tenths(bearing.elevation)),
                                  ofPatch(tenths(bearing.spread)),
                                  std::to_string(gap.patch.hits),
                                  std::to_string(gap.patch.open),
                                  io::csvNumber(open / static_cast<double>(gap.patch.hits)),
                                  io::csvNumber(100.0 * open / static_cast<double>(gap.openShots)),
                                  neighbours});
  }
  return text;
}

std::vector<std::string> writeGaps(const LoadedStudy& study, const RunResult& result, base::Threads threads,
                                   const std::filesystem::path& folder, const base::Progress& progress) {
  checkGaps(study);
  std::vector<Gap> gaps;
  std::vector<std::string> names{"gaps.csv"};
  std::vector<std::unique_ptr<base::FileDraft>> files;
  files.push_back(std::make_unique<base::FileDraft>(folder / names.front()));
  std::set<std::string> taken;
  forEachBlock(study, result, threads, progress, [&](const Block& block) {
    const std::size_t before = gaps.size();
    appendGaps(block, gaps);
    for (std::size_t system = 0; study.study.analyses.gaps->maps && system < result.systems.size(); ++system) {
      for (std::size_t model = 0; model < result.models.size(); ++model) {
        names.push_back(mapName(block, system, model, taken));
        files.push_back(std::make_unique<base::FileDraft>(folder / names.back()));
        std::vector<Gap> here;
        std::copy_if(gaps.begin() + static_cast<std::ptrdiff_t>(before), gaps.end(), std::back_inserter(here),
                     [&](const Gap& gap) { return gap.system == system && gap.model == model; });
        files.back()->write(mapBytes(block, system, model, here));
      }
    }
  });
  sortAsTables(gaps);
  files.front()->write(gapsCsv(result, gaps));
  progress.check();
  for (const auto& file : files) {
    file->commit();
  }
  return names;
}

}  // namespace lorica::analysis
