#pragma once

#include <vector>

#include "audit_meshes.h"
#include "lorica/base/parallel.h"
#include "lorica/base/progress.h"

namespace lorica::viscera {

/// A vertex of one organ that touches another organ at rest.
struct ContactPoint {
  std::uint32_t vertex = 0;
  double area = 0.0;      ///< m2 at rest that it stands for
  double distance = 0.0;  ///< metres from the other organ at rest; 0 inside it
};

/// Where one organ touches another at rest, seen from the first.
struct ContactSide {
  std::size_t from = 0;
  std::size_t onto = 0;
  std::vector<ContactPoint> points;
};

/// All sides that have points, by `from`, then `onto`.
/// \param areas of the vertices of every organ
/// \throw base::Cancelled
std::vector<ContactSide> findContacts(const std::vector<AuditMesh>& organs,
                                      const std::vector<std::vector<double>>& areas, double contactDistance,
                                      base::Threads threads, const base::Progress& progress);

/// Sums over contact points; those of several sides add up.
struct GapSums {
  double weighted = 0.0;  ///< metres times m2
  double area = 0.0;
  double largest = 0.0;

  void add(const GapSums& other);
};

/// Gaps of some of a side's points. \param organs in the pose
GapSums gapSums(const ContactSide& side, std::span<const ContactPoint> points, const std::vector<AuditMesh>& organs);

}  // namespace lorica::viscera
