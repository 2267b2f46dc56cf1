#include "house_rules.h"

#include <algorithm>
#include <optional>
#include <regex>
#include <string_view>

namespace lorica::house {

const std::vector<ModuleRule>& moduleRules() {
  static const std::vector<ModuleRule> rules{
      {"base", {}},
      {"stats", {"base"}},
      {"geometry", {"base"}},
      {"raycast", {"geometry"}},
      {"human", {"geometry"}},
      {"io", {"human"}},
      {"parenting", {"raycast", "human"}},
      {"viscera", {"parenting"}},
      {"armor", {"parenting"}},
      {"manikin", {"stats", "viscera", "armor"}},
      {"shotline", {"raycast", "stats"}},
      {"threat", {"geometry"}},
      {"study", {"manikin", "shotline", "threat", "io"}},
      {"analysis", {"study"}},
  };
  return rules;
}

std::set<std::string> reachable(const std::string& module) {
  std::set<std::string> all{module};
  for (const ModuleRule& rule : moduleRules()) {
    if (rule.name == module) {
      for (const std::string& used : rule.mayUse) {
        all.merge(reachable(used));
      }
    }
  }
  return all;
}

namespace {

bool isCpp(const SourceFile& file) {
  return file.path.ends_with(".h") || file.path.ends_with(".cpp");
}

bool isIn(const std::string& path, std::string_view folder) {
  return path.starts_with(folder) && path.size() > folder.size() && path[folder.size()] == '/';
}

/// The module whose folder holds a file of core.
std::optional<std::string> moduleOf(const std::string& path) {
  static const std::regex pattern("^core/([^/]+)/.*");
  std::smatch match;
  if (!std::regex_match(path, match, pattern)) {
    return std::nullopt;
  }
  return match[1].str();
}

bool isPublicHeader(const SourceFile& file) {
  return file.path.ends_with(".h") && isIn(file.path, "core") && file.path.find("/include/") != std::string::npos;
}

using TextMatch = std::match_results<std::string_view::const_iterator>;

/// One finding for every line of `text` that holds `pattern`.
void findLines(const SourceFile& file, std::string_view text, const std::regex& pattern, const std::string& objection,
               Findings& found) {
  const std::vector<std::string_view> all = splitLines(text);
  for (std::size_t i = 0; i < all.size(); ++i) {
    TextMatch match;
    if (std::regex_search(all[i].begin(), all[i].end(), match, pattern)) {
      found.push_back({file.path, i + 1, objection});
    }
  }
}

}  // namespace

Findings checkModuleIncludes(std::span<const SourceFile> files) {
  static const std::regex own("^lorica/([^/]+)/.*");
  Findings found;
  for (const SourceFile& file : files) {
    const std::optional<std::string> module = moduleOf(file.path);
    if (!module || !isCpp(file)) {
      continue;
    }
    const std::set<std::string> allowed = reachable(*module);
    for (const Include& include : includes(file.text)) {
      std::smatch match;
      if (std::regex_match(include.header, match, own) && !allowed.contains(match[1].str())) {
        found.push_back({file.path, include.line, *module + " may not use " + match[1].str()});
      }
    }
  }
  return found;
}

Findings checkWidgetIncludes(std::span<const SourceFile> files) {
  static const std::vector<std::string> order{"document", "commands", "jobs",   "models",
                                              "report",   "viewport", "panels", "dialogs"};
  static const std::regex own("^lorica/([^/]+)/.*");
  static const std::regex room("^widgets/([^/]+)/.*");
  const auto placeOf = [](const std::string& name) { return std::find(order.begin(), order.end(), name); };
  Findings found;
  for (const SourceFile& file : files) {
    std::smatch match;
    const bool widget = std::regex_match(file.path, match, room);
    if (!isCpp(file) || !(widget || isIn(file.path, "core"))) {
      continue;
    }
    const std::string name = widget ? match[1].str() : "core";
    for (const Include& include : includes(file.text)) {
      std::smatch header;
      if (!std::regex_match(include.header, header, own)) {
        continue;
      }
      const auto used = placeOf(header[1].str());
      // Core stands before all of them.
      if (used != order.end() && (!widget || used > placeOf(name))) {
        found.push_back({file.path, include.line, name + " may not use " + *used});
      }
    }
  }
  return found;
}

Findings checkModuleLinks(std::span<const SourceFile> files) {
  static const std::regex link("lorica::([a-z_]+)");
  Findings found;
  for (const SourceFile& file : files) {
    const std::optional<std::string> module = moduleOf(file.path);
    if (!module || !file.path.ends_with("/CMakeLists.txt")) {
      continue;
    }
    const std::set<std::string> allowed = reachable(*module);
    const std::vector<std::string_view> all = splitLines(file.text);
    for (std::size_t i = 0; i < all.size(); ++i) {
      using Each = std::regex_iterator<std::string_view::const_iterator>;
      for (Each each(all[i].begin(), all[i].end(), link); each != Each(); ++each) {
        const std::string used = (*each)[1].str();
        if (!allowed.contains(used)) {
          found.push_back({file.path, i + 1, *module + " may not link " + used});
        }
      }
    }
  }
  return found;
}

Findings checkModuleOrder(std::span<const SourceFile> files) {
  static const std::regex loop(R"(foreach\s*\(\s*module\s+([^)]*)\))");
  static const std::regex word("[A-Za-z_]+");
  const std::string path = "core/CMakeLists.txt";
  const auto list = std::find_if(files.begin(), files.end(), [&](const SourceFile& f) { return f.path == path; });
  std::smatch match;
  if (list == files.end() || !std::regex_search(list->text, match, loop)) {
    return {{path, 0, "has no foreach(module ...) that lists the modules"}};
  }
  Findings found;
  const std::string names = match[1].str();
  std::set<std::string> listed;
  std::size_t next = 0;
  for (std::sregex_iterator each(names.begin(), names.end(), word); each != std::sregex_iterator(); ++each) {
    const std::string name = each->str();
    listed.insert(name);
    const auto& rules = moduleRules();
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const ModuleRule& r) { return r.name == name; });
    const auto place = static_cast<std::size_t>(rule - rules.begin());
    if (rule == rules.end()) {
      found.push_back({path, 0, name + " is no module of the house"});
    } else if (place < next) {
      found.push_back({path, 0, name + " is listed too late or twice"});
    } else {
      next = place + 1;
    }
  }
  std::set<std::string> unlisted;
  for (const SourceFile& file : files) {
    const std::optional<std::string> module = moduleOf(file.path);
    if (module && !listed.contains(*module)) {
      unlisted.insert(*module);
    }
  }
  for (const std::string& module : unlisted) {
    found.push_back({path, 0, "the folder core/" + module + " is not listed"});
  }
  return found;
}

