#include "prepare_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lorica/base/error.h"
#include "lorica/base/units.h"
#include "lorica/geometry/measures.h"

namespace lorica::analysis {

using geometry::Vec3d;
using geometry::Vec3f;

void PosedSkins::add(geometry::Positions skin) {
  box_.extend(geometry::bounds(skin));
  const std::size_t size = skin.size() * sizeof(Vec3f);
  if (kept_.size() == poses_ && (!again_ || bytes_ + size <= keptBytes)) {
    bytes_ += size;
    kept_.push_back(std::move(skin));
  }
  ++poses_;
}

void PosedSkins::forEach(const std::function<void(std::span<const Vec3f>)>& use) const {
  for (std::size_t pose = 0; pose < poses_; ++pose) {
    pose < kept_.size() ? use(kept_[pose]) : use(again_(pose));
  }
}

namespace {

/// What preparing one source needs.
struct Preparing {
  const LoadedStudy& study;
  std::size_t index;
  const Aim& aim;
  base::Issues& issues;

  const study::Source& wanted() const { return study.study.sources[index]; }
  [[noreturn]] void fail(const std::string& key, const std::string& text) const {
    throw base::InputError(study.file.string(), fmt::format("/sources/{}{}", index, key), text);
  }
};

Vec3d targetOf(const Preparing& p) {
  if (p.wanted().target) {
    return *p.wanted().target;
  }
  if (!p.wanted().targetStructure.empty()) {
    const geometry::Box3d box = p.aim.boxOf(p.wanted().targetStructure);
    if (box.isEmpty()) {
      p.fail("/target_structure",
             fmt::format("the study has no organ or piece named \"{}\"", p.wanted().targetStructure));
    }
    return box.center();
  }
  return p.aim.skins.box().center();
}

/// Whether a point lies inside a posed skin.
bool inside(const LoadedStudy& study, const Vec3d& point, std::span<const Vec3f> skin) {
  if (!geometry::bounds(skin).contains(point)) {
    return false;
  }
  const geometry::Positions positions(skin.begin(), skin.end());
  raycast::Scene scene(raycast::SceneUse::manyRays);
  const raycast::MeshIndex mesh = scene.add(positions, study.body->skinTopology());
  scene.build();
  raycast::Caster caster(scene);
  return raycast::windingNumber(caster, mesh, point) != 0;
}

shotline::PointSource preparePoint(const Preparing& p) {
  shotline::PointSource made;
  made.position = p.wanted().position;
  made.target = targetOf(p);
  made.sampler = p.wanted().sampler;
  made.width = p.wanted().width;
  made.height = p.wanted().height;
  if (made.position == made.target) {
    p.fail("", "the source stands on its target; move one of them");
  }
  p.aim.skins.forEach([&](std::span<const Vec3f> skin) {
    if (inside(p.study, made.position, skin)) {
      p.fail("/position", "the source is inside the body; move it out");
    }
    if (made.sampler == shotline::Sampler::cone) {
      made.halfAngle =
          std::max(made.halfAngle, shotline::boundingHalfAngle(made.position, made.target, std::span(&skin, 1)));
    }
  });
  if (made.sampler == shotline::Sampler::thesis) {
    p.issues.push_back({base::Severity::warning, "", p.wanted().name,
                        "the thesis' sampler (Eq 15) sends half of its shots backwards and its hit rate depends on the "
                        "world's axes; use it for comparison only"});
  } else if (made.sampler == shotline::Sampler::disk) {
    made.halfAngle = std::atan2(p.wanted().radius, (made.target - made.position).norm());
  } else if (made.sampler == shotline::Sampler::cone && made.halfAngle == std::numbers::pi) {
    p.issues.push_back({base::Severity::warning, "", p.wanted().name,
                        "the source stands so near the body that no cone bounds the body; its shots go in every "
                        "direction"});
  }
  return made;
}

shotline::ParallelBeam prepareBeam(const Preparing& p) {
  shotline::ParallelBeam made;
  made.azimuth = base::radians(p.wanted().azimuth.from);
  made.elevation = base::radians(p.wanted().elevation.from);
  made.centre = targetOf(p);
  made.radius = 0.0;
  p.aim.skins.forEach([&](std::span<const Vec3f> skin) {
    const Vec3d axis = shotline::towards(made.azimuth, made.elevation);
    made.radius = std::max(made.radius, shotline::boundingRadius(made.centre, axis, std::span(&skin, 1)));
  });
  if (p.wanted().sequence == study::Sequence::grid) {
    constexpr double mostCells = 1e6;  // along a side
    const double cells = std::ceil(2.0 * made.radius / p.wanted().cell);
    if (cells > mostCells) {
      p.fail("/cell_mm", fmt::format("cells so small make {:.0f} shots; the limit is 1e12", cells * cells));
    }
    made.gridSide = static_cast<std::uint64_t>(cells);
  }
  return made;
}

shotline::DirectionBand prepareBand(const Preparing& p) {
  const bool sphere = p.wanted().type == study::SourceType::sphere;
  const study::DegreeRange azimuth = sphere ? study::DegreeRange{0.0, 360.0} : p.wanted().azimuth;
  const study::DegreeRange elevation = sphere ? study::DegreeRange{-90.0, 90.0} : p.wanted().elevation;
  shotline::DirectionBand made;
  made.azimuth = {base::radians(azimuth.from), base::radians(azimuth.to)};
  made.elevation = {base::radians(elevation.from), base::radians(elevation.to)};
  made.centre = targetOf(p);
  made.radius = 0.0;
  p.aim.skins.forEach([&](std::span<const Vec3f> skin) {
    made.radius = std::max(made.radius, shotline::boundingRadius(made.centre, std::span(&skin, 1)));
  });
  return made;
}

}  // namespace

ShotSource prepareSource(const LoadedStudy& study, std::size_t source, const Aim& aim, base::Issues& issues) {
  const Preparing preparing{study, source, aim, issues};
  const study::Source& wanted = preparing.wanted();
  ShotSource made;
  made.source.name = wanted.name;
  made.source.sequence = wanted.sequence;
  made.shots = wanted.shots;
  switch (wanted.type) {
    case study::SourceType::point:
      made.source.shape = preparePoint(preparing);
      break;
    case study::SourceType::parallel: {
      const shotline::ParallelBeam beam = prepareBeam(preparing);
      made.shots = wanted.sequence == study::Sequence::grid ? beam.gridSide * beam.gridSide : wanted.shots;
      made.source.shape = beam;
      break;
    }
    case study::SourceType::band:
    case study::SourceType::sphere:
      made.source.shape = prepareBand(preparing);
      break;
    case study::SourceType::list:
      made.source.shape = study.shotLists.at(source);
      made.shots = study.shotLists.at(source).rays->size();
      break;
  }
  made.measure = shotline::measureOf(made.source);
  return made;
}

}  // namespace lorica::analysis
