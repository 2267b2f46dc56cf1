#pragma once

/// \file
/// A look into how organs deform: what drives one of them, drawn around it, and organs coloured by how they fare. It
/// belongs to the window, like the pose and the models that are shown: it changes no number and is not kept in the
/// study.

#include <QFlags>
#include <string>

#include "lorica/document/appearance.h"

namespace lorica::document {

class StudyDocument;

/// What drives an organ (thesis Figures 11-13, 22, 28, 29).
enum class Driver : unsigned {
  lattice = 1,        ///< edges of the lattice's cells
  controlPoints = 2,  ///< of the lattice
  sites = 4,          ///< interior sites of the body
  rays = 8,           ///< from a site to its three anchors on the skin
  frames = 16         ///< reference frames of sites, as axes
};
Q_DECLARE_FLAGS(Drivers, Driver)
Q_DECLARE_OPERATORS_FOR_FLAGS(Drivers)

/// What the colours of organs say.
enum class Colouring {
  own,        ///< which organ it is
  strain,     ///< how much longer than at rest the edges at a vertex are
  protrusion  ///< how deep a vertex lies beyond the posed skin
};

struct Inspection {
  std::string organ;  ///< whose drivers are drawn; empty: nobody's
  Drivers drivers;
  Colouring colouring = Colouring::own;

  bool showsDrivers() const { return !organ.empty() && drivers != Drivers(); }
  bool operator==(const Inspection&) const = default;
};

/// How a structure is drawn now: as the study says, except that what would hide the drivers or the colours that are
/// looked at is made more see-through, and the organ looked into is visible.
/// \param structure "body", or the name of an organ or a piece
Appearance drawnAppearance(const StudyDocument& document, const std::string& structure);

}  // namespace lorica::document
