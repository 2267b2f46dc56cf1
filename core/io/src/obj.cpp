#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "formats.h"
#include "polygons.h"
#include "text_lines.h"

namespace lorica::io {

using geometry::Triangle;
using geometry::Vec3d;

namespace {

/// Statements of the format that say nothing about a surface of polygons.
constexpr std::array<std::string_view, 11> ignored{"vt",     "vn",     "vp",     "s",     "mg", "usemtl",
                                                   "mtllib", "usemap", "maplib", "bevel", "lod"};
/// Points, lines and free-form geometry: not read, and the user is told.
constexpr std::array<std::string_view, 28> unread{
    "p",     "l",     "cstype", "deg", "bmat", "step", "curv",       "curv2",     "surf",     "parm",
    "trim",  "hole",  "scrv",   "sp",  "end",  "con",  "shadow_obj", "trace_obj", "c_interp", "d_interp",
    "ctech", "stech", "call",   "csh", "res",  "cdc",  "cdp",        "bzp"};

template <std::size_t n>
bool contains(const std::array<std::string_view, n>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, Reading& reading) : lines_(bytes, reading, true), reading_(reading) {}

  RawModel read() {
    while (lines_.next()) {
      statement(lines_.word());
    }
    if (unreadStatements_ > 0) {
      reading_.note(
          "", fmt::format("{} statements about points, lines or free-form surfaces are not used", unreadStatements_));
    }
    RawModel model;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (!groups_[g].triangles.empty()) {
        model.parts.push_back(part(groups_[g]));
      }
    }
    return model;
  }

 private:
  struct Group {
    std::string name;
    std::vector<Triangle> triangles;  // into the vertices of the whole file
  };

  void statement(std::string_view keyword) {
    if (keyword == "v") {
      const double x = lines_.number("the x of a vertex");
      const double y = lines_.number("the y of a vertex");
      vertices_.emplace_back(x, y, lines_.number("the z of a vertex"));
    } else if (keyword == "f" || keyword == "fo") {
      face();
    } else if (keyword == "o" || keyword == "g") {
      startGroup(oneLine(lines_.remainder()));
    } else if (contains(unread, keyword)) {
      ++unreadStatements_;
    } else if (!keyword.empty() && !contains(ignored, keyword)) {
      lines_.fail(fmt::format("'{}' is no OBJ statement; v, f, o, g and the like were expected", oneLine(keyword, 40)));
    }
  }

  void startGroup(const std::string& name) {
    const auto [place, isNew] = groupNamed_.try_emplace(name, groups_.size());
    if (isNew) {
      groups_.push_back({name, {}});
    }
    current_ = place->second;
  }

  void face() {
    corners_.clear();
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
      corners_.push_back(corner(word));
    }
    if (corners_.size() < 3) {
      lines_.fail(fmt::format("a face needs three corners, this one has {}", corners_.size()));
    }
    if (groups_.empty()) {
      startGroup("");
    }
    appendFan(groups_[current_].triangles, corners_);
  }

  /// v, v/vt, v//vn or v/vt/vn, counted from 1, or from the last vertex back when negative.
  std::uint32_t corner(std::string_view word) const {
    const std::size_t slash = word.find('/');
    const auto index = integerIn(word.substr(0, slash));
    if (!index || *index == 0 || (slash != std::string_view::npos && !areIndices(word.substr(slash + 1)))) {
      lines_.fail(fmt::format("a corner like 1, 1/1, 1//1 or 1/1/1 was expected, not '{}'", oneLine(word, 40)));
    }
    const auto count = static_cast<std::int64_t>(vertices_.size());
    if (*index > count || *index < -count) {
      lines_.fail(fmt::format("the face uses vertex {}, but only {} vertices stand above it", *index, count));
    }
    return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : count + *index);
  }

  static bool areIndices(std::string_view text) {
    const std::size_t slash = text.find('/');
    const std::string_view texture = text.substr(0, slash);
    const bool textureGood = texture.empty() || integerIn(texture).has_value();
    return textureGood && (slash == std::string_view::npos || text.size() == slash + 1 ||
                           integerIn(text.substr(slash + 1)).has_value());
  }

  /// The group with its own vertices, in the order of the file.
  RawPart part(const Group& group) {
    std::vector<std::uint32_t> used;
    used.reserve(group.triangles.size() * 3);
    for (const Triangle& triangle : group.triangles) {
      used.insert(used.end(), triangle.begin(), triangle.end());
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    newIndex_.resize(vertices_.size());
    RawPart result;
    result.name = group.name;
    for (const std::uint32_t vertex : used) {
      newIndex_[vertex] = static_cast<std::uint32_t>(result.positions.size());
      result.positions.push_back(vertices_[vertex]);
    }
    for (const Triangle& t : group.triangles) {
      result.triangles.push_back({newIndex_[t[0]], newIndex_[t[1]], newIndex_[t[2]]});
    }
    return result;
  }

  TextLines lines_;
  Reading& reading_;
  std::vector<Vec3d> vertices_;
  std::vector<Group> groups_;
  std::map<std::string, std::size_t, std::less<>> groupNamed_;
  std::size_t current_ = 0;
  std::size_t unreadStatements_ = 0;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> newIndex_;
};

}  // namespace

RawModel readObj(std::string_view bytes, Reading& reading) {
  if (bytes.starts_with("\xEF\xBB\xBF")) {
    bytes.remove_prefix(3);
  }
  return ObjReader(bytes, reading).read();
}

}  // namespace lorica::io
