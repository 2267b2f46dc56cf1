#pragma once

#include <QColor>
#include <span>
#include <vector>

#include "lorica/document/inspection.h"

namespace lorica::viewport {

/// Which colour stands for which value. Steps that look alike are alike, for the colour-blind and in grey as well:
/// strain runs from blue over light grey to red (Moreland 2009), protrusion through viridis, from yellow where it is
/// shallow to violet where it is deep; what does not protrude is light grey.
struct ColourScale {
  document::Colouring what = document::Colouring::strain;
  double end = 1.0;  ///< strain: of both sides; protrusion: metres

  QColor at(double value) const;
  double low() const { return what == document::Colouring::strain ? -end : 0.0; }
};

/// The scale for values: its end is a round number beyond all but one in a hundred of the values that
/// are not zero, so that a single bad triangle does not pale all the others. At least 5 % and 1 mm.
ColourScale scaleFor(document::Colouring what, std::span<const std::span<const float>> values);

}  // namespace lorica::viewport
