#include "lorica/analysis/threats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/shot_paths.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/geometry/measures.h"
#include "lorica/io/export.h"
#include "lorica/threat/field_surfaces.h"
#include "lorica/threat/fragment_paths.h"
#include "lorica/threat/surface_values.h"

namespace lorica::analysis {

using geometry::Box3d;
using geometry::Vec3d;

namespace {

/// Places nearer to each other than this are one, metres; a float near 10 m has steps of this size.
constexpr double onePlace = 1e-6;

/// A structure in a pose.
struct Surface {
  std::string name;
  std::string kind;
  std::string model;
  const geometry::Positions* positions = nullptr;
  const std::vector<geometry::Triangle>* triangles = nullptr;
};

std::vector<Surface> surfacesOf(const LoadedStudy& study, const PosedScene& scene) {
  std::vector<Surface> surfaces;
  surfaces.push_back({"body", "body", "", &scene.body().skin, &study.body->body().skin.triangles});
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    surfaces.push_back({study.organs[o]->name, "organ", viscera::name(scene.models().front()), &scene.organ(o, 0),
                        &study.organs[o]->rig.rest.triangles});
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    surfaces.push_back({study.pieces[p]->name, "armor", "", &scene.piece(p), &study.pieces[p]->rig.rest.triangles});
  }
  return surfaces;
}

/// Triangles of each region of the skin.
std::vector<std::vector<geometry::Triangle>> trianglesByRegion(const parenting::Body& body) {
  std::vector<std::vector<geometry::Triangle>> regions(body.regions.names.size());
  for (std::size_t t = 0; t < body.regions.ofTriangle.size(); ++t) {
    regions[body.regions.ofTriangle[t]].push_back(body.skin.triangles[t]);
  }
  return regions;
}

/// Values of one surface as they are tabled: at a time, or the greatest over all.
struct SurfaceExposure {
  std::vector<float> values;
  std::vector<double> times;    ///< of the values; empty for data without times
  std::vector<float> impulses;  ///< empty where there is none
};

class ThreatTables {
 public:
  ThreatTables(const LoadedStudy& study, const ThreatOptions& options, std::size_t index, const LoadedThreat& threat,
               ThreatResult& result)
      : study_(study), options_(options), wanted_(study.study.threats[index]), threat_(threat), result_(result) {
    if (threat.attribute) {
      threat::SamplerOptions sampling;
      sampling.radius = wanted_.reach;
      sampler_ = std::make_unique<threat::FieldSampler>(threat.field, sampling);
      pascals_ = threat::pascalsPer(attribute().unit);
    }
    paths_ = threat::fragmentPaths(*threat.field);
  }

  void addPose(const std::string& pose, const PosedScene& scene, const base::Progress& progress) {
    if (sampler_) {
      addRows(pose, scene, progress.part(0.0, 0.9));
    }
    addCrossings(pose, scene, progress.part(0.9, 1.0));
  }

  /// Surfaces and slices do not depend on the pose.
  void addSurfaces(const base::Progress& progress) {
    if (!sampler_ || (options_.levels.empty() && options_.slices.empty())) {
      return;
    }
    const threat::ThreatField& field = *threat_.field;
    if (field.timed && !options_.time) {
      throw base::InputError("", "",
                             fmt::format("surfaces and slices of \"{}\" need a time, which has {} of them; say "
                                         "which",
                                         threat_.name, field.steps.size()));
    }
    const double time = options_.time.value_or(0.0);
    const double spacing = options_.spacing.value_or(threat::typicalSpacing(field));
    if (!(spacing > 0.0)) {
      throw base::InputError("", "", fmt::format("the data of \"{}\" lie at one place; give a spacing", threat_.name));
    }
    threat::LevelOptions level;
    level.spacing = spacing;
    for (const double value : options_.levels) {
      addFile(fmt::format("{}_level_{:g}", threat_.name, value),
              threat::levelSurface(*sampler_, *threat_.attribute, time, value, level, options_.threads, progress));
    }
    for (const SlicePlane& cut : options_.slices) {
      const threat::Plane plane{cut.metres * Vec3d::Unit(cut.axis), Vec3d::Unit(cut.axis)};
      addFile(fmt::format("{}_slice_{}_{:g}", threat_.name, "xyz"[cut.axis], cut.metres),
              threat::slice(*sampler_, *threat_.attribute, time, plane, spacing, options_.threads, progress));
    }
  }

 private:
  const threat::Attribute& attribute() const { return threat_.field->attributes[*threat_.attribute]; }

