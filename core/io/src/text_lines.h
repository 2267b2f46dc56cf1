#pragma once

/// \file
/// Text formats, line by line and word by word. Numbers do not depend on the locale.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reading.h"

namespace lorica::io {

/// The number that is the whole word; a leading '+' is allowed. Too small becomes 0; infinite and not-a-number are no
/// numbers.
std::optional<double> numberIn(std::string_view word);
std::optional<std::int64_t> integerIn(std::string_view word);

class TextLines {
 public:
  /// \param joins a backslash at the end of a line joins it with the next
  TextLines(std::string_view text, const Reading& reading, bool joins = false)
      : rest_(text), reading_(reading), joins_(joins) {}

  /// Goes to the next line (ended by LF, CR or CR LF); false at the end of the text.
  bool next();
  /// Goes to the next line that holds a word. \throw base::InputError at the end, saying that `what` is missing
  void nextWith(std::string_view what);
  /// The next word of the line; empty at its end. A word that begins with '#' ends the line.
  std::string_view word();
  /// What remains of the line.
  std::string_view remainder() const { return line_; }
  /// The next word as a number. \throw base::InputError naming the line and what was expected
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  [[noreturn]] void fail(const std::string& text) const;

  std::size_t lineNumber() const { return number_; }
  /// Bytes of the text behind the current line.
  std::size_t bytesLeft() const { return rest_.size(); }

 private:
  std::string_view takeLine();

  std::string_view rest_;
  std::string_view line_;
  std::string joined_;
  std::size_t number_ = 0;
  std::size_t taken_ = 0;
  const Reading& reading_;
  bool joins_;
};

}  // namespace lorica::io
