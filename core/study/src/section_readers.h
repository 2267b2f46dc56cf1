#pragma once

/// \file
/// Readers of the sections of a study file that stand by themselves. All throw base::InputError with the JSON pointer.

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "json_node.h"
#include "json_text.h"
#include "lorica/study/study.h"

namespace lorica::study {

/// Names that must differ, each with the pointer of the one that has it.
class Names {
 public:
  void claim(const Node& node, const std::string& name) {
    const auto [place, fresh] = taken_.emplace(name, node.pointer());
    if (!fresh) {
      node.fail(fmt::format("the name {} is taken by {}; choose another", inQuotes(name), place->second));
    }
  }

 private:
  std::map<std::string, std::string> taken_;
};

/// The member `description`, empty when absent.
std::string readDescription(const Node& node);
std::string sha256Text(const Node& node);
/// The keys of a file inside the object that has it.
InputFile readInputFile(const Node& node);

Source readSource(const Node& node);
Threat readThreat(const Node& node);
StopRule readStop(const Node& node);
Overlap readOverlap(const Node& node);
Analyses readAnalyses(const Node& node);
/// Names that differ. \param what as in "a list of WHAT"
std::vector<std::string> nameList(const Node& node, const std::string& what);

}  // namespace lorica::study
