#include <fmt/format.h>

#include <algorithm>

#include "formats.h"
#include "polygons.h"
#include "text_lines.h"

namespace lorica::io {

namespace {

struct OffKind {
  bool known = false;
  std::string_view unreadable;  // what this variant has that a surface in space has not
};

/// Header words are made of ST, C, N, 4, n and OFF; colours, normals and texture coordinates follow the position on
/// its line and are not used.
OffKind kindOf(std::string_view word) {
  OffKind kind;
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) {
      word.remove_prefix(prefix.size());
    }
  }
  for (const std::string_view prefix : {"4", "n"}) {
    if (word.starts_with(prefix)) {
      kind.unreadable = "four or more dimensions";
      word.remove_prefix(1);
    }
  }
  kind.known = word == "OFF";
  return kind;
}

std::string_view firstWord(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) {
    return {};
  }
  const std::string_view rest = bytes.substr(begin, 16);
  return rest.substr(0, rest.find_first_of(" \t\r\n#"));
}

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

Counts readCounts(TextLines& lines) {
  std::string_view word = lines.word();
  if (word == "BINARY") {
    lines.fail("binary OFF files cannot be read; save it as text");
  }
  if (word.empty()) {
    lines.nextWith("the counts of vertices and faces");
    word = lines.word();
  }
  const auto vertices = integerIn(word);
  const std::int64_t faces = lines.integer("the number of faces");
  if (!vertices || *vertices < 0 || faces < 0 || *vertices > UINT32_MAX) {
    lines.fail("the counts of vertices and faces were expected");
  }
  return {static_cast<std::size_t>(*vertices), static_cast<std::size_t>(faces)};
}

void readFace(TextLines& lines, std::size_t vertices, std::vector<std::uint32_t>& corners) {
  const std::int64_t count = lines.integer("the number of corners of a face");
  if (count < 0) {
    lines.fail("the number of corners of a face is negative");
  }
  corners.clear();
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t index = lines.integer("a corner of a face");
    if (index < 0 || index >= static_cast<std::int64_t>(vertices)) {
      lines.fail(fmt::format("the face uses vertex {}, but the vertices are 0 to {}", index,
                             static_cast<std::int64_t>(vertices) - 1));
    }
    corners.push_back(static_cast<std::uint32_t>(index));
  }
}

}  // namespace

bool isOff(std::string_view bytes) {
  return kindOf(firstWord(bytes)).known;
}

RawModel readOff(std::string_view bytes, Reading& reading) {
  TextLines lines(bytes, reading);
  lines.nextWith("the word OFF");
  const OffKind kind = kindOf(lines.word());
  if (!kind.known) {
    lines.fail("the word OFF was expected");
  }
  if (!kind.unreadable.empty()) {
    lines.fail(fmt::format("OFF files with {} cannot be read", kind.unreadable));
  }
  const Counts counts = readCounts(lines);
  RawModel model;
  RawPart& part = model.parts.emplace_back();
  part.positions.reserve(std::min(counts.vertices, lines.bytesLeft() / 6));  // "0 0 0\n"
  const std::string vertexLine = fmt::format("one of {} vertices", counts.vertices);
  for (std::size_t v = 0; v < counts.vertices; ++v) {
    lines.nextWith(vertexLine);
    const double x = lines.number("the x of a vertex");
    const double y = lines.number("the y of a vertex");
    part.positions.emplace_back(x, y, lines.number("the z of a vertex"));
  }
  std::vector<std::uint32_t> corners;
  std::size_t thin = 0;
  const std::string faceLine = fmt::format("one of {} faces", counts.faces);
  for (std::size_t f = 0; f < counts.faces; ++f) {
    lines.nextWith(faceLine);
    readFace(lines, counts.vertices, corners);
    thin += corners.size() < 3 ? 1 : 0;
    appendFan(part.triangles, corners);
  }
  if (thin > 0) {
    reading.note("", fmt::format("{} faces with fewer than three corners are not used", thin));
  }
  return model;
}

}  // namespace lorica::io
