#pragma once

/// \file
/// A value of the study file with its JSON pointer, read as the type the study expects there. Every reading either
/// gives a value within its limits or throws base::InputError with the pointer, what was expected and what was found.

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json_text.h"
#include "lorica/geometry/vectors.h"

namespace lorica::study {

/// Bounds of a number, with the words an error describes them by.
struct NumberRange {
  double low;
  double high;
  bool lowIncluded;
  const char* words;
};

/// A view: the tree and the file's name outlive it.
class Node {
 public:
  Node(const Json* value, const std::string& file, std::string pointer)
      : value_(value), file_(&file), pointer_(std::move(pointer)) {}

  bool present() const { return value_ != nullptr; }
  bool isList() const { return present() && value_->is_array(); }
  bool isNumber() const { return present() && value_->is_number(); }
  const std::string& pointer() const { return pointer_; }

  [[noreturn]] void fail(const std::string& text) const;
  /// "expected WHAT, found ..."
  [[noreturn]] void failExpected(const std::string& what) const;

  /// Makes sure that this is an object and has no other keys. \param what as in "expected an organ"
  void checkObject(const std::string& what, std::span<const std::string_view> keys) const;
  /// A member, present or not. \pre this is an object
  Node operator[](std::string_view key) const;
  std::vector<std::pair<std::string, Node>> members(const std::string& what) const;
  std::vector<Node> list(const std::string& what) const;

  std::string text(const std::string& what) const;
  /// Fails here when a name is empty or has control characters. \param what as in "expected a name"
  void checkName(const std::string& name, const std::string& what) const;
  /// A text that passes checkName.
  std::string name(const std::string& what) const;
  double number(const NumberRange& range) const;
  /// A whole number; 5.0 and 1e5 are whole too.
  std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
  bool boolean() const;
  /// Three numbers of size below 1e5. \param what their meaning and unit
  geometry::Vec3d vector(const std::string& what) const;

  template <class Value, std::size_t N>
  Value choice(const std::array<std::pair<std::string_view, Value>, N>& table) const {
    std::string words;
    for (std::size_t i = 0; i < N; ++i) {
      if (present() && value_->is_string() && value_->get_ref<const std::string&>() == table[i].first) {
        return table[i].second;
      }
      words += (i == 0 ? "" : i + 1 < N ? ", " : " or ") + inQuotes(table[i].first);
    }
    failExpected(words);
  }

 private:
  Node child(const Json& value, std::string_view step) const { return {&value, *file_, pointer_ + pointerStep(step)}; }
  std::string found() const;

  const Json* value_;
  const std::string* file_;
  std::string pointer_;
};

}  // namespace lorica::study
