#include "lorica/jobs/organ_drivers.h"

#include <algorithm>
#include <map>

namespace lorica::jobs {

namespace {

using geometry::Vec3d;
using geometry::Vec3f;
using parenting::SkinSite;
using viscera::OrganModel;
using viscera::OrganRig;

/// Corners of a cell (Eq 12) that differ in one of x, z and y.
constexpr std::array<std::array<std::size_t, 2>, 12> edgesOfACell{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// What carries each control point; empty for rigid organs.
const std::vector<viscera::SiteBlend>& blendsOf(const OrganRig& organ, OrganModel model) {
  static const std::vector<viscera::SiteBlend> none;
  return model == OrganModel::dynamic ? organ.drivers : model == OrganModel::dynamicThesis ? organ.thesisDrivers : none;
}

DriverFrame frameOf(const Vec3d& rest, const geometry::Mat3d& restFrame, const geometry::RigidTransform& carry) {
  DriverFrame frame;
  frame.origin = (carry * rest).cast<float>();
  const geometry::Mat3d axes = carry.rotation.toRotationMatrix() * restFrame;
  for (int axis = 0; axis < 3; ++axis) {
    frame.axes[static_cast<std::size_t>(axis)] = axes.col(axis).cast<float>();
  }
  return frame;
}

DriverSite siteOf(const SkinSite& site, const geometry::RigidTransform& carry,
                  std::span<const geometry::Triangle> triangles, std::span<const Vec3f> skin) {
  DriverSite posed;
  posed.frame = frameOf(site.rest, site.restFrame, carry);
  for (std::size_t a = 0; a < site.anchors.size(); ++a) {
    Vec3d place = Vec3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      place += site.anchors[a].barycentric[static_cast<Eigen::Index>(k)] *
               skin[triangles[site.anchors[a].triangle][k]].cast<double>();
    }
    posed.anchors[a] = place.cast<float>();
  }
  return posed;
}

void addLattice(OrganDrivers& drivers, const OrganRig& organ, const parenting::SiteMotion& motion,
                const std::vector<viscera::SiteBlend>& blends, base::Threads threads) {
  const std::vector<Vec3f> moved = viscera::offsets(organ.lattice.controlPoints, blends, motion.carry, threads);
  drivers.controlPoints.reserve(moved.size());
  for (std::size_t p = 0; p < moved.size(); ++p) {
    drivers.controlPoints.emplace_back(organ.lattice.controlPoints[p].cast<float>() + moved[p]);
  }
  drivers.pruned = organ.lattice.pruned;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> cellEdges(std::span<const std::array<std::uint32_t, 8>> cells) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& corners : cells) {
    for (const auto& [from, to] : edgesOfACell) {
      edges.push_back({std::min(corners[from], corners[to]), std::max(corners[from], corners[to])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The soft body's cells around an organ. It keeps no places of its control points: the vertices of the organ and their
/// shares of their cells tell them.
void layOutSoftBody(DriverLayout& layout, const OrganRig& organ, const viscera::Embedding& embedding) {
  layout.inSoftBody = true;
  std::map<std::uint32_t, Vec3d> places;
  for (std::size_t v = 0; v < embedding.cellOf.size(); ++v) {
    const auto& corners = embedding.cellCorners[embedding.cellOf[v]];
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Vec3d digits(viscera::cornerDigits[c][0], viscera::cornerDigits[c][1], viscera::cornerDigits[c][2]);
      const Vec3d share = digits - embedding.fraction[v].cast<double>();
      places.emplace(corners[c], organ.rest.positions[v].cast<double>() + share.cwiseProduct(embedding.cell));
    }
  }
  for (const auto& [point, place] : places) {
    layout.softPoints.push_back(point);
    layout.softPlaces.push_back(place);
  }
  layout.edges = cellEdges(embedding.cellCorners);
  const auto local = [&](std::uint32_t point) {
    return static_cast<std::uint32_t>(std::lower_bound(layout.softPoints.begin(), layout.softPoints.end(), point) -
                                      layout.softPoints.begin());
  };
  for (auto& [from, to] : layout.edges) {
    from = local(from);
    to = local(to);
  }
}

DriverLayout driverLayout(const analysis::LoadedStudy& study, std::size_t index, OrganModel model) {
  const OrganRig& organ = study.organs[index]->rig;
  DriverLayout layout;
  layout.model = model;
  if (model == OrganModel::dynamic && study.softBody != nullptr) {
    layOutSoftBody(layout, organ, study.softBody->embedding(index));
    return layout;
  }
  const std::vector<viscera::SiteBlend>& blends = blendsOf(organ, model);
  if (blends.empty()) {
    layout.byJoint = model == OrganModel::staticJoint || !organ.site;
    return layout;
  }
  layout.edges = cellEdges(organ.lattice.cellCorners);
  for (const viscera::SiteBlend& blend : blends) {
    layout.sites.insert(layout.sites.end(), blend.site.begin(),
                        blend.site.begin() + static_cast<std::ptrdiff_t>(blend.count));
  }
  std::sort(layout.sites.begin(), layout.sites.end());
  layout.sites.erase(std::unique(layout.sites.begin(), layout.sites.end()), layout.sites.end());
  const std::vector<SkinSite>& sites =
      model == OrganModel::dynamicThesis ? study.body->thesisSites() : study.body->sites();
  const auto distance = [&](std::uint32_t site) { return (sites[site].rest - organ.reference).squaredNorm(); };
  const auto middle = std::min_element(layout.sites.begin(), layout.sites.end(),
                                       [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  layout.middle = static_cast<std::size_t>(middle - layout.sites.begin());
  return layout;
}

OrganDrivers poseDrivers(const analysis::LoadedStudy& study, std::size_t index,
                         std::shared_ptr<const DriverLayout> layout, const analysis::PosedScene& scene,
                         base::Threads threads) {
  const OrganRig& organ = study.organs[index]->rig;
  const parenting::BodyRig& body = *study.body;
  const parenting::PosedBody& pose = scene.body();
  OrganDrivers drivers;
  const bool thesis = layout->model == OrganModel::dynamicThesis && !organ.thesisDrivers.empty();
  const std::vector<SkinSite>& sites = thesis ? body.thesisSites() : body.sites();
  const parenting::SiteMotion& motion = thesis ? pose.thesisSites : pose.sites;
  const std::vector<geometry::Triangle>& triangles = body.body().skin.triangles;
  std::vector<bool> drives(sites.size());
  for (const std::uint32_t site : layout->sites) {
    drives[site] = true;
    drivers.sites.push_back(siteOf(sites[site], motion.carry[site], triangles, pose.skin));
  }
  for (std::size_t s = 0; s < sites.size(); ++s) {
    if (!drives[s]) {
      drivers.otherSites.emplace_back((motion.carry[s] * sites[s].rest).cast<float>());
    }
  }
  if (layout->inSoftBody) {
    for (std::size_t p = 0; p < layout->softPoints.size(); ++p) {
      drivers.controlPoints.emplace_back(layout->softPlaces[p].cast<float>() +
                                         scene.softBodyOffsets()[layout->softPoints[p]]);
    }
  } else if (const auto& blends = blendsOf(organ, layout->model); !blends.empty()) {
    addLattice(drivers, organ, motion, blends, threads);
  } else if (!layout->byJoint) {
    const auto carry = parenting::carry(*organ.site, triangles, pose.skin);
    drivers.sites.push_back(siteOf(*organ.site,
                                   carry ? *carry : motion.carry[parenting::nearestSite(sites, organ.reference)],
                                   triangles, pose.skin));
  } else if (organ.joint && body.body().skeleton) {
    const human::Skeleton& skeleton = *body.body().skeleton;
    drivers.joint =
        frameOf(skeleton.restPosition(*organ.joint), geometry::Mat3d::Identity(), pose.joints[organ.joint->value]);
    drivers.jointName = skeleton.joint(*organ.joint).name;
  }
  drivers.layout = std::move(layout);
  return drivers;
}

}  // namespace lorica::jobs
