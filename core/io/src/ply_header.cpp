#include "ply_header.h"

#include <fmt/format.h>

#include <array>

#include "text_lines.h"

namespace lorica::io {

namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> typeNames{{{"char", PlyType::int8},
                                              {"int8", PlyType::int8},
                                              {"uchar", PlyType::uint8},
                                              {"uint8", PlyType::uint8},
                                              {"short", PlyType::int16},
                                              {"int16", PlyType::int16},
                                              {"ushort", PlyType::uint16},
                                              {"uint16", PlyType::uint16},
                                              {"int", PlyType::int32},
                                              {"int32", PlyType::int32},
                                              {"uint", PlyType::uint32},
                                              {"uint32", PlyType::uint32},
                                              {"float", PlyType::float32},
                                              {"float32", PlyType::float32},
                                              {"double", PlyType::float64},
                                              {"float64", PlyType::float64}}};

PlyType typeNamed(std::string_view word, const TextLines& lines) {
  for (const TypeName& known : typeNames) {
    if (known.name == word) {
      return known.type;
    }
  }
  lines.fail(fmt::format("a type like float or uchar was expected, not '{}'", oneLine(word, 40)));
}

PlyEncoding readEncoding(TextLines& lines) {
  const std::string_view word = lines.word();
  if (word == "ascii") {
    return PlyEncoding::ascii;
  }
  if (word == "binary_little_endian") {
    return PlyEncoding::littleEndian;
  }
  if (word == "binary_big_endian") {
    return PlyEncoding::bigEndian;
  }
  lines.fail(fmt::format("ascii, binary_little_endian or binary_big_endian was expected, not '{}'", oneLine(word, 40)));
}

PlyElement readElement(TextLines& lines) {
  PlyElement element;
  element.name = oneLine(lines.word(), 40);
  const std::int64_t count = lines.integer("the number of elements");
  if (count < 0 || count > UINT32_MAX) {
    lines.fail(fmt::format("{} is no possible number of elements", count));
  }
  element.count = static_cast<std::size_t>(count);
  return element;
}

PlyProperty readProperty(TextLines& lines) {
  PlyProperty property;
  std::string_view word = lines.word();
  if (word == "list") {
    property.listCount = typeNamed(lines.word(), lines);
    if (*property.listCount == PlyType::float32 || *property.listCount == PlyType::float64) {
      lines.fail("the length of a list cannot be a fraction");
    }
    word = lines.word();
  }
  property.type = typeNamed(word, lines);
  property.name = oneLine(lines.word(), 40);
  return property;
}

void check(const PlyHeader& header, const TextLines& lines) {
  for (const PlyElement& element : header.elements) {
    if (element.count > 0 && element.properties.empty()) {
      lines.fail(fmt::format("element {} has no properties", element.name));
    }
  }
}

}  // namespace

PlyHeader readPlyHeader(std::string_view bytes, const Reading& reading) {
  TextLines lines(bytes, reading);
  if (!lines.next() || lines.word() != "ply") {
    lines.fail("the word ply was expected");
  }
  PlyHeader header;
  bool hasFormat = false;
  while (true) {
    lines.nextWith("end_header");
    const std::string_view word = lines.word();
    if (word == "format") {
      header.encoding = readEncoding(lines);
      hasFormat = true;
    } else if (word == "element") {
      header.elements.push_back(readElement(lines));
    } else if (word == "property") {
      if (header.elements.empty()) {
        lines.fail("a property stands before the first element");
      }
      header.elements.back().properties.push_back(readProperty(lines));
    } else if (word == "end_header") {
      break;
    } else if (word != "comment" && word != "obj_info") {
      lines.fail(fmt::format("'{}' is no line of a PLY header", oneLine(word, 40)));
    }
  }
  if (!hasFormat) {
    lines.fail("the format line is missing");
  }
  check(header, lines);
  header.bytes = bytes.size() - lines.bytesLeft();
  header.lines = lines.lineNumber();
  return header;
}

}  // namespace lorica::io
