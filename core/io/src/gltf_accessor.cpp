#include "gltf_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "lorica/base/error.h"

namespace lorica::io {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are read as they stand in memory");

/// Without a view nothing in the file bounds the number of elements.
constexpr std::size_t mostElementsWithoutView = 10'000'000;

struct ShapeFacts {
  int type;
  std::size_t components;
  const char* name;
};

ShapeFacts facts(Shape shape) {
  switch (shape) {
    case Shape::scalar:
      return {TINYGLTF_TYPE_SCALAR, 1, "SCALAR"};
    case Shape::vec3:
      return {TINYGLTF_TYPE_VEC3, 3, "VEC3"};
    case Shape::vec4:
      return {TINYGLTF_TYPE_VEC4, 4, "VEC4"};
    case Shape::mat4:
      return {TINYGLTF_TYPE_MAT4, 16, "MAT4"};
  }
  return {};
}

std::string at(const std::string& user, int accessor) {
  return fmt::format("{}, accessor {}", user, accessor);
}

/// A stored value as a number; normalised integers by the rules of glTF 2.0, section 3.11.
struct Number {
  bool normalised;
  template <class Stored>
  double operator()(Stored stored) const {
    const auto value = static_cast<double>(stored);
    if constexpr (std::is_integral_v<Stored>) {
      constexpr auto most = static_cast<double>(std::numeric_limits<Stored>::max());
      return normalised ? std::max(value / most, -1.0) : value;
    }
    return value;
  }
};

template <class T>
auto roomIn(std::vector<T>& values) {
  return [&values](std::size_t count) {
    values.resize(count);
    return values.data();
  };
}

struct Integer {
  template <class Stored>
  std::uint32_t operator()(Stored stored) const {
    return static_cast<std::uint32_t>(stored);
  }
};

}  // namespace

const tinygltf::Accessor& AccessorReader::checked(int accessor, Shape shape, const std::string& user) const {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size()) {
    reading_.fail(user, fmt::format("refers to accessor {}, but the file has {}", accessor, model_.accessors.size()));
  }
  const tinygltf::Accessor& found = model_.accessors[static_cast<std::size_t>(accessor)];
  if (found.type != facts(shape).type) {
    reading_.fail(at(user, accessor), fmt::format("has the wrong type; {} was expected", facts(shape).name));
  }
  if (found.count == 0) {
    reading_.fail(at(user, accessor), "is empty");
  }
  if (found.bufferView < 0 && (!found.sparse.isSparse || found.count > mostElementsWithoutView)) {
    reading_.fail(at(user, accessor), "has no buffer view to read from");
  }
  return found;
}

const tinygltf::BufferView& AccessorReader::view(int index, const std::string& user) const {
  if (index < 0 || static_cast<std::size_t>(index) >= model_.bufferViews.size()) {
    reading_.fail(user, fmt::format("refers to buffer view {}, but the file has {}", index, model_.bufferViews.size()));
  }
  const tinygltf::BufferView& found = model_.bufferViews[static_cast<std::size_t>(index)];
  if (found.buffer < 0 || static_cast<std::size_t>(found.buffer) >= model_.buffers.size()) {
    reading_.fail(fmt::format("buffer view {}", index),
                  fmt::format("refers to buffer {}, but the file has {}", found.buffer, model_.buffers.size()));
  }
  const std::size_t size = model_.buffers[static_cast<std::size_t>(found.buffer)].data.size();
  if (found.byteOffset > size || found.byteLength > size - found.byteOffset) {
    reading_.fail(fmt::format("buffer view {}", index),
                  fmt::format("covers bytes {} and {} more, but buffer {} has {}", found.byteOffset, found.byteLength,
                              found.buffer, size));
  }
  return found;
}

