#pragma once

/// \file
/// Survivable trouble: what was found, where, and how bad it is. Functions return issues beside their result.

#include <string>
#include <vector>

namespace lorica::base {

enum class Severity { note, warning, error };

/// "note", "warning" or "error".
const char* name(Severity severity);

struct Issue {
  Severity severity = Severity::warning;
  std::string file;   ///< path as the user gave it; may be empty
  std::string place;  ///< line, JSON pointer, node, structure or point; may be empty
  std::string text;   ///< one sentence

  /// "file:place: severity: text", empty pieces left out.
  std::string line() const;
};

using Issues = std::vector<Issue>;

/// Appends `more` to `issues`.
void append(Issues& issues, Issues more);

}  // namespace lorica::base
