#pragma once

/// \file
/// What drives one organ in one model, in a pose, as it can be drawn: the lattice, the interior sites with their
/// anchors and reference frames, or the joint. Computed by the same calls that deform the organ.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "lorica/analysis/posed_scene.h"

namespace lorica::jobs {

/// What of the drivers stays the same in every pose. Indices are into what drives the organ in its model.
struct DriverLayout {
  viscera::OrganModel model = viscera::OrganModel::dynamic;
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< of cells that hold a vertex, each once: pairs of control points
  std::vector<std::uint32_t> sites;                 ///< sites that carry a control point, rising
  std::size_t middle = 0;                           ///< index into `sites` of that nearest to the organ's middle
  bool byJoint = false;                             ///< one joint carries it, rigidly
  /// For an organ that is part of the soft body: the cells of it that hold a vertex of the organ, with their control
  /// points at rest, metres. The skin moves them, no site.
  bool inSoftBody = false;
  std::vector<std::uint32_t> softPoints;    ///< control points of the soft body, rising; `edges` are into these
  std::vector<geometry::Vec3d> softPlaces;  ///< where those are at rest
};

/// A place with the axes of its reference frame. Metres.
struct DriverFrame {
  geometry::Vec3f origin = geometry::Vec3f::Zero();
  std::array<geometry::Vec3f, 3> axes{};  ///< of length 1, at right angles
};

/// An interior site that drives, posed.
struct DriverSite {
  DriverFrame frame;
  std::array<geometry::Vec3f, 3> anchors{};  ///< on the posed skin
};

struct OrganDrivers {
  std::shared_ptr<const DriverLayout> layout;
  std::vector<geometry::Vec3f> controlPoints;  ///< empty for rigid organs
  std::size_t pruned = 0;                      ///< control points that were left out, since no vertex is near
  std::vector<DriverSite> sites;               ///< one for each of layout->sites, or the one that carries a rigid organ
  std::vector<geometry::Vec3f> otherSites;     ///< the body's other interior sites
  std::optional<DriverFrame> joint;
  std::string jointName;
};

/// \param index of the organ in the study. Thread-safe. Cost: a sort of the cells' edges.
DriverLayout driverLayout(const analysis::LoadedStudy& study, std::size_t index, viscera::OrganModel model);

/// \param index of the organ in the study \param layout of this organ \param scene shows the study
/// Thread-safe. Cost: that of posing the control points once more.
OrganDrivers poseDrivers(const analysis::LoadedStudy& study, std::size_t index,
                         std::shared_ptr<const DriverLayout> layout, const analysis::PosedScene& scene,
                         base::Threads threads);

/// Edges of cells, each once, smaller index first. \param cells corners in the order of Eq 12
std::vector<std::array<std::uint32_t, 2>> cellEdges(std::span<const std::array<std::uint32_t, 8>> cells);

}  // namespace lorica::jobs
