#pragma once

/// \file
/// A study with a source of every type, sampler and sequence.

#include "lorica/study/study_file.h"

namespace lorica::testsupport {

/// Sources as they stand in a study file, and the file of shots that `listed` names.
inline const char* everySource() {
  return R"([
    {"name": "cone", "position": [0, 1, 5], "shots": 1000},
    {"name": "window", "position": [2.5, 1.25, 4], "target_structure": "heart", "sampler": "rectangle",
     "width_m": 0.5, "height_m": 0.75, "sequence": "sobol", "shots": 2048},
    {"name": "spot", "position": [0, 1, -3], "target": [0, 1.2, 0.1], "sampler": "disk", "radius_m": 0.123456,
     "shots": 512},
    {"name": "eq 15", "position": [0, 1, 5], "sampler": "thesis", "shots": 700},
    {"name": "beam", "type": "parallel", "azimuth_deg": 33.333, "elevation_deg": -12.5, "shots": 900},
    {"name": "grid", "type": "parallel", "azimuth_deg": 0, "elevation_deg": 0, "sequence": "grid", "cell_mm": 17.3},
    {"name": "ground", "type": "band", "azimuth_deg": [0, 360], "elevation_deg": [-15, 15], "shots": 800},
    {"name": "sphere", "type": "sphere", "sequence": "sobol", "shots": 1024},
    {"name": "listed", "type": "list", "file": "shots.csv"}
  ])";
}

/// The sample study with them and with all a run can be asked for.
inline study::Study studyWithEverySource() {
  study::Study study = study::parseStudy(study::templateText("sample"), "sample");
  const std::string text = R"({"lorica_study": 1, "human": {"builtin": "human"}, "sources": )" +
                           std::string(everySource()) + R"(, "models": ["dynamic"], "trials": 3, "seed": 9,
    "stop": {"structures": ["heart", "liver"], "half_width": 0.0123, "max_trials": 40},
    "overlap": {"policy": "priority", "order": ["heart", "liver"]},
    "analyses": {"compare": true, "convergence": true, "directions": {"step_deg": 45, "shots": 500},
                 "motion": {"clip": "toe_touch", "every": 7, "frames_per_second": 24.5},
                 "gaps": {"structures": ["body", "liver"], "open_share": 0.2, "min_shots": 30, "radius_mm": 12.5,
                          "maps": false},
                 "anatomy": {"draws": 7, "scale": 0.75, "verified_only": true, "sd_mm": {"liver": [1, 2, 3]}}}})";
  const study::Study asked = study::parseStudy(text, "every source");
  study.sources = asked.sources;
  study.stop = asked.stop;
  study.overlap = asked.overlap;
  study.analyses = asked.analyses;
  return study;
}

}  // namespace lorica::testsupport
