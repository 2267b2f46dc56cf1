#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "formats.h"
#include "text_lines.h"

namespace lorica::io {

using geometry::Vec3d;

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read as it stands in memory");

constexpr std::size_t headBytes = 84;
constexpr std::size_t facetBytes = 50;

std::uint32_t statedTriangles(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + headBytes - sizeof count, sizeof count);
  return count;
}

void appendTriangle(RawPart& part) {
  const auto end = static_cast<std::uint32_t>(part.positions.size());
  part.triangles.push_back({end - 3, end - 2, end - 1});
}

RawModel readBinary(std::string_view bytes, const Reading& reading) {
  const std::size_t count = statedTriangles(bytes);
  RawModel model;
  RawPart& part = model.parts.emplace_back();
  part.positions.reserve(3 * count);
  part.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 12> numbers{};  // normal, then three corners
    std::memcpy(numbers.data(), bytes.data() + headBytes + t * facetBytes, sizeof numbers);
    for (std::size_t k = 3; k < numbers.size(); k += 3) {
      part.positions.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
      if (!part.positions.back().allFinite()) {
        reading.fail(fmt::format("triangle {}", t), "a coordinate is not a finite number");
      }
    }
    appendTriangle(part);
  }
  return model;
}

/// Words across line ends, in the one order the format allows.
class AsciiReader {
 public:
  AsciiReader(std::string_view bytes, const Reading& reading) : lines_(bytes, reading) {}

  RawModel read() {
    RawModel model;
    while (lines_.next()) {
      const std::string_view first = lines_.word();
      if (first.empty()) {
        continue;
      }
      if (!is(first, "solid")) {
        lines_.fail(fmt::format("'solid' was expected, not '{}'", oneLine(first, 40)));
      }
      solid(model.parts.emplace_back());
    }
    return model;
  }

 private:
  void solid(RawPart& part) {
    part.name = oneLine(lines_.remainder());
    while (true) {
      lines_.nextWith("'facet' or 'endsolid'");
      const std::string_view word = lines_.word();
      if (is(word, "endsolid")) {
        return;
      }
      if (!is(word, "facet")) {
        lines_.fail(fmt::format("'facet' or 'endsolid' was expected, not '{}'", oneLine(word, 40)));
      }
      facet(part);
    }
  }

  void facet(RawPart& part) {
    line("outer", "loop");
    for (int corner = 0; corner < 3; ++corner) {
      line("vertex");
      const double x = lines_.number("the x of a vertex");
      const double y = lines_.number("the y of a vertex");
      part.positions.emplace_back(x, y, lines_.number("the z of a vertex"));
    }
    appendTriangle(part);
    line("endloop");
    line("endfacet");
  }

  void line(std::string_view first, std::string_view second = {}) {
    lines_.nextWith(fmt::format("'{}'", first));
    for (const std::string_view expected : {first, second}) {
      if (expected.empty()) {
        continue;
      }
      if (const std::string_view word = lines_.word(); !is(word, expected)) {
        lines_.fail(fmt::format("'{}' was expected, not '{}'", expected, oneLine(word, 40)));
      }
    }
  }

  /// Some programs write the words in capitals.
  static bool is(std::string_view word, std::string_view expected) {
    return std::equal(word.begin(), word.end(), expected.begin(), expected.end(), [](char a, char b) {
      return a == b || (a >= 'A' && a <= 'Z' && static_cast<char>(a - 'A' + 'a') == b);
    });
  }

  TextLines lines_;
};

bool looksLikeText(std::string_view bytes) {
  const std::string_view begin = bytes.substr(0, 512);
  const std::size_t word = begin.find_first_not_of(" \t\r\n");
  return word != std::string_view::npos && begin.find('\0') == std::string_view::npos &&
         (begin.substr(word).starts_with("solid") || begin.substr(word).starts_with("SOLID"));
}

}  // namespace

bool isBinaryStl(std::string_view bytes) {
  return bytes.size() >= headBytes && bytes.size() == headBytes + facetBytes * std::uint64_t{statedTriangles(bytes)};
}

RawModel readStl(std::string_view bytes, Reading& reading) {
  if (isBinaryStl(bytes)) {
    return readBinary(bytes, reading);
  }
  if (looksLikeText(bytes)) {
    return AsciiReader(bytes, reading).read();
  }
  if (bytes.size() < headBytes) {
    reading.fail("", fmt::format("is too short for an STL file: {} bytes", bytes.size()));
  }
  const std::uint64_t count = statedTriangles(bytes);
  reading.fail("", fmt::format("states {} triangles, which take {} bytes, but has {} bytes; the file is cut or damaged",
                               count, headBytes + facetBytes * count, bytes.size()));
}

}  // namespace lorica::io
