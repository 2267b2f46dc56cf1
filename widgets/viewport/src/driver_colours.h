#pragma once

#include <QColor>
#include <array>

/// \file
/// How what drives an organ is drawn, in the view and in its legend.

namespace lorica::viewport {

inline const QColor latticeColour(64, 84, 140);
inline const QColor controlPointColour(24, 40, 104);
inline const QColor siteColour(0, 128, 96);
inline const QColor otherSiteColour(140, 160, 154);
inline const QColor rayColour(213, 94, 0);
inline const QColor otherRayColour(232, 190, 158);
inline const std::array<QColor, 3> axisColours{QColor(196, 32, 32), QColor(36, 138, 36), QColor(36, 72, 208)};

}  // namespace lorica::viewport
