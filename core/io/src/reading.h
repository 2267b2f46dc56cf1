#pragma once

/// \file
/// The file being read: how errors name it, and what was found in it that can be lived with.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "lorica/base/error.h"
#include "lorica/base/issue.h"

namespace lorica::io {

/// Text from a file or a library, fit for a message or a name: control characters become blanks, blanks at the ends
/// go, and no more than `limit` bytes remain.
std::string oneLine(std::string_view text, std::size_t limit = 200);

class Reading {
 public:
  explicit Reading(const std::filesystem::path& path) : path_(path), file_(oneLine(path.string(), 4096)) {}

  const std::filesystem::path& path() const { return path_; }

  /// \throw base::InputError always
  [[noreturn]] void fail(const std::string& place, const std::string& text) const {
    throw base::InputError(file_, place, text);
  }
  void note(const std::string& place, const std::string& text) {
    issues_.push_back({base::Severity::note, file_, place, text});
  }
  void warn(const std::string& place, const std::string& text) {
    issues_.push_back({base::Severity::warning, file_, place, text});
  }
  base::Issues takeIssues() { return std::move(issues_); }

  /// The same file without issues, for work on another thread; join() brings its issues back.
  Reading branch() const { return Reading(path_); }
  void join(Reading&& branch) { base::append(issues_, std::move(branch.issues_)); }

 private:
  std::filesystem::path path_;
  std::string file_;
  base::Issues issues_;
};

}  // namespace lorica::io
