#pragma once

/// \file
/// Coverage drawn on an axis from 0 to 100 %: a mark with its 95 % interval for each model or system. Marks differ in
/// shape and in lightness, so that they stay apart in print without colour.

#include <vector>

#include "lorica/analysis/run_tables.h"
#include "sheet.h"

namespace lorica::report {

/// Of the models in the order static_joint, static_skin, dynamic_thesis, dynamic.
enum class Mark { hollowCircle, hollowSquare, greyDiamond, fullCircle };

Mark markOf(const std::string& model);

struct MarkedCoverage {
  Mark mark;
  analysis::Coverage coverage;
};

/// Marks in a rectangle, one below the other, over a grid of quarters.
void drawCoverage(Sheet& sheet, const QRectF& box, const std::vector<MarkedCoverage>& marks);
/// "0", "50" and "100 %" where drawCoverage() has them.
void drawCoverageScale(Sheet& sheet, const QRectF& box);
/// A line that says which mark is which model, at the sheet's place; moves it on.
void drawMarkLegend(Sheet& sheet, const std::vector<std::string>& models);

}  // namespace lorica::report
