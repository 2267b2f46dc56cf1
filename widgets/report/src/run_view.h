#pragma once

/// \file
/// A run's tables by name, and what a report compares in them.

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lorica/analysis/run_tables.h"

namespace lorica::report {

/// A structure as rows of the summary name it.
struct StructureKey {
  std::string kind;
  std::string structure;
  std::string injuryClass{};
};

class RunView {
 public:
  /// \pre tables outlive the view
  explicit RunView(const analysis::RunTables& tables);

  const analysis::RunTables& run;
  std::vector<std::string> sources;
  std::vector<std::string> armored;  ///< systems, without the unarmored body
  std::vector<StructureKey> organs;  ///< in the order of the tables
  std::vector<StructureKey> regions;
  std::vector<StructureKey> totals;      ///< essential, desirable and all organs, those that the run has
  std::optional<std::string> rigid;      ///< the static model that stands against `deforming`
  std::optional<std::string> deforming;  ///< the best dynamic model
  std::vector<std::string> shownModels;  ///< rigid and deforming, or the only one

  /// None where the run has no such row.
  const analysis::CoverageRow* row(const std::string& source, const std::string& system, const std::string& model,
                                   const std::string& pose, const StructureKey& structure) const;
  analysis::Coverage coverage(const std::string& source, const std::string& system, const std::string& model,
                              const std::string& pose, const StructureKey& structure) const;
  /// Whether anything was shot from a source at a pose.
  bool wasShot(const std::string& source, const std::string& pose) const;
  /// Poses that were shot from a source.
  std::vector<std::string> posesOf(const std::string& source) const;
  /// The model that stands for organs where only one is shown.
  const std::string& mainModel() const { return deforming ? *deforming : run.facts.models.front(); }

 private:
  std::map<std::tuple<std::string, std::string, std::string, std::string, std::string, std::string>,
           const analysis::CoverageRow*>
      rows_;
};

/// Second minus first; none where either is.
std::optional<double> difference(const analysis::Coverage& first, const analysis::Coverage& second);
/// Whether two intervals have no value in common.
bool apart(const analysis::Coverage& a, const analysis::Coverage& b);

}  // namespace lorica::report