  SurfaceExposure exposureOf(const geometry::Positions& positions, const base::Progress& progress) const {
    if (options_.time) {
      return {sampler_->values(positions, *options_.time, *threat_.attribute, options_.threads),
              threat_.field->timed ? std::vector<double>(positions.size(), *options_.time) : std::vector<double>(),
              {}};
    }
    threat::Exposure seen = threat::exposure(*sampler_, *threat_.attribute, positions, options_.threads, progress);
    if (pascals_) {
      for (float& impulse : seen.integral) {
        impulse = static_cast<float>(*pascals_ * static_cast<double>(impulse));
      }
    }
    return {std::move(seen.peak), threat_.field->timed ? std::move(seen.peakTime) : std::vector<double>(),
            std::move(seen.integral)};
  }

  ThreatRow rowOf(const std::string& pose, const Surface& surface, std::span<const geometry::Triangle> triangles,
                  const SurfaceExposure& seen) const {
    const threat::SurfaceStatistics statistics =
        threat::surfaceStatistics(*surface.positions, triangles, seen.values, wanted_.threshold);
    ThreatRow row;
    row.threat = threat_.name;
    row.attribute = attribute();
    row.pose = pose;
    row.model = surface.model;
    row.structure = surface.name;
    row.kind = surface.kind;
    row.time = options_.time;
    row.peak = statistics.max;
    if (statistics.maxVertex) {
      row.peakPlace = (*surface.positions)[*statistics.maxVertex].cast<double>();
      if (!seen.times.empty()) {
        row.peakTime = seen.times[*statistics.maxVertex];
      }
    }
    row.mean = statistics.mean;
    row.threshold = wanted_.threshold;
    row.shareAbove = statistics.shareAbove;
    row.area = statistics.area;
    row.areaWithValue = statistics.areaWithValue;
    if (!seen.impulses.empty()) {
      const threat::SurfaceStatistics impulse = threat::surfaceStatistics(*surface.positions, triangles, seen.impulses);
      row.peakImpulse = impulse.max;
      row.meanImpulse = impulse.mean;
    }
    return row;
  }

  void addRows(const std::string& pose, const PosedScene& scene, const base::Progress& progress) {
    const std::vector<Surface> surfaces = surfacesOf(study_, scene);
    std::vector<SurfaceExposure> seen;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      const double count = static_cast<double>(surfaces.size());
      seen.push_back(exposureOf(*surfaces[s].positions, progress));
      progress.report(static_cast<double>(s + 1) / count);
      result_.rows.push_back(rowOf(pose, surfaces[s], *surfaces[s].triangles, seen.back()));
      if (s == 0) {
        const std::vector<std::vector<geometry::Triangle>> regions = trianglesByRegion(study_.body->body());
        for (std::size_t r = 0; r < regions.size(); ++r) {
          Surface region = surfaces[0];
          region.name = study_.body->body().regions.names[r];
          region.kind = "region";
          result_.rows.push_back(rowOf(pose, region, regions[r], seen[0]));
        }
      }
    }
    if (options_.models) {
      addModels(pose, surfaces, seen);
    }
  }

