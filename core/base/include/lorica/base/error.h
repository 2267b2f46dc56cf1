#pragma once

/// \file
/// The kinds of failure Lorica knows, and nothing else of a program's life: a caller's mistake (CallerError, always
/// checked), bad input (InputError, with file and place), a wish to stop (Cancelled). Survivable trouble is an Issue.

#include <stdexcept>
#include <string>

namespace lorica::base {

/// Root of everything Lorica throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or a value given by the user cannot be used. `what()` is one line, "file: place: text"; the text says what
/// was expected and what to do.
class InputError : public Error {
 public:
  /// \param file the file's path as the user gave it; empty when the input is not a file
  /// \param place line and column, JSON pointer, node or accessor name; empty when the whole file is meant
  /// \param text one sentence without a line break
  InputError(const std::string& file, const std::string& place, const std::string& text);

  const std::string& file() const noexcept { return file_; }
  const std::string& place() const noexcept { return place_; }
  const std::string& text() const noexcept { return text_; }

 private:
  std::string file_;
  std::string place_;
  std::string text_;
};

/// Thrown out of long work when its Task was cancelled.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

/// A function was called against its contract. A defect of the calling code, never of the input.
class CallerError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void throwCallerError(const char* condition, const char* function, const char* text);

}  // namespace lorica::base

/// Always-on check of a precondition.
#define LORICA_CHECK(condition, text)                               \
  do {                                                              \
    if (!(condition)) {                                             \
      ::lorica::base::throwCallerError(#condition, __func__, text); \
    }                                                               \
  } while (false)
