#include "lorica/viscera/organ_rig.h"

#include <algorithm>
#include <array>

#include "lorica/base/error.h"
#include "lorica/geometry/measures.h"

namespace lorica::viscera {

using geometry::RigidTransform;
using geometry::Vec3d;
using geometry::Vec3f;

namespace {

constexpr std::array models = {OrganModel::staticJoint, OrganModel::staticSkin, OrganModel::dynamicThesis,
                               OrganModel::dynamic};

void moveRigidly(std::span<const Vec3f> rest, const RigidTransform& transform, std::span<Vec3f> posed,
                 base::Threads threads) {
  if (transform.isIdentity()) {
    std::copy(rest.begin(), rest.end(), posed.begin());
    return;
  }
  const geometry::Mat3d rotation = transform.rotation.toRotationMatrix();
  base::parallelFor(rest.size(), 8192, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      posed[v] = (rotation * rest[v].cast<double>() + transform.translation).cast<float>();
    }
  });
}

}  // namespace

std::string name(OrganModel model) {
  switch (model) {
    case OrganModel::staticJoint:
      return "static_joint";
    case OrganModel::staticSkin:
      return "static_skin";
    case OrganModel::dynamicThesis:
      return "dynamic_thesis";
    case OrganModel::dynamic:
      return "dynamic";
  }
  return "dynamic";
}

std::optional<OrganModel> organModelNamed(std::string_view wanted) {
  const auto found = std::find_if(models.begin(), models.end(), [&](OrganModel m) { return name(m) == wanted; });
  return found == models.end() ? std::nullopt : std::optional(*found);
}

OrganRig bindOrgan(geometry::TriangleMesh rest, const std::string& name, const parenting::BodyRig& body,
                   const OrganOptions& options, base::Threads threads) {
  LORICA_CHECK(!rest.positions.empty(), "an organ with vertices");
  OrganRig organ;
  organ.rest = std::move(rest);
  organ.reference = geometry::centroid(organ.rest);
  organ.joint = options.joint;
  if (!organ.joint && body.body().skeleton) {
    organ.joint = parenting::nearestJoint(*body.body().skeleton, organ.reference);
  }
  organ.lattice = makeLattice(organ.rest.positions, options.lattice);
  if (body.sites().empty()) {
    organ.issues.push_back({base::Severity::warning, "", name,
                            "the body has no interior site, so the skin cannot carry this organ; every model moves it "
                            "with its joint"});
    return organ;
  }
  raycast::Caster caster(body.restScene());
  organ.site = parenting::bindToSkin(organ.reference, caster, body.restScene(), body.skinMesh()).site;
  if (!organ.site) {
    organ.site = body.sites()[parenting::nearestSite(body.sites(), organ.reference)];
    organ.reference = organ.site->rest;
  }
  organ.drivers = bindToSites(organ.lattice.controlPoints, body.sites(), SiteBinding::smooth, threads);
  if (!body.thesisSites().empty()) {
    organ.thesisDrivers = bindToSites(organ.lattice.controlPoints, body.thesisSites(), SiteBinding::nearest, threads);
  }
  return organ;
}

void poseOrgan(const OrganRig& organ, OrganModel model, const parenting::BodyRig& body,
               const parenting::PosedBody& pose, std::span<Vec3f> posed, base::Threads threads) {
  LORICA_CHECK(posed.size() == organ.rest.positions.size(), "one place per vertex");
  const auto lattice = [&](const std::vector<SiteBlend>& drivers, const parenting::SiteMotion& motion) {
    const std::vector<Vec3f> moved = offsets(organ.lattice.controlPoints, drivers, motion.carry, threads);
    deform(organ.rest.positions, organ.lattice, moved, posed, threads);
  };
  if (model == OrganModel::dynamic && !organ.drivers.empty()) {
    lattice(organ.drivers, pose.sites);
    return;
  }
  if (model == OrganModel::dynamicThesis && !organ.thesisDrivers.empty()) {
    lattice(organ.thesisDrivers, pose.thesisSites);
    return;
  }
  RigidTransform carried;
  if (model != OrganModel::staticJoint && organ.site) {
    const auto bySkin = parenting::carry(*organ.site, body.body().skin.triangles, pose.skin);
    // Collapsed anchors: what the nearest site does, which carrySites() already made sound.
    carried = bySkin ? *bySkin : pose.sites.carry[parenting::nearestSite(body.sites(), organ.reference)];
  } else if (organ.joint) {
    carried = pose.joints[organ.joint->value];
  }
  moveRigidly(organ.rest.positions, carried, posed, threads);
}

}  // namespace lorica::viscera