  void addModels(const std::string& pose, const std::vector<Surface>& surfaces,
                 const std::vector<SurfaceExposure>& seen) {
    std::vector<io::SceneMesh> scene;
    io::VertexField values{threat::label(attribute()), {}};
    io::VertexField times{"time_ms", {}};
    io::VertexField impulses{"impulse", {}};
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      scene.push_back({surfaces[s].name, surfaces[s].kind, *surfaces[s].positions, *surfaces[s].triangles});
      values.values.insert(values.values.end(), seen[s].values.begin(), seen[s].values.end());
      impulses.values.insert(impulses.values.end(), seen[s].impulses.begin(), seen[s].impulses.end());
      std::transform(seen[s].times.begin(), seen[s].times.end(), std::back_inserter(times.values),
                     [](double seconds) { return 1e3 * seconds; });
    }
    std::vector<io::VertexField> fields{std::move(values)};
    for (io::VertexField* field : {&times, &impulses}) {
      if (field->values.size() == fields.front().values.size()) {
        fields.push_back(std::move(*field));
      }
    }
    result_.files.push_back({fileName(threat_.name + "_" + pose), io::fieldsVtpBytes(scene, {}, fields)});
  }

  void addFile(const std::string& name, const threat::ColouredSurface& surface) {
    const std::vector<io::SceneMesh> scene{{name, "threat", surface.mesh.positions, surface.mesh.triangles}};
    const std::vector<io::VertexField> fields{
        {threat::label(attribute()), std::vector<double>(surface.values.begin(), surface.values.end())}};
    result_.files.push_back({fileName(name), io::fieldsVtpBytes(scene, {}, fields)});
  }

  /// A name that every file system takes.
  static std::string fileName(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](char letter) { return letter == '/' || letter == '\\' || static_cast<unsigned char>(letter) < 0x20U; }, '_');
    return name + ".vtp";
  }

  void addCrossings(const std::string& pose, const PosedScene& scene, const base::Progress& progress) {
    raycast::Caster caster(scene.scene());
    for (const threat::FragmentPath& path : paths_) {
      progress.check();
      std::size_t order = 0;
      std::set<std::string> systems;
      std::set<std::uint32_t> entered;  // at the end of the segment before
      for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        const raycast::Ray ray{path.points[i], path.points[i + 1] - path.points[i]};
        const double length = ray.direction.cast<double>().norm();
        if (!(length > 0.0)) {
          continue;
        }
        // Where two segments meet rounding may give a crossing to both or to none, so each reaches a little further.
        const double slack = onePlace / length;
        std::set<std::uint32_t> atEnd;
        for (const raycast::Hit& hit : caster.cast(ray)) {
          const bool again = hit.t <= slack && entered.contains(hit.mesh);
          if (!hit.entering || hit.t > 1.0 + slack || again) {
            continue;
          }
          addCrossing(pose, scene, path, i, ray, hit, ++order, systems);
          if (hit.t >= 1.0 - slack) {
            atEnd.insert(hit.mesh);
          }
        }
        entered = std::move(atEnd);
      }
    }
  }

  void addCrossing(const std::string& pose, const PosedScene& scene, const threat::FragmentPath& path,
                   std::size_t segment, const raycast::Ray& ray, const raycast::Hit& hit, std::size_t order,
                   std::set<std::string>& systems) {
    FragmentCrossing crossing;
    crossing.threat = threat_.name;
    crossing.pose = pose;
    crossing.fragment = path.id;
    crossing.order = order;
    crossing.armorBefore = fmt::format("{}", fmt::join(systems, ";"));
    crossing.place = ray.origin.cast<double>() + hit.t * ray.direction.cast<double>();
    if (!path.times.empty()) {
      crossing.time = path.times[segment] + hit.t * (path.times[segment + 1] - path.times[segment]);
    }
    const StructureRef ref = structureOfMesh(scene.layout(), hit.mesh);
    switch (ref.kind) {
      case StructureRef::Kind::body:
        crossing.structure = "body";
        crossing.kind = "body";
        break;
      case StructureRef::Kind::piece:
        crossing.structure = study_.pieces[ref.index]->name;
        crossing.kind = "armor";
        crossing.group = study_.study.systems[study_.systemOfPiece[ref.index]].name;
        systems.insert(crossing.group);
        break;
      case StructureRef::Kind::organ:
        crossing.structure = study_.organs[ref.index]->name;
        crossing.kind = "organ";
        crossing.group = viscera::name(scene.models()[ref.model]);
        break;
    }
    result_.crossings.push_back(std::move(crossing));
  }

  const LoadedStudy& study_;
  const ThreatOptions& options_;
  const study::Threat& wanted_;
  const LoadedThreat& threat_;
  ThreatResult& result_;
  std::unique_ptr<threat::FieldSampler> sampler_;  ///< none for paths alone
  std::optional<double> pascals_;                  ///< in the attribute's unit
  std::vector<threat::FragmentPath> paths_;
};

/// Around everything in all poses, and a little more.
Box3d boxAround(const LoadedStudy& study, const std::vector<std::unique_ptr<PosedScene>>& scenes) {
  Box3d box;
  for (const auto& scene : scenes) {
    for (const Surface& surface : surfacesOf(study, *scene)) {
      box.extend(geometry::bounds(*surface.positions));
    }
  }
  const Vec3d margin = Vec3d::Constant(0.02);
  return {box.min() - margin, box.max() + margin};
}

std::string field(std::optional<double> value) {
  return value ? fmt::format("{:.7g}", *value) : std::string();
}

std::string impulseUnit(const threat::Attribute& attribute) {
  return threat::pascalsPer(attribute.unit) ? "Pa*s" : attribute.unit.empty() ? "s" : attribute.unit + "*s";
}

std::optional<double> times(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

}  // namespace

