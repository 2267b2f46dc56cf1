#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace lorica::io {

/// Hands out names that differ from each other.
class UniqueNames {
 public:
  /// `wanted` made one line; `fallback` when nothing remains; with _2, _3, ... behind it when it was given before.
  std::string take(std::string_view wanted, const std::string& fallback);

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> copies_;  // so that a thousand equal names do not cost a million look-ups
};

}  // namespace lorica::io