namespace {

/// A library and the folders whose files may include its headers.
struct ThirdParty {
  std::string name;
  std::regex header;
  std::vector<std::string> rooms;
};

const std::vector<ThirdParty>& thirdParties() {
  static const std::vector<ThirdParty> parties{
      {"Embree", std::regex("^embree[0-9]*/.*"), {"core/raycast/src", "app/cli/bench", "tests/benchmarks"}},
      {"tinygltf", std::regex("^(.*/)?tiny_gltf\\.h$"), {"core/io/src", "app/cli/bench", "tests/benchmarks"}},
      {"JSON", std::regex("^nlohmann/.*"), {"core/study/src", "core/io/src", "app", "tests"}},
      {"VTK",
       std::regex("^(vtk-[0-9.]+/)?vtk[A-Za-z_0-9]*\\.h$"),
       {"core/geometry/src", "core/threat/src", "core/io/src", "widgets/viewport/src", "widgets/report",
        "app/cli/bench", "tests"}},
      {"CGAL", std::regex("^CGAL/.*"), {"app/cli/bench", "tests/benchmarks"}},
      {"meshoptimizer", std::regex("^(.*/)?meshoptimizer\\.h$"), {"widgets/viewport/src"}},
      {"MPI", std::regex("^(.*/)?mpi\\.h$"), {"app/mpi"}},
      {"Qt",
       std::regex("^(Qt[A-Za-z0-9]*/.*|Q[A-Za-z0-9]+|q[a-z0-9]+\\.h)$"),
       {"widgets", "app/gui", "app/cli", "tests/widgets", "tests/gui"}},
  };
  return parties;
}

}  // namespace

Findings checkThirdParties(std::span<const SourceFile> files) {
  Findings found;
  for (const SourceFile& file : files) {
    if (!isCpp(file)) {
      continue;
    }
    for (const Include& include : includes(file.text)) {
      for (const ThirdParty& party : thirdParties()) {
        const bool inItsRoom = std::any_of(party.rooms.begin(), party.rooms.end(),
                                           [&](const std::string& room) { return isIn(file.path, room); });
        if (!inItsRoom && std::regex_match(include.header, party.header)) {
          found.push_back({file.path, include.line, party.name + " is not allowed in this room"});
        }
      }
    }
  }
  return found;
}

