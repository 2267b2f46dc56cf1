#pragma once

/// \file
/// A study that uses every key, and what reading a text says about it.

#include <gtest/gtest.h>

#include <string>

#include "json_text.h"
#include "lorica/base/error.h"
#include "lorica/study/study_file.h"

namespace lorica::study {

inline const char* const fullStudy = R"({
  "lorica_study": 1,
  "name": "full",
  "description": "every key",
  "human": {
    "file": "body.glb", "units": "m", "up": "y", "parts": ["skin"],
    "sha256": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef",
    "joint_roles": {"pelvis": "bone_0", "toe_left": ["bone_7", "bone_8"]}
  },
  "organs": [
    {"name": "heart", "description": "a", "builtin": "human/heart", "class": "essential", "joint": "spine_2",
     "lattice": {"layout": "uniform", "cells": 3, "prune": false}},
    {"name": "liver", "file": "organs/liver.stl", "units": "mm", "up": "z", "parts": ["left", "right"],
     "sha256": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef",
     "class": "desirable", "lattice": {"layout": "per_axis", "cells": [1, 2, 3]}},
    {"name": "spleen", "builtin": "human/spleen", "lattice": {"cell_mm": 12.5}},
    {"name": "stomach", "builtin": "human/stomach", "lattice": {"layout": "bounding_box"}}
  ],
  "armor": [
    {"name": "vest", "description": "b", "pieces": [
      {"name": "front", "description": "c", "file": "vest/front.glb", "units": "cm", "up": "y", "parts": ["plate"],
       "sha256": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef",
       "carriage": "skinned", "non_protecting": ["pouch*"], "areal_density_kg_m2": 30.5, "material": "steel"},
      {"name": "back", "builtin": "back_plate"}]},
    {"name": "bare", "pieces": [{"name": "lone", "builtin": "front_plate"}]}
  ],
  "poses": [
    {"name": "bent", "description": "d", "clip": "toe_touch", "seconds": 2},
    {"name": "turned", "turns": {"elbow_L": [0, 0, 90], "neck": [1, -2, 3.5]}, "root_offset": [0, -0.1, 0]},
    {"name": "listed", "turns": [{"joint": "neck", "degrees": [1, 2, 3]}]}
  ],
  "run_poses": ["rest", "bent", "walk@1.5"],
  "sources": [
    {"name": "front", "description": "e", "type": "point", "position": [0, 1, 5], "target": [0, 1.2, 0],
     "sampler": "thesis", "shots": 1000},
    {"name": "left", "position": [5, 1, 0]},
    {"name": "window", "position": [0, 1, 5], "target_structure": "heart", "sampler": "rectangle", "width_m": 0.5,
     "height_m": 0.75, "sequence": "sobol"},
    {"name": "disk", "position": [0, 1, 5], "sampler": "disk", "radius_m": 0.25},
    {"name": "far", "type": "parallel", "azimuth_deg": 30, "elevation_deg": -10, "sequence": "grid", "cell_mm": 12.5},
    {"name": "ground", "type": "band", "azimuth_deg": [0, 360], "elevation_deg": [-15, 15], "target": [0, 1, 0],
     "sequence": "sobol", "shots": 5000},
    {"name": "all", "type": "sphere"},
    {"name": "listed", "type": "list", "file": "shots.csv",
     "sha256": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"}
  ],
  "threats": [
    {"name": "gauge", "description": "f", "file": "blast.csv",
     "sha256": "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef", "units": "mm", "up": "z",
     "time_units": "us", "attribute": "pressure", "threshold": 35.5, "reach_mm": 12.5, "time_offset_ms": -1.25,
     "offset": [0, 1, 2], "turn_deg": [0, 90, 0], "display": {"visible": false, "range": [-1, 100]}},
    {"name": "charge", "builtin": "blast", "tnt_kg": 2.5, "position": [0, 1, 4]}
  ],
  "models": ["static_skin", "dynamic_thesis"],
  "trials": 7,
  "seed": 18446744073709551615,
  "stop": {"structures": ["heart"], "half_width": 0.02, "max_trials": 50},
  "overlap": {"policy": "priority", "order": ["heart", "front"]},
  "analyses": {"compare": true, "convergence": true, "directions": {"step_deg": 45, "shots": 500},
               "motion": {"clip": "walk", "every": 5, "frames_per_second": 24},
               "gaps": {"structures": ["body", "heart"], "open_share": 0.25, "min_shots": 30, "radius_mm": 12.5,
                        "maps": false},
               "anatomy": {"draws": 20, "scale": 0.5, "verified_only": true, "sd_mm": {"heart": [5, 10, 2.5]}}},
  "site_spacing_mm": 25,
  "skinning": "linear",
  "deformer": "lattice",
  "display": [
    {"structure": "heart", "visible": false, "colour": "#c02818", "opacity": 0.5},
    {"structure": "body", "visible": true}
  ]
})";

/// The error that parsing ends in; a test failure and an empty error when there is none.
inline base::InputError errorOf(const std::string& text) {
  try {
    parseStudy(text, "s.lorica.json");
  } catch (const base::InputError& error) {
    return error;
  }
  ADD_FAILURE() << "no error in " << text;
  return {"", "", ""};
}

/// The full study with another value at a JSON pointer.
inline Json fullStudyWith(const std::string& pointer, const Json& value) {
  Json tree = Json::parse(fullStudy);
  tree[Json::json_pointer(pointer)] = value;
  return tree;
}

}  // namespace lorica::study