const unsigned char* AccessorReader::bytes(int viewIndex, std::size_t offset, std::size_t stride,
                                           std::size_t elementBytes, std::size_t count, const std::string& user) const {
  const tinygltf::BufferView& found = view(viewIndex, user);
  if (stride < elementBytes) {
    reading_.fail(fmt::format("buffer view {}", viewIndex),
                  fmt::format("has a stride of {} bytes for elements of {}", stride, elementBytes));
  }
  const std::size_t room = found.byteLength;
  if (offset > room || elementBytes > room - offset || (room - offset - elementBytes) / stride < count - 1) {
    reading_.fail(user, fmt::format("{} elements from byte {} on do not fit into the {} bytes of buffer view {}", count,
                                    offset, room, viewIndex));
  }
  return model_.buffers[static_cast<std::size_t>(found.buffer)].data.data() + found.byteOffset + offset;
}

template <class Stored, class Map, class Room>
void AccessorReader::copy(const tinygltf::Accessor& accessor, const std::string& user, std::size_t components, Map map,
                          Room room) const {
  const std::size_t elementBytes = components * sizeof(Stored);
  const auto value = [&](const unsigned char* from) {
    Stored stored;
    std::memcpy(&stored, from, sizeof stored);
    return map(stored);
  };
  const unsigned char* from = nullptr;
  std::size_t stride = elementBytes;
  if (accessor.bufferView >= 0) {
    const std::size_t given = view(accessor.bufferView, user).byteStride;
    stride = given == 0 ? elementBytes : given;
    from = bytes(accessor.bufferView, accessor.byteOffset, stride, elementBytes, accessor.count, user);
  }
  auto* out = room(accessor.count * components);
  if (from != nullptr && stride == elementBytes) {
    for (std::size_t i = 0; i < accessor.count * components; ++i) {
      out[i] = value(from + i * sizeof(Stored));
    }
  } else if (from != nullptr) {
    for (std::size_t i = 0; i < accessor.count * components; ++i) {
      out[i] = value(from + i / components * stride + i % components * sizeof(Stored));
    }
  }
  if (accessor.sparse.isSparse) {
    const std::vector<std::uint32_t> replaced = sparseIndices(accessor, user);
    const auto offset = static_cast<std::size_t>(accessor.sparse.values.byteOffset);
    from = bytes(accessor.sparse.values.bufferView, offset, elementBytes, elementBytes, replaced.size(), user);
    for (std::size_t i = 0; i < replaced.size() * components; ++i) {
      out[replaced[i / components] * components + i % components] = value(from + i * sizeof(Stored));
    }
  }
}

template <class Map, class Room>
void AccessorReader::fill(const tinygltf::Accessor& accessor, const std::string& user, std::size_t components, Map map,
                          Room room) const {
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return copy<std::int8_t>(accessor, user, components, map, room);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copy<std::uint8_t>(accessor, user, components, map, room);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return copy<std::int16_t>(accessor, user, components, map, room);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copy<std::uint16_t>(accessor, user, components, map, room);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copy<std::uint32_t>(accessor, user, components, map, room);
    default:
      return copy<float>(accessor, user, components, map, room);
  }
}

std::vector<std::uint32_t> AccessorReader::sparseIndices(const tinygltf::Accessor& accessor,
                                                         const std::string& user) const {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count) {
    reading_.fail(user, fmt::format("replaces {} of {} elements", sparse.count, accessor.count));
  }
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    reading_.fail(user, "has a negative offset in its sparse part");
  }
  tinygltf::Accessor indices;
  indices.bufferView = sparse.indices.bufferView;
  indices.byteOffset = static_cast<std::size_t>(sparse.indices.byteOffset);
  indices.componentType = sparse.indices.componentType;
  indices.count = static_cast<std::size_t>(sparse.count);
  if (indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    reading_.fail(user, "has sparse indices that are no unsigned integers");
  }
  view(indices.bufferView, user);
  std::vector<std::uint32_t> result;
  fill(indices, user, 1, Integer{}, roomIn(result));
  for (const std::uint32_t index : result) {
    if (index >= accessor.count) {
      reading_.fail(user, fmt::format("replaces element {}, but has {}", index, accessor.count));
    }
  }
  return result;
}

