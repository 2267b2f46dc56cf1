#include "json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lorica/base/error.h"

namespace lorica::study {

namespace {

/// Number of letters to insert, remove or replace that turn one word into the other (Levenshtein).
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
}

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) {
    text += (text.empty() ? "" : ", ") + inQuotes(word);
  }
  return text;
}

/// A sentence that leads from an unknown key to the known ones: the nearest, or all when none is near.
std::string knownKeysNear(std::string_view key, std::span<const std::string_view> keys) {
  constexpr std::size_t longest = 40;
  std::size_t nearest = longest;
  std::vector<std::string_view> near;
  for (const std::string_view known : keys) {
    const std::size_t distance = key.size() > longest ? longest : editDistance(key, known);
    if (distance < nearest) {
      near.clear();
      nearest = distance;
    }
    if (distance == nearest) {
      near.push_back(known);
    }
  }
  if (nearest <= 1 + key.size() / 3) {
    return "did you mean " + joined(near) + "?";
  }
  return "known here are " + joined(keys);
}

bool isControl(char letter) {
  return static_cast<unsigned char>(letter) < 0x20U || letter == '\x7F';
}

}  // namespace

void Node::fail(const std::string& text) const {
  throw base::InputError(*file_, pointer_, text);
}

void Node::failExpected(const std::string& what) const {
  fail(fmt::format("expected {}, found {}", what, found()));
}

std::string Node::found() const {
  if (!present()) {
    return "nothing";
  }
  switch (value_->type()) {
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return fmt::format("a list of {}", value_->size());
    case Json::value_t::string:
      return inQuotes(value_->get_ref<const std::string&>());
    default:
      return value_->dump();
  }
}

void Node::checkObject(const std::string& what, std::span<const std::string_view> keys) const {
  if (!present() || !value_->is_object()) {
    failExpected(what + " (an object)");
  }
  for (const auto& [key, value] : value_->get_ref<const Json::object_t&>()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      child(value, key).fail(fmt::format("unknown key {}; {}", inQuotes(key), knownKeysNear(key, keys)));
    }
  }
}

Node Node::operator[](std::string_view key) const {
  for (const auto& [known, value] : value_->get_ref<const Json::object_t&>()) {
    if (known == key) {
      return child(value, key);
    }
  }
  return {nullptr, *file_, pointer_ + pointerStep(key)};
}

std::vector<std::pair<std::string, Node>> Node::members(const std::string& what) const {
  if (!present() || !value_->is_object()) {
    failExpected(what);
  }
  std::vector<std::pair<std::string, Node>> nodes;
  for (const auto& [key, value] : value_->get_ref<const Json::object_t&>()) {
    nodes.emplace_back(key, child(value, key));
  }
  return nodes;
}

std::vector<Node> Node::list(const std::string& what) const {
  if (!isList()) {
    failExpected(what);
  }
  std::vector<Node> nodes;
  for (const Json& value : *value_) {
    nodes.push_back(child(value, std::to_string(nodes.size())));
  }
  return nodes;
}

std::string Node::text(const std::string& what) const {
  if (!present() || !value_->is_string()) {
    failExpected(what);
  }
  return value_->get<std::string>();
}

void Node::checkName(const std::string& name, const std::string& what) const {
  if (name.empty() || std::any_of(name.begin(), name.end(), isControl)) {
    fail(fmt::format("expected {}, not empty and without control characters, found {}", what, inQuotes(name)));
  }
}

std::string Node::name(const std::string& what) const {
  std::string read = text(what);
  checkName(read, what);
  return read;
}

double Node::number(const NumberRange& range) const {
  if (!isNumber()) {
    failExpected(range.words);
  }
  const double read = value_->get<double>();
  const bool inside = (range.lowIncluded ? read >= range.low : read > range.low) && read <= range.high;
  if (!inside) {
    failExpected(range.words);
  }
  return read;
}

std::uint64_t Node::whole(std::uint64_t low, std::uint64_t high) const {
  const std::string what = fmt::format("a whole number from {} to {}", low, high);
  if (!isNumber()) {
    failExpected(what);
  }
  if (!value_->is_number_unsigned()) {
    // Above 2^53 a fraction could have been rounded away unseen.
    const double read = value_->get<double>();
    if (!(read >= 0.0 && read <= 0x1p53 && std::floor(read) == read)) {
      failExpected(what);
    }
  }
  const auto read = value_->get<std::uint64_t>();
  if (read < low || read > high) {
    failExpected(what);
  }
  return read;
}

bool Node::boolean() const {
  if (!present() || !value_->is_boolean()) {
    failExpected("true or false");
  }
  return value_->get<bool>();
}

geometry::Vec3d Node::vector(const std::string& what) const {
  if (!isList() || value_->size() != 3) {
    failExpected("three numbers, " + what);
  }
  geometry::Vec3d read;
  Eigen::Index axis = 0;
  for (const Node& component : list(what)) {
    if (!component.isNumber() || !(std::abs(component.value_->get<double>()) < 1e5)) {
      component.failExpected("a number between -100000 and 100000, " + what);
    }
    read[axis++] = component.value_->get<double>();
  }
  return read;
}

}  // namespace lorica::study
