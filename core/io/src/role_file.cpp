#include "lorica/io/role_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "lorica/base/error.h"
#include "lorica/base/files.h"

namespace lorica::io {

namespace {

using Json = nlohmann::ordered_json;

std::string lineAndColumn(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t start = before.rfind('\n');
  return fmt::format("line {}, column {}", line, before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1);
}

Json parse(const std::string& file, const std::string& text) {
  std::set<std::string> roles;
  const auto refuseTwins = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1 && !roles.insert(parsed.get<std::string>()).second) {
      throw base::InputError(file, "/" + parsed.get<std::string>(), "this role is named twice");
    }
    return true;
  };
  try {
    return Json::parse(text, refuseTwins);
  } catch (const Json::parse_error& error) {
    throw base::InputError(file, lineAndColumn(text, error.byte),
                           "this is no JSON; expected an object of roles and joint names");
  }
}

std::vector<std::string> jointsOf(const std::string& file, const std::string& role, const Json& value) {
  std::vector<std::string> joints;
  const Json list = value.is_array() ? value : Json::array({value});
  for (const Json& joint : list) {
    if (!joint.is_string()) {
      throw base::InputError(file, "/" + role, "expected a joint's name or a list of names");
    }
    joints.push_back(joint.get<std::string>());
  }
  if (joints.empty()) {
    throw base::InputError(file, "/" + role, "expected at least one joint; leave the role out where there is none");
  }
  return joints;
}

}  // namespace

human::RoleMap readRoleFile(const std::filesystem::path& path, const human::Skeleton& skeleton) {
  const std::string file = path.string();
  const Json json = parse(file, base::readFile(path));
  if (!json.is_object()) {
    throw base::InputError(file, "/", "expected an object of roles and joint names");
  }
  std::vector<human::RoleEntry> entries;
  for (const auto& [role, value] : json.items()) {
    entries.push_back({role, jointsOf(file, role, value)});
  }
  try {
    return human::rolesFromNames(skeleton, entries);
  } catch (const base::InputError& error) {
    throw base::InputError(file, "/" + error.place(), error.text());
  }
}

}  // namespace lorica::io
