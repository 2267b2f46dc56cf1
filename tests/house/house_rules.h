#pragma once

/// \file
/// The rules of the house that can be read off its files: who may include whom, what no file may contain. Each
/// function returns what it objects to, in the order of the files.

#include <set>
#include <span>
#include <string>
#include <vector>

#include "source_text.h"

namespace lorica::house {

/// The core's modules in the order in which data walks down, and the modules each may use directly.
struct ModuleRule {
  std::string name;
  std::vector<std::string> mayUse;
};
const std::vector<ModuleRule>& moduleRules();

/// The module itself and everything it may use, directly or through another module.
std::set<std::string> reachable(const std::string& module);

/// core/<m> includes lorica/<n>/ only for modules it may use.
Findings checkModuleIncludes(std::span<const SourceFile> files);
/// widgets/<m> includes the headers of widgets' modules that stand before it in their order, and any of core's; core
/// includes none of them.
Findings checkWidgetIncludes(std::span<const SourceFile> files);
/// core/<m>/CMakeLists.txt links lorica::<n> only for modules it may use.
Findings checkModuleLinks(std::span<const SourceFile> files);
/// core/CMakeLists.txt lists the modules in their order, and every folder that holds one.
Findings checkModuleOrder(std::span<const SourceFile> files);
/// Embree, tinygltf, JSON, VTK, MPI and Qt are included only in their rooms.
Findings checkThirdParties(std::span<const SourceFile> files);
/// A public header of core includes the standard library, Eigen and Lorica's own headers, nothing else.
Findings checkPublicIncludes(std::span<const SourceFile> files);
/// The first line of a header.
Findings checkPragmaOnce(std::span<const SourceFile> files);
/// Core does not print and does not end the program.
Findings checkCoreIsSilent(std::span<const SourceFile> files);
/// Core takes no randomness from the standard library, whose distributions differ between implementations.
Findings checkRandomness(std::span<const SourceFile> files);
/// No marks of unfinished work.
Findings checkUnfinished(std::span<const SourceFile> files);
/// No folder of one machine and no package mirror.
Findings checkMachinePlaces(std::span<const SourceFile> files);
/// The top level holds what DESIGN allows there, names beginning with a dot, and what git ignores.
Findings checkTopLevel(std::span<const std::string> names);

}  // namespace lorica::house
