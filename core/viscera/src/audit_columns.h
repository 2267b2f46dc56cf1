#pragma once

#include <vector>

#include "audit_meshes.h"

namespace lorica::viscera {

/// Where columns through one organ stand: along the axis in which it shows the least, so that they stand closest.
struct ColumnPlan {
  int axis = 0;
  double spacing = 0.0;  ///< metres; 0 for an organ that shows nothing
};

/// \param columns about how many of one grid should meet the organ
ColumnPlan planColumns(const AuditMesh& organ, std::size_t columns);

/// Volumes from the columns of one grid, m3.
struct ColumnSums {
  double inside = 0.0;             ///< of the organ
  double insideBoth = 0.0;         ///< of what is in the skin too
  std::vector<double> overlapped;  ///< of what is in another organ too, one per partner
};

/// \param skin null for a skin that does not close
/// \param shift where the grid starts, in spacings, 0 to 1 each
/// Cost: one ray per column and mesh.
ColumnSums sumColumns(const AuditMesh& organ, const AuditMesh* skin, const std::vector<const AuditMesh*>& partners,
                      const ColumnPlan& plan, const std::array<double, 2>& shift);

}  // namespace lorica::viscera
