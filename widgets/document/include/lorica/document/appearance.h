#pragma once

/// \file
/// How structures are drawn: what the study says, else the program's defaults.

#include <QColor>
#include <string>
#include <vector>

#include "lorica/study/study.h"

namespace lorica::document {

struct Appearance {
  bool visible = true;
  QColor colour;
  double opacity = 1.0;  ///< 0 to 1
};

/// An entry of Study::displays decides whether its structure is visible; colour and opacity it does not give are the
/// program's.
/// \param structure "body", or the name of an organ or a piece
Appearance appearanceOf(const study::Study& study, const std::string& structure);
/// The program's default alone: a translucent skin, organs coloured by what their names say, armor in greys and greens.
/// Of several armor systems only the first is visible, since they are worn in the same place.
Appearance defaultAppearance(const study::Study& study, const std::string& structure);
/// body, organs, pieces: everything that is drawn, in the study's order.
std::vector<std::string> drawnStructures(const study::Study& study);

}  // namespace lorica::document
