#pragma once

/// \file
/// A deformation audit made by hand: two organs, one of open patches, in two poses and two models.

#include "lorica/analysis/deformation.h"

namespace lorica::testsupport {

inline viscera::OrganAudit closedOrgan(double volumeChange, double protrusion, double overlap) {
  viscera::OrganAudit organ;
  organ.volume = 1.5e-3 * (1.0 + volumeChange);
  organ.volumeChange = volumeChange;
  organ.outsideShare = viscera::Estimate{0.01, 0.001};
  organ.outsideSurface = 0.02;
  organ.protrusion = protrusion;
  organ.overlap = viscera::Estimate{overlap, 1e-7};
  organ.overlapBeyondRest = overlap;
  organ.gap = viscera::Gap{0.0012, 0.004, 0.002};
  organ.largestStretch = 1.25;
  return organ;
}

inline viscera::OrganAudit openOrgan(double protrusion) {
  viscera::OrganAudit organ;
  organ.basis = viscera::AuditBasis::surface;
  organ.outsideSurface = 0.0;
  organ.protrusion = protrusion;
  organ.largestStretch = 1.1;
  return organ;
}

/// Poses bend and turn; models static_joint and dynamic. The liver protrudes most when bent, and its volume changes
/// most when turned.
inline analysis::DeformationTables twoPoses() {
  analysis::DeformationTables tables;
  tables.organs = {"liver", "veins, small"};
  tables.poses = {"bend", "turn"};
  tables.models = {viscera::OrganModel::staticJoint, viscera::OrganModel::dynamic};
  for (std::size_t pose = 0; pose < 2; ++pose) {
    for (std::size_t model = 0; model < 2; ++model) {
      const bool rigid = model == 0;
      analysis::ModelDeformation row;
      row.pose = pose;
      row.model = model;
      row.audit.organs = {closedOrgan(rigid ? 0.0 : (pose == 0 ? 0.01 : -0.03),
                                      (pose == 0 ? 0.012 : 0.006) / (rigid ? 1.0 : 3.0), rigid ? 4e-5 : 0.0),
                          openOrgan(0.0)};
      row.lattices.resize(2);
      if (!rigid) {
        row.lattices[0] = {64, pose, 0.8 - 0.3 * static_cast<double>(pose)};
        row.lattices[1] = {10, 0, 0.9};
      }
      if (pose == 0) {
        viscera::ContactAudit contact;
        contact.first = 0;
        contact.second = 1;
        contact.gap = viscera::Gap{0.001, 0.002, 0.0005};
        row.audit.contacts = {contact};
      }
      tables.rows.push_back(std::move(row));
      tables.rooms.resize(2);
    }
  }
  return tables;
}

}  // namespace lorica::testsupport
