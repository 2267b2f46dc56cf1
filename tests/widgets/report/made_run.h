#pragma once

/// \file
/// Tables of a run that never was, of any size, with numbers that tell rows apart.

#include <string>
#include <vector>

#include "lorica/analysis/run_tables.h"

namespace lorica::test {

struct RunSize {
  std::vector<std::string> systems{"vest"};
  std::vector<std::string> poses{"rest"};
  std::vector<std::string> sources{"front"};
  std::vector<std::string> models{"static_joint", "dynamic"};
  std::vector<std::string> organs{"heart", "liver"};
};

inline analysis::RunTables madeRun(const RunSize& size) {
  analysis::RunTables run;
  study::RunFacts& facts = run.facts;
  facts.version = "0.1.0";
  facts.study = "made up";
  facts.studyHash = std::string(64, 'a');
  facts.seed = 7;
  facts.trials = 3;
  facts.models = size.models;
  facts.systems = {"unarmored"};
  facts.systems.insert(facts.systems.end(), size.systems.begin(), size.systems.end());
  facts.poses = size.poses;
  facts.deformer = "soft_body";
  std::uint64_t turn = 0;
  for (const std::string& source : size.sources) {
    study::RunFacts::Source made;
    made.name = source;
    made.type = "point";
    made.sampler = "cone";
    made.sequence = "random";
    made.interval = "Wilson, 95 %";
    made.shotsPerTrial = 10000;
    made.position = {0.0, 1.0, 5.0};
    facts.sources.push_back(made);
    for (const std::string& pose : size.poses) {
      facts.runs.push_back({source, pose, 3, 30000, 0, 0, 0, {}});
    }
    for (const std::string& system : facts.systems) {
      for (const std::string& model : size.models) {
        for (const std::string& pose : size.poses) {
          const auto add = [&](const std::string& structure, const std::string& kind, const std::string& injuryClass) {
            // Scattered, so that neighbours differ.
            ++turn;
            const double share =
                system == "unarmored" ? 0.0 : static_cast<double>((turn * turn * 17 + turn * 389) % 997) / 997.0;
            analysis::CoverageRow row;
            row.place = {source, system, model, pose};
            row.structure = structure;
            row.kind = kind;
            row.injuryClass = injuryClass;
            row.shots = 30000;
            row.any = 1000;
            row.first = 500;
            row.protectedHits = static_cast<std::uint64_t>(1000.0 * share);
            row.unprotectedHits = 1000 - row.protectedHits;
            row.percentOfShots = 100.0 / 30.0;
            row.percentOfBodyHits = 12.5;
            row.coverage = {share, share > 0.02 ? share - 0.02 : 0.0, share < 0.98 ? share + 0.02 : 1.0};
            run.summary.push_back(row);
          };
          add("body", "body", "");
          add("chest", "region", "");
          for (const std::string& organ : size.organs) {
            add(organ, "organ", organ == size.organs.front() ? "essential" : "");
            if (source == size.sources.front() && system == "unarmored") {
              run.deformation.push_back({organ, model, pose, 0.1, 0.0, 0.0, 0.2, 0.1, 0.3, 1.1, 0, "closed", ""});
            }
          }
          add("organs", "aggregate", "");
          add("essential", "class", "essential");
          add("desirable", "class", "desirable");
        }
      }
    }
  }
  return run;
}

}  // namespace lorica::test
