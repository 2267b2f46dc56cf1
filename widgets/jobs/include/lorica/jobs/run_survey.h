#pragma once

/// \file
/// What the study of a run asks for beside the run: coverage by direction and over a motion as rows, gaps in the armor,
/// and coverage over the places where organs may lie.

#include <memory>
#include <optional>
#include <vector>

#include "lorica/analysis/anatomy.h"
#include "lorica/analysis/gaps.h"
#include "lorica/base/progress.h"
#include "lorica/document/study_document.h"

namespace lorica::jobs {

/// Rows of a parallel beam from one direction.
struct DirectionRows {
  std::size_t pose = 0;    ///< index into the run's
  double azimuth = 0.0;    ///< degrees, as lorica/shotline/source.h has them
  double elevation = 0.0;  ///< degrees
  double area = 0.0;       ///< m2 across the shots
  std::vector<analysis::ResultRow> rows;
};

/// Rows of one source at one frame of the motion.
struct FrameRows {
  double seconds = 0.0;
  std::vector<analysis::ResultRow> rows;
};

/// A gap as the view marks it.
struct SkinPatch {
  std::shared_ptr<const parenting::BodyRig> body;  ///< whose skin has the triangles
  std::string pose;
  std::vector<std::uint32_t> triangles;
  geometry::Vec3d centre = geometry::Vec3d::Zero();   ///< metres, in that pose
  geometry::Vec3d towards = geometry::Vec3d::Zero();  ///< against its shots; shorter than 1 the more they spread
};

struct RunSurvey {
  std::shared_ptr<const document::RunRecord> run;
  std::vector<DirectionRows> directions;
  std::vector<FrameRows> frames;  ///< source by source, frame by frame
  std::optional<std::vector<analysis::Gap>> gaps;
  std::optional<analysis::AnatomyResult> anatomy;
};

/// Whether the run's study asks for any of it.
bool asksForSurvey(const document::RunRecord& run);

/// Shoots it: the numbers of gaps.csv, anatomy.csv, directions.csv and motion.csv.
/// \throw base::InputError for an unknown clip or structure, base::Cancelled
RunSurvey surveyOf(const std::shared_ptr<const document::RunRecord>& run, const base::Progress& progress);

}  // namespace lorica::jobs
