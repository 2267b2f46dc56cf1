#include "json_text.h"

#include <fmt/format.h>

#include <unordered_set>
#include <vector>

#include "lorica/base/error.h"

namespace lorica::study {

namespace {

/// "line 3, column 5" of the byte at `offset`; columns count characters, not bytes.
std::string placeOf(std::string_view text, std::size_t offset) {
  std::size_t line = 1;
  std::size_t column = 1;
  for (const char letter : text.substr(0, std::min(offset, text.size()))) {
    if (letter == '\n') {
      ++line;
      column = 1;
    } else if ((static_cast<unsigned char>(letter) & 0xC0U) != 0x80U) {
      ++column;
    }
  }
  return fmt::format("line {}, column {}", line, column);
}

/// What the parser says, without its own words for the place and the text it read last.
std::string syntaxReason(std::string reason) {
  if (reason.find("number overflow") != std::string::npos) {
    return "is not valid JSON: the number is too large";
  }
  const std::string known = "syntax error ";
  const std::size_t begin = reason.find(known);
  reason = begin == std::string::npos ? "syntax error" : reason.substr(begin + known.size());
  const std::size_t last = reason.find("; last read: '");
  if (last != std::string::npos) {
    const std::size_t expected = reason.rfind("'; expected ");
    reason = reason.substr(0, last) + (expected == std::string::npos ? "" : reason.substr(expected + 1));
  }
  return "is not valid JSON: " + reason;
}

/// Length of the longest prefix of at most `limit` bytes that does not cut a UTF-8 character.
std::size_t wholeCharacters(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) {
    return text.size();
  }
  while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xC0U) == 0x80U) {
    --limit;
  }
  return limit;
}

std::string oneLine(std::string_view text, std::size_t limit) {
  const std::size_t length = wholeCharacters(text, limit);
  std::string line;
  for (const char letter : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x20U || byte == 0x7FU) {
      line += fmt::format("\\u{:04x}", byte);
    } else {
      line += letter;
    }
  }
  return length < text.size() ? line + "..." : line;
}

/// Builds the tree from the parser's events.
class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Json take() { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    Level& level = levels_.back();
    level.key = std::move(value);
    if (!level.seen.insert(level.key).second) {
      throw base::InputError(file_, pointer(),
                             fmt::format("the key {} stands here twice; keep one", inQuotes(level.key)));
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& failure) override {
    // The position counts the bytes read, the offending one included.
    throw base::InputError(file_, placeOf(text_, position > 0 ? position - 1 : 0), syntaxReason(failure.what()));
  }

 private:
  struct Level {
    Json* container;
    std::string key;
    std::unordered_set<std::string> seen;
  };

  bool put(Json value) {
    place(std::move(value));
    return true;
  }

  bool open(Json container) {
    if (levels_.size() == deepestNesting) {
      throw base::InputError(file_, pointer(), fmt::format("is nested deeper than {} levels", deepestNesting));
    }
    Json* opened = place(std::move(container));
    levels_.push_back({opened, {}, {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  /// Only the innermost open container grows, so pointers to the open ones stay valid.
  Json* place(Json value) {
    if (levels_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Level& level = levels_.back();
    if (level.container->is_array()) {
      level.container->push_back(std::move(value));
      return &level.container->back();
    }
    // Appended unseen: key() has made sure that it is new, and the ordered object would search all its keys again.
    auto& members = level.container->get_ref<Json::object_t&>();
    static_cast<Json::object_t::Container&>(members).emplace_back(level.key, std::move(value));
    return &members.back().second;
  }

  /// Of the value that comes next.
  std::string pointer() const {
    std::string path;
    for (const Level& level : levels_) {
      // The open containers inside a list are its last entry already.
      const std::size_t index = level.container->size() - (&level == &levels_.back() ? 0 : 1);
      path += pointerStep(level.container->is_array() ? std::to_string(index) : level.key);
    }
    return path;
  }

  std::string_view text_;
  const std::string& file_;
  Json root_;
  std::vector<Level> levels_;
};

}  // namespace

Json parseJson(std::string_view text, const std::string& file) {
  TreeBuilder builder(text, file);
  Json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

std::string pointerStep(std::string_view key) {
  std::string step = "/";
  for (const char letter : key) {
    if (letter == '~') {
      step += "~0";
    } else if (letter == '/') {
      step += "~1";
    } else {
      step += letter;
    }
  }
  return oneLine(step, 80);
}

std::string inQuotes(std::string_view text) {
  return '"' + oneLine(text, 60) + '"';
}

}  // namespace lorica::study
