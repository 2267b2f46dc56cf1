#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "formats.h"
#include "ply_header.h"
#include "polygons.h"
#include "text_lines.h"

namespace lorica::io {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is swapped for little-endian machines");

/// Values of the data section written as words.
class AsciiValues {
 public:
  AsciiValues(std::string_view bytes, const PlyHeader& header, const Reading& reading)
      : lines_(bytes.substr(header.bytes), reading), reading_(reading), headerLines_(header.lines) {}

  double next(PlyType) {
    std::string_view word = lines_.word();
    while (word.empty()) {
      if (!lines_.next()) {
        fail("the file ends before its last element");
      }
      word = lines_.word();
    }
    if (const auto value = numberIn(word)) {
      return *value;
    }
    if (word == "nan" || word == "-nan" || word == "inf" || word == "-inf") {
      return std::numeric_limits<double>::quiet_NaN();  // allowed in properties that are not used
    }
    fail(fmt::format("a number was expected, not '{}'", oneLine(word, 40)));
  }
  void start(const PlyElement&, std::size_t) {}
  [[noreturn]] void fail(const std::string& text) const {
    reading_.fail(fmt::format("line {}", headerLines_ + lines_.lineNumber()), text);
  }

 private:
  TextLines lines_;
  const Reading& reading_;
  std::size_t headerLines_;
};

class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, const PlyHeader& header, const Reading& reading)
      : rest_(bytes.substr(header.bytes)), reading_(reading), swap_(header.encoding == PlyEncoding::bigEndian) {}

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
    }
    return 0.0;
  }
  void start(const PlyElement& element, std::size_t index) {
    element_ = &element;
    index_ = index;
  }
  [[noreturn]] void fail(const std::string& text) const {
    reading_.fail(fmt::format("{} {}", element_->name, index_), text);
  }

 private:
  template <class T>
  T take() {
    if (rest_.size() < sizeof(T)) {
      fail("the file ends before its last element");
    }
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    if (swap_) {
      std::reverse(raw.begin(), raw.end());
    }
    return std::bit_cast<T>(raw);
  }

  std::string_view rest_;
  const Reading& reading_;
  const PlyElement* element_ = nullptr;
  std::size_t index_ = 0;
  bool swap_;
};

template <class Values>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Values values, std::size_t dataBytes, Reading& reading)
      : header_(header), values_(std::move(values)), dataBytes_(dataBytes), reading_(reading) {}

  RawModel read() {
    for (const PlyElement& element : header_.elements) {
      for (std::size_t i = 0; i < element.count; ++i) {
        values_.start(element, i);
        if (element.name == "vertex") {
          vertex(element, i);
        } else {
          other(element);
        }
      }
    }
    checkIndices();
    if (thin_ > 0) {
      reading_.note("", fmt::format("{} faces with fewer than three corners are not used", thin_));
    }
    RawModel model;
    model.parts.push_back(std::move(part_));
    return model;
  }

 private:
  void vertex(const PlyElement& element, std::size_t index) {
    if (index == 0) {
      part_.positions.reserve(std::min(element.count, dataBytes_ / 3));
    }
    geometry::Vec3d position = geometry::Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());
    for (const PlyProperty& property : element.properties) {
      if (property.listCount) {
        readList(property);
        continue;
      }
      const double value = values_.next(property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
        position[property.name[0] - 'x'] = value;
      }
    }
    if (!position.allFinite()) {
      values_.fail("a vertex needs finite x, y and z");
    }
    part_.positions.push_back(position);
  }

  void other(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!property.listCount) {
        values_.next(property.type);
        continue;
      }
      readList(property);
      const bool isIndices = property.name == "vertex_indices" || property.name == "vertex_index";
      if (isIndices && element.name == "face") {
        thin_ += list_.size() < 3 ? 1 : 0;
        appendFan(part_.triangles, indices(list_.begin(), list_.end()));
      } else if (isIndices && element.name == "tristrips") {
        strips();
      }
    }
  }

  void readList(const PlyProperty& property) {
    const double length = values_.next(*property.listCount);
    if (!(length >= 0.0) || length != std::floor(length)) {
      values_.fail("the length of a list is no count");
    }
    list_.clear();
    for (double k = 0.0; k < length; k += 1.0) {
      list_.push_back(values_.next(property.type));
    }
  }

  /// Strips one after another, ended by -1.
  void strips() {
    auto begin = list_.begin();
    while (begin != list_.end()) {
      const auto end = std::find(begin, list_.end(), -1.0);
      appendStrip(part_.triangles, indices(begin, end));
      begin = end == list_.end() ? end : end + 1;
    }
  }

  std::vector<std::uint32_t> indices(std::vector<double>::const_iterator begin,
                                     std::vector<double>::const_iterator end) const {
    std::vector<std::uint32_t> result;
    for (; begin != end; ++begin) {
      if (!(*begin >= 0.0) || *begin > UINT32_MAX || *begin != std::floor(*begin)) {
        values_.fail(fmt::format("{} is no vertex index", *begin));
      }
      result.push_back(static_cast<std::uint32_t>(*begin));
    }
    return result;
  }

  /// At the end, as the vertices may stand behind the faces.
  void checkIndices() const {
    for (std::size_t t = 0; t < part_.triangles.size(); ++t) {
      for (const std::uint32_t index : part_.triangles[t]) {
        if (index >= part_.positions.size()) {
          reading_.fail(fmt::format("triangle {}", t),
                        fmt::format("uses vertex {}, but there are {} vertices", index, part_.positions.size()));
        }
      }
    }
  }

  const PlyHeader& header_;
  Values values_;
  std::size_t dataBytes_;
  Reading& reading_;
  RawPart part_;
  std::vector<double> list_;
  std::size_t thin_ = 0;
};

}  // namespace

RawModel readPly(std::string_view bytes, Reading& reading) {
  const PlyHeader header = readPlyHeader(bytes, reading);
  const std::size_t dataBytes = bytes.size() - header.bytes;
  if (header.encoding == PlyEncoding::ascii) {
    return PlyReader(header, AsciiValues(bytes, header, reading), dataBytes, reading).read();
  }
  return PlyReader(header, BinaryValues(bytes, header, reading), dataBytes, reading).read();
}

}  // namespace lorica::io