ThreatResult threatAnalysis(const LoadedStudy& study, const ThreatOptions& options, const base::Progress& progress) {
  const std::size_t count = study.study.threats.size();
  if (count == 0) {
    throw base::InputError(study.file.string(), "/threats", "the study has no threat data; add one");
  }
  const std::vector<std::string> poses = options.poses.empty() ? defaultPoses(study.study) : options.poses;
  std::vector<std::unique_ptr<PosedScene>> scenes;
  for (const std::string& pose : poses) {
    progress.check();
    scenes.push_back(std::make_unique<PosedScene>(study, std::vector{options.model}, resolvePose(study, pose).pose,
                                                  raycast::SceneUse::manyRays, options.threads));
  }
  progress.report(0.2);
  const Box3d around = boxAround(study, scenes);
  ThreatResult result;
  for (std::size_t t = 0; t < count; ++t) {
    const double begin = 0.2 + 0.8 * static_cast<double>(t) / static_cast<double>(count);
    const base::Progress share = progress.part(begin, begin + 0.8 / static_cast<double>(count));
    LoadedThreat threat = loadThreat(study, t, around, options.threads, share.part(0.0, 0.4));
    ThreatTables tables(study, options, t, threat, result);
    for (std::size_t p = 0; p < poses.size(); ++p) {
      const double each = 0.5 / static_cast<double>(poses.size());
      const double from = 0.4 + each * static_cast<double>(p);
      tables.addPose(poses[p], *scenes[p], share.part(from, from + each));
    }
    tables.addSurfaces(share.part(0.9, 1.0));
    base::append(result.issues, std::move(threat.issues));
  }
  return result;
}

std::string threatCsv(const std::vector<ThreatRow>& rows) {
  std::string text =
      "threat,attribute,unit,structure,kind,model,pose,at_ms,peak,time_of_peak_ms,peak_x_m,peak_y_m,peak_z_m,mean,"
      "threshold,above_threshold_pct,area_cm2,area_with_value_pct,peak_impulse,mean_impulse,impulse_unit\n";
  for (const ThreatRow& row : rows) {
    const auto place = [&](int axis) { return row.peakPlace ? io::csvNumber((*row.peakPlace)[axis]) : std::string(); };
    text += io::csvRow(std::vector<std::string>{
        row.threat,
        row.attribute.name,
        row.attribute.unit,
        row.structure,
        row.kind,
        row.model,
        row.pose,
        io::csvNumber(times(row.time, 1e3)),
        field(row.peak),
        io::csvNumber(times(row.peakTime, 1e3)),
        place(0),
        place(1),
        place(2),
        field(row.mean),
        field(row.threshold),
        io::csvNumber(times(row.shareAbove, 100.0)),
        io::csvNumber(1e4 * row.area),
        io::csvNumber(row.area > 0.0 ? std::optional(100.0 * row.areaWithValue / row.area) : std::nullopt),
        field(row.peakImpulse),
        field(row.meanImpulse),
        row.peakImpulse ? impulseUnit(row.attribute) : ""});
  }
  return text;
}

std::string fragmentsCsv(const std::vector<FragmentCrossing>& crossings) {
  std::string text = "threat,pose,fragment,order,structure,kind,group,armor_before,time_ms,x_m,y_m,z_m\n";
  for (const FragmentCrossing& crossing : crossings) {
    text += io::csvRow(std::vector<std::string>{
        crossing.threat, crossing.pose, std::to_string(crossing.fragment), std::to_string(crossing.order),
        crossing.structure, crossing.kind, crossing.group, crossing.armorBefore,
        io::csvNumber(times(crossing.time, 1e3)), io::csvNumber(crossing.place.x()), io::csvNumber(crossing.place.y()),
        io::csvNumber(crossing.place.z())});
  }
  return text;
}

std::vector<std::string> writeThreats(const ThreatResult& result, const std::filesystem::path& folder) {
  std::vector<base::FileBytes> files;
  if (!result.rows.empty()) {
    files.push_back({folder / "threat.csv", threatCsv(result.rows)});
  }
  if (!result.crossings.empty()) {
    files.push_back({folder / "fragments.csv", fragmentsCsv(result.crossings)});
  }
  for (const ThreatFile& file : result.files) {
    files.push_back({folder / file.name, file.bytes});
  }
  base::writeFilesAtomically(files);
  std::vector<std::string> names;
  for (const base::FileBytes& file : files) {
    names.push_back(file.path.filename().string());
  }
  return names;
}

}  // namespace lorica::analysis
