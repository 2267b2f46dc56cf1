#pragma once

/// \file
/// How the organs of a frame fare, vertex by vertex: what the view colours them by.

#include <QObject>
#include <memory>
#include <span>
#include <vector>

#include "lorica/document/inspection.h"
#include "lorica/jobs/frame_engine.h"
#include "lorica/jobs/job.h"

namespace lorica::jobs {

struct OrganColours {
  std::shared_ptr<const Frame> frame;  ///< the moment that was looked at
  document::Colouring what = document::Colouring::own;
  /// A value for each vertex, organs in the order of Frame::organNormals. Strain: posed over rest length, less 1.
  /// Protrusion: metres beyond the skin, 0 for what is inside. Empty where there is trouble.
  std::vector<std::vector<float>> values;
  QString trouble;  ///< why there are no values, one sentence
};

/// For each vertex the strain of the edges at it: their length together, posed over rest, less 1. That changes smoothly
/// along a surface and keeps its sign; what one direction gains and another loses cancels out. 0 for vertices without
/// an edge. Cost: linear. \pre as many posed as rest vertices
std::vector<float> edgeStrain(const geometry::TriangleMesh& rest, std::span<const geometry::Vec3f> posed);

/// For each point how far beyond the skin it lies, metres: 0 where the skin winds around it, as METHOD's signed winding
/// has it, and within a hundredth of a millimetre of the skin.
/// \param skin a built scene that holds the skin, and nothing else, as mesh 0. \pre the skin closes
/// Cost: a ray for each point, and a search for the nearest place for each one outside.
/// \throw base::Cancelled
std::vector<float> protrusion(std::span<const geometry::Vec3f> points, const raycast::Scene& skin,
                              base::Threads threads, const base::Progress& progress);

/// Computes them off the window's thread. What is asked for replaces what was asked for before.
class OrganColourer : public QObject {
  Q_OBJECT

 public:
  explicit OrganColourer(QObject* parent = nullptr);
  /// Waits until the work has seen that it is over.
  ~OrganColourer() override;

  /// \pre frame is not null, what is not Colouring::own. The frame is held until the work ends.
  void request(std::shared_ptr<const Frame> frame, document::Colouring what);
  /// ready() comes for nothing that was asked for before.
  void abandon();
  bool isBusy() const { return job_ != nullptr; }

 Q_SIGNALS:
  void ready(std::shared_ptr<const lorica::jobs::OrganColours> colours);

 private:
  std::unique_ptr<Job> job_;
};

}  // namespace lorica::jobs