Findings checkPublicIncludes(std::span<const SourceFile> files) {
  static const std::regex standard("^[a-z_0-9]+$");
  Findings found;
  for (const SourceFile& file : files) {
    if (!isPublicHeader(file)) {
      continue;
    }
    for (const Include& include : includes(file.text)) {
      const bool allowed = include.angled
                               ? include.header.starts_with("Eigen/") || std::regex_match(include.header, standard)
                               : include.header.starts_with("lorica/");
      if (!allowed) {
        found.push_back({file.path, include.line, include.header + " does not belong in a public header of core"});
      }
    }
  }
  return found;
}

Findings checkPragmaOnce(std::span<const SourceFile> files) {
  Findings found;
  for (const SourceFile& file : files) {
    if (file.path.ends_with(".h") && !file.text.starts_with("#pragma once\n")) {
      found.push_back({file.path, 1, "a header begins with #pragma once"});
    }
  }
  return found;
}

Findings checkCoreIsSilent(std::span<const SourceFile> files) {
  static const std::regex prints(
      R"(\bstd::(w?cout|w?cerr|w?clog)\b|\b(f|v|vf)?printf\s*\(|\b(f?puts|putchar|perror)\s*\(|\bfmt::print\b)"
      R"(|#\s*include\s*<iostream>)");
  // A call in the place of a statement or behind std:: or ::, so that an interval may have an exit().
  static const std::regex ends(
      R"((^|[;{}():?&|,]|\belse)\s*(std::|::)?(exit|_exit|_Exit|quick_exit|abort|terminate)\s*\()");
  Findings found;
  for (const SourceFile& file : files) {
    if (isCpp(file) && isIn(file.path, "core")) {
      const std::string code = codeOnly(file.text);
      findLines(file, code, prints, "core does not print", found);
      findLines(file, code, ends, "core does not end the program", found);
    }
  }
  return found;
}

Findings checkRandomness(std::span<const SourceFile> files) {
  static const std::regex random(R"(\bstd::[a-z_]+_distribution\b|\bstd::random_device\b|\bs?rand\s*\()");
  Findings found;
  for (const SourceFile& file : files) {
    if (isCpp(file) && isIn(file.path, "core")) {
      findLines(file, codeOnly(file.text), random, "randomness comes from lorica/stats", found);
    }
  }
  return found;
}

// The patterns below are cut in pieces, so that this file passes its own check.

Findings checkUnfinished(std::span<const SourceFile> files) {
  static const std::regex marks(
      "\\b(TO"
      "DO|FIX"
      "ME|X"
      "XX)\\b");
  Findings found;
  for (const SourceFile& file : files) {
    findLines(file, file.text, marks, "a mark of unfinished work", found);
  }
  return found;
}

Findings checkMachinePlaces(std::span<const SourceFile> files) {
  static const std::regex folder(
      "(^|[^A-Za-z0-9_.}*)-])/(wo"
      "rk|ho"
      "me|ro"
      "ot|Us"
      "ers|m"
      "nt)/");
  static const std::regex mirror(
      "(deb|security|ftp|archive|mirror|mirrors|packages|snapshot|httpredir|registry)\\.([a-z]+\\.)*"
      "(debian|ubuntu|npmjs|fedoraproject|archlinux)\\.(org|com)|pypi\\.org|files\\.pythonhosted|\\.pkg\\.dev|"
      "arti"
      "factory");
  Findings found;
  for (const SourceFile& file : files) {
    if (file.path != "LICENSE") {
      findLines(file, file.text, folder, "names a folder of one machine", found);
      findLines(file, file.text, mirror, "names a package mirror", found);
    }
  }
  return found;
}

Findings checkTopLevel(std::span<const std::string> names) {
  static const std::set<std::string> house{
      "CMakeLists.txt", "CMakePresets.json", "CHANGELOG.md", "LICENSE", "README.md", "app",
      "core",           "packaging",         "resources",    "tests",   "widgets"};
  Findings found;
  for (const std::string& name : names) {
    const bool ignored = name == "out" || name.starts_with("build");
    if (!house.contains(name) && !name.starts_with('.') && !ignored) {
      found.push_back({name, 0, "has no place at the top of the house"});
    }
  }
  return found;
}

}  // namespace lorica::house
