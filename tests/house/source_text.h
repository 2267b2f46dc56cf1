#pragma once

/// \file
/// The project's own files as text, for the tests that read them instead of running them.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lorica::house {

/// A text file of the project.
struct SourceFile {
  std::string path;  ///< relative to the project, '/' between folders
  std::string text;
};

/// Something a rule objects to.
struct Finding {
  std::string path;
  std::size_t line = 0;  ///< from 1; 0 when the whole file or the whole project is meant
  std::string text;      ///< one sentence

  /// "path:line: text".
  std::string where() const;
};

using Findings = std::vector<Finding>;

/// One line of a file per finding, for a test's message.
std::string lines(const Findings& findings);

/// Every text file below the project's folders and at its top, in the order of the paths; build folders, out/ and
/// whatever git keeps for itself are left out, and so are binary files.
std::vector<SourceFile> projectFiles(const std::filesystem::path& project);

/// Names of the files and folders at the project's top.
std::vector<std::string> topLevelEntries(const std::filesystem::path& project);

/// C++ with comments and the content of string and character literals blanked; every line keeps its number.
std::string codeOnly(std::string_view cpp);

/// The lines of a text, without their ends.
std::vector<std::string_view> splitLines(std::string_view text);

/// What an #include of C++ names.
struct Include {
  std::size_t line = 0;  ///< from 1
  std::string header;    ///< without brackets or quotes
  bool angled = false;
};

std::vector<Include> includes(std::string_view cpp);

}  // namespace lorica::house
