#pragma once

/// \file
/// What a report is made of, in its order. A chapter writes onto the sheet; one without anything to say leaves it.

#include "lorica/report/report.h"
#include "run_view.h"
#include "sheet.h"

namespace lorica::report {

struct Report {
  Sheet& sheet;
  const analysis::RunTables& run;
  const RunView& view;
  const PictureSet& pictures;
};

/// \param contents as a draft of the report found them
void writeTitle(const Report& report, const std::vector<ContentsLine>& contents);
void writeFindings(const Report& report);
void writePictureChapter(const Report& report);
void writeOrganCoverage(const Report& report);
void writeRegionCoverage(const Report& report);
void writeComparisons(const Report& report);
void writePieces(const Report& report);
void writeConvergence(const Report& report);
void writeMotion(const Report& report);
void writeDirections(const Report& report);
void writeGaps(const Report& report);
void writeAnatomy(const Report& report);
void writeDeformation(const Report& report);
void writeMethods(const Report& report);
void writeRecord(const Report& report);

/// A row of three pictures at the sheet's left edge, `height` mm high for the tallest of the set; moves the sheet on.
void drawPoseRow(Sheet& sheet, const PictureSet& pictures, const PosePictures& pose, double height);

}  // namespace lorica::report
