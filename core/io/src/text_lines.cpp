#include "text_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace lorica::io {

namespace {

constexpr std::string_view blanks = " \t\v\f";

template <class T>
std::from_chars_result parse(std::string_view word, T& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  const std::from_chars_result result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ptr == word.data() + word.size() ? result
                                                 : std::from_chars_result{result.ptr, std::errc::invalid_argument};
}

}  // namespace

std::optional<double> numberIn(std::string_view word) {
  double value = 0.0;
  const std::from_chars_result result = parse(word, value);
  if (result.ec == std::errc::result_out_of_range && word.find("e-") != std::string_view::npos) {
    return 0.0;
  }
  if (result.ec != std::errc() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::int64_t> integerIn(std::string_view word) {
  std::int64_t value = 0;
  if (parse(word, value).ec != std::errc()) {
    return std::nullopt;
  }
  return value;
}

std::string_view TextLines::takeLine() {
  const std::size_t end = rest_.find_first_of("\r\n");
  const std::string_view line = rest_.substr(0, end);
  if (end == std::string_view::npos) {
    rest_ = {};
  } else {
    const bool pair = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
    rest_.remove_prefix(end + (pair ? 2 : 1));
  }
  ++taken_;
  return line;
}

bool TextLines::next() {
  if (rest_.empty()) {
    line_ = {};
    return false;
  }
  number_ = taken_ + 1;
  line_ = takeLine();
  if (joins_ && line_.ends_with('\\')) {
    joined_.assign(line_);
    while (joined_.ends_with('\\')) {
      joined_.back() = ' ';
      if (!rest_.empty()) {
        joined_ += takeLine();
      }
    }
    line_ = joined_;
  }
  return true;
}

void TextLines::nextWith(std::string_view what) {
  while (next()) {
    const std::size_t begin = line_.find_first_not_of(blanks);
    if (begin != std::string_view::npos && line_[begin] != '#') {
      return;
    }
  }
  reading_.fail(fmt::format("line {}", taken_ + 1), fmt::format("the file ends where {} was expected", what));
}

std::string_view TextLines::word() {
  const std::size_t begin = line_.find_first_not_of(blanks);
  if (begin == std::string_view::npos || line_[begin] == '#') {
    line_ = {};
    return {};
  }
  line_.remove_prefix(begin);
  const std::string_view found = line_.substr(0, line_.find_first_of(blanks));
  line_.remove_prefix(found.size());
  return found;
}

double TextLines::number(std::string_view what) {
  const std::string_view text = word();
  const std::optional<double> value = numberIn(text);
  if (!value) {
    fail(fmt::format("{} was expected, not '{}'", what, oneLine(text, 40)));
  }
  return *value;
}

std::int64_t TextLines::integer(std::string_view what) {
  const std::string_view text = word();
  const std::optional<std::int64_t> value = integerIn(text);
  if (!value) {
    fail(fmt::format("{} was expected, not '{}'", what, oneLine(text, 40)));
  }
  return *value;
}

void TextLines::fail(const std::string& text) const {
  reading_.fail(fmt::format("line {}", number_), text);
}

}  // namespace lorica::io