const tinygltf::Accessor& AccessorReader::checkedNumbers(int accessor, Shape shape, const AllowedTypes& allowed,
                                                         const std::string& user) const {
  const tinygltf::Accessor& found = checked(accessor, shape, user);
  const bool isFloat = found.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool isSmallInteger = found.componentType >= TINYGLTF_COMPONENT_TYPE_BYTE &&
                              found.componentType <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  const bool integersAllowed = found.normalized ? allowed.normalisedIntegers : allowed.plainIntegers;
  if (!isFloat && !(isSmallInteger && integersAllowed)) {
    reading_.fail(at(user, accessor), fmt::format("has component type {}{}, which is not allowed here",
                                                  found.componentType, found.normalized ? " (normalised)" : ""));
  }
  return found;
}

void AccessorReader::checkFinite(const tinygltf::Accessor& accessor, const double* values, std::size_t components,
                                 const std::string& user) const {
  for (std::size_t i = 0; i < accessor.count * components; ++i) {
    if (!std::isfinite(values[i])) {
      reading_.fail(user, fmt::format("element {} is not finite", i / components));
    }
  }
}

Elements AccessorReader::numbers(int accessor, Shape shape, const AllowedTypes& allowed,
                                 const std::string& user) const {
  const tinygltf::Accessor& found = checkedNumbers(accessor, shape, allowed, user);
  Elements result;
  result.count = found.count;
  result.components = facts(shape).components;
  fill(found, at(user, accessor), result.components, Number{found.normalized}, roomIn(result.values));
  checkFinite(found, result.values.data(), result.components, at(user, accessor));
  return result;
}

std::vector<geometry::Vec3d> AccessorReader::points(int accessor, const AllowedTypes& allowed,
                                                    const std::string& user) const {
  static_assert(sizeof(geometry::Vec3d) == 3 * sizeof(double), "points are numbers one after another");
  const tinygltf::Accessor& found = checkedNumbers(accessor, Shape::vec3, allowed, user);
  std::vector<geometry::Vec3d> result;
  fill(found, at(user, accessor), 3, Number{found.normalized}, [&](std::size_t count) {
    result.assign(count / 3, geometry::Vec3d::Zero());
    return result.data()->data();
  });
  checkFinite(found, result.data()->data(), 3, at(user, accessor));
  return result;
}

std::size_t AccessorReader::count(int accessor, Shape shape, const std::string& user) const {
  return checked(accessor, shape, user).count;
}

const tinygltf::Accessor& AccessorReader::checkedIntegers(int accessor, Shape shape, bool allow32,
                                                          const std::string& user) const {
  const tinygltf::Accessor& found = checked(accessor, shape, user);
  const bool isSmall = found.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       found.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  if (!isSmall && !(allow32 && found.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
    reading_.fail(at(user, accessor),
                  fmt::format("has component type {}, unsigned integers were expected", found.componentType));
  }
  return found;
}

std::vector<std::uint32_t> AccessorReader::integers(int accessor, Shape shape, bool allow32,
                                                    const std::string& user) const {
  const tinygltf::Accessor& found = checkedIntegers(accessor, shape, allow32, user);
  std::vector<std::uint32_t> result;
  fill(found, at(user, accessor), facts(shape).components, Integer{}, roomIn(result));
  return result;
}

std::vector<geometry::Triangle> AccessorReader::triangles(int accessor, const std::string& user) const {
  static_assert(sizeof(geometry::Triangle) == 3 * sizeof(std::uint32_t), "triangles are indices one after another");
  const tinygltf::Accessor& found = checkedIntegers(accessor, Shape::scalar, true, user);
  LORICA_CHECK(found.count % 3 == 0, "the caller has told the user of odd corners");
  std::vector<geometry::Triangle> result;
  fill(found, at(user, accessor), 1, Integer{}, [&](std::size_t count) {
    result.resize(count / 3);
    return result.data()->data();
  });
  return result;
}

}  // namespace lorica::io
