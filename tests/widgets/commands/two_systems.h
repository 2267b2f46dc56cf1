#pragma once

/// \file
/// A small study that has one of everything an edit can touch.

#include "lorica/study/study_file.h"

namespace lorica::test {

inline study::Study twoSystems() {
  return study::parseStudy(R"({
    "lorica_study": 1,
    "name": "two systems",
    "human": {"builtin": "human"},
    "organs": [
      {"name": "heart", "builtin": "human/heart", "class": "essential"},
      {"name": "liver", "builtin": "human/liver", "joint": "spine_2"},
      {"name": "widget", "builtin": "human/spleen"}
    ],
    "armor": [
      {"name": "plates", "pieces": [{"name": "front", "builtin": "front_plate"},
                                    {"name": "back", "builtin": "back_plate"}]},
      {"name": "light", "pieces": [{"name": "small", "builtin": "front_plate", "non_protecting": ["strap*"]}]}
    ],
    "poses": [
      {"name": "bent", "clip": "toe_touch", "seconds": 2},
      {"name": "belly_twist@1", "clip": "belly_twist", "seconds": 1},
      {"name": "turned", "turns": {"neck": [0, 30, 0]}}
    ],
    "run_poses": ["rest", "bent", "toe_touch@2"],
    "sources": [{"name": "ahead", "position": [0, 1, 5], "shots": 1000}, {"name": "left", "position": [5, 1, 0]}],
    "display": [
      {"structure": "body", "opacity": 0.5},
      {"structure": "liver", "visible": false, "colour": "#102030"},
      {"structure": "small", "visible": true}
    ]
  })",
                           "two systems");
}

}  // namespace lorica::test
