#include "schema_validator.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>

#include "lorica/base/files.h"

namespace lorica::test {

using study::Json;

namespace {

bool hasType(const std::string& type, const Json& value) {
  if (type == "integer") {
    return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
  }
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "number" && value.is_number()) ||
         (type == "boolean" && value.is_boolean());
}

bool allDifferent(const Json& list) {
  std::set<std::string> seen;
  return std::all_of(list.begin(), list.end(), [&](const Json& entry) { return seen.insert(entry.dump()).second; });
}

bool matches(const std::string& text, const std::string& pattern) {
  static std::map<std::string, std::regex> compiled;
  return std::regex_search(text, compiled.try_emplace(pattern, pattern).first->second);
}

bool hasKeys(const Json& keys, const Json& object) {
  return std::all_of(keys.begin(), keys.end(),
                     [&](const Json& key) { return object.contains(key.get<std::string>()); });
}

/// Wide enough for every whole number of JSON; comparing the JSON values takes large unsigned ones for negative.
long double number(const Json& value) {
  return value.is_number_unsigned() ? static_cast<long double>(value.get<std::uint64_t>())
                                    : static_cast<long double>(value.get<double>());
}

/// Keywords that bound a number; nothing for any other.
std::optional<bool> withinBound(const std::string& keyword, const Json& bound, const Json& value) {
  if (keyword == "minimum") {
    return !value.is_number() || number(value) >= number(bound);
  }
  if (keyword == "maximum") {
    return !value.is_number() || number(value) <= number(bound);
  }
  if (keyword == "exclusiveMinimum") {
    return !value.is_number() || number(value) > number(bound);
  }
  if (keyword == "exclusiveMaximum") {
    return !value.is_number() || number(value) < number(bound);
  }
  return std::nullopt;
}

/// Keywords about lists and texts as a whole; nothing for any other.
std::optional<bool> wholeObeys(const std::string& keyword, const Json& rule, const Json& value) {
  if (keyword == "minItems") {
    return !value.is_array() || value.size() >= rule.get<std::size_t>();
  }
  if (keyword == "maxItems") {
    return !value.is_array() || value.size() <= rule.get<std::size_t>();
  }
  if (keyword == "uniqueItems") {
    return !value.is_array() || allDifferent(value);
  }
  if (keyword == "pattern") {
    return !value.is_string() || matches(value.get<std::string>(), rule.get<std::string>());
  }
  if (keyword == "required") {
    return !value.is_object() || hasKeys(rule, value);
  }
  if (keyword == "dependentRequired") {
    return !value.is_object() || std::all_of(rule.items().begin(), rule.items().end(), [&](const auto& item) {
      return !value.contains(item.key()) || hasKeys(item.value(), value);
    });
  }
  return std::nullopt;
}

}  // namespace

std::size_t SchemaValidator::countAccepting(const Json& rules, const Json& value) const {
  return static_cast<std::size_t>(
      std::count_if(rules.begin(), rules.end(), [&](const Json& rule) { return accepts(rule, value); }));
}

/// properties, additionalProperties and propertyNames, which belong together.
bool SchemaValidator::membersObey(const Json& rule, const Json& value) const {
  if (!value.is_object()) {
    return true;
  }
  for (const auto& [key, member] : value.items()) {
    if (rule.contains("propertyNames") && !accepts(rule["propertyNames"], key)) {
      return false;
    }
    const bool listed = rule.contains("properties") && rule["properties"].contains(key);
    if (listed && !accepts(rule["properties"][key], member)) {
      return false;
    }
    if (!listed && rule.contains("additionalProperties") && !accepts(rule["additionalProperties"], member)) {
      return false;
    }
  }
  return true;
}

bool SchemaValidator::obeys(const std::string& keyword, const Json& rule, const Json& value) const {
  static const std::set<std::string> silent{"$schema", "title", "description", "default", "$defs", "then", "else"};
  static const std::set<std::string> members{"properties", "additionalProperties", "propertyNames"};
  const Json& wanted = rule[keyword];
  if (silent.contains(keyword)) {
    return true;
  }
  if (members.contains(keyword)) {
    return membersObey(rule, value);
  }
  if (keyword == "$ref") {
    return accepts(schema_.at(Json::json_pointer(wanted.get<std::string>().substr(1))), value);
  }
  if (keyword == "type") {
    return hasType(wanted.get<std::string>(), value);
  }
  if (keyword == "const") {
    return value == wanted;
  }
  if (keyword == "enum") {
    return std::find(wanted.begin(), wanted.end(), value) != wanted.end();
  }
  if (keyword == "items") {
    return !value.is_array() ||
           std::all_of(value.begin(), value.end(), [&](const Json& entry) { return accepts(wanted, entry); });
  }
  if (keyword == "not") {
    return !accepts(wanted, value);
  }
  if (keyword == "allOf") {
    return countAccepting(wanted, value) == wanted.size();
  }
  if (keyword == "oneOf") {
    return countAccepting(wanted, value) == 1;
  }
  if (keyword == "if") {
    const char* branch = accepts(wanted, value) ? "then" : "else";
    return !rule.contains(branch) || accepts(rule[branch], value);
  }
  if (const std::optional<bool> bounded = withinBound(keyword, wanted, value)) {
    return *bounded;
  }
  if (const std::optional<bool> whole = wholeObeys(keyword, wanted, value)) {
    return *whole;
  }
  throw std::logic_error("unknown keyword of the schema: " + keyword);
}

bool SchemaValidator::accepts(const Json& rule, const Json& value) const {
  if (rule.is_boolean()) {
    return rule.get<bool>();
  }
  return std::all_of(rule.items().begin(), rule.items().end(),
                     [&](const auto& item) { return obeys(item.key(), rule, value); });
}

const SchemaValidator& studySchema() {
  static const SchemaValidator validator(
      Json::parse(base::readFile(std::filesystem::path(LORICA_SOURCE_DIR) / "resources/schema/study.schema.json")));
  return validator;
}

}  // namespace lorica::test
