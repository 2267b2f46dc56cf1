#include "run_view.h"

#include <algorithm>
#include <set>

#include "lorica/base/error.h"
#include "lorica/study/reserved_names.h"

namespace lorica::report {

namespace {

std::optional<std::string> firstOf(const std::vector<std::string>& models, std::initializer_list<const char*> wanted) {
  for (const char* name : wanted) {
    if (std::find(models.begin(), models.end(), name) != models.end()) {
      return name;
    }
  }
  return std::nullopt;
}

}  // namespace

RunView::RunView(const analysis::RunTables& tables) : run(tables) {
  const study::RunFacts& facts = run.facts;
  for (const study::RunFacts::Source& source : facts.sources) {
    sources.push_back(source.name);
  }
  for (const std::string& system : facts.systems) {
    if (system != study::unarmored) {
      armored.push_back(system);
    }
  }
  std::set<std::pair<std::string, std::string>> seen;
  std::vector<StructureKey> classes;
  for (const analysis::CoverageRow& row : run.summary) {
    rows_[{row.place.source, row.place.system, row.place.model, row.place.pose, row.kind, row.structure}] = &row;
    if (!seen.insert({row.kind, row.structure}).second) {
      continue;
    }
    const StructureKey key{row.kind, row.structure, row.injuryClass};
    if (row.kind == "organ") {
      organs.push_back(key);
    } else if (row.kind == "region") {
      regions.push_back(key);
    } else if (row.kind == "class") {
      classes.push_back(key);
    }
  }
  for (const StructureKey& key : classes) {
    if (std::any_of(organs.begin(), organs.end(),
                    [&](const StructureKey& organ) { return organ.injuryClass == key.structure; })) {
      totals.push_back(key);
    }
  }
  if (!organs.empty()) {
    totals.push_back({"aggregate", "organs"});
  }
  rigid = firstOf(facts.models, {"static_joint", "static_skin"});
  deforming = firstOf(facts.models, {"dynamic", "dynamic_thesis"});
  if (rigid && deforming) {
    shownModels = {*rigid, *deforming};
  } else if (!facts.models.empty()) {
    shownModels = {facts.models.front()};
  }
}

const analysis::CoverageRow* RunView::row(const std::string& source, const std::string& system,
                                          const std::string& model, const std::string& pose,
                                          const StructureKey& structure) const {
  const auto found = rows_.find({source, system, model, pose, structure.kind, structure.structure});
  return found == rows_.end() ? nullptr : found->second;
}

analysis::Coverage RunView::coverage(const std::string& source, const std::string& system, const std::string& model,
                                     const std::string& pose, const StructureKey& structure) const {
  const analysis::CoverageRow* found = row(source, system, model, pose, structure);
  return found == nullptr ? analysis::Coverage() : found->coverage;
}

bool RunView::wasShot(const std::string& source, const std::string& pose) const {
  return std::any_of(run.facts.runs.begin(), run.facts.runs.end(), [&](const study::RunFacts::Run& one) {
    return one.source == source && one.pose == pose && one.trials > 0;
  });
}

std::vector<std::string> RunView::posesOf(const std::string& source) const {
  std::vector<std::string> poses;
  for (const std::string& pose : run.facts.poses) {
    if (wasShot(source, pose)) {
      poses.push_back(pose);
    }
  }
  return poses;
}

std::optional<double> difference(const analysis::Coverage& first, const analysis::Coverage& second) {
  return first.value && second.value ? std::optional(*second.value - *first.value) : std::nullopt;
}

bool apart(const analysis::Coverage& a, const analysis::Coverage& b) {
  return a.low && a.high && b.low && b.high && (*a.high < *b.low || *b.high < *a.low);
}

}  // namespace lorica::report
