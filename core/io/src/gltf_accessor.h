#pragma once

/// \file
/// Accessors of a glTF file, every offset, length and type checked before a byte is touched.

#include <cstdint>
#include <string>
#include <vector>

#include "lorica/geometry/vectors.h"
#include "reading.h"

namespace tinygltf {
class Model;
struct Accessor;
struct BufferView;
}  // namespace tinygltf

namespace lorica::io {

/// An accessor's elements as numbers, one after another.
struct Elements {
  std::size_t count = 0;
  std::size_t components = 0;  ///< per element
  std::vector<double> values;  ///< finite; normalised integers are mapped to 0..1 or -1..1
};

enum class Shape { scalar, vec3, vec4, mat4 };

/// Which stored types a use of an accessor allows beside 32-bit floats.
struct AllowedTypes {
  bool normalisedIntegers = false;
  bool plainIntegers = false;
};

class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& model, const Reading& reading) : model_(model), reading_(reading) {}

  /// \param user what refers to the accessor, for messages
  /// \throw base::InputError naming the accessor or the view
  Elements numbers(int accessor, Shape shape, const AllowedTypes& allowed, const std::string& user) const;
  /// VEC3 numbers as points.
  std::vector<geometry::Vec3d> points(int accessor, const AllowedTypes& allowed, const std::string& user) const;
  /// Indices, three by three.
  /// \pre their number is a multiple of 3
  std::vector<geometry::Triangle> triangles(int accessor, const std::string& user) const;
  /// Elements of an accessor that exists.
  std::size_t count(int accessor, Shape shape, const std::string& user) const;
  /// Unsigned integers: indices (scalar) or joints (vec4). `count` of them form an element.
  std::vector<std::uint32_t> integers(int accessor, Shape shape, bool allow32, const std::string& user) const;

 private:
  const tinygltf::Accessor& checked(int accessor, Shape shape, const std::string& user) const;
  const tinygltf::Accessor& checkedNumbers(int accessor, Shape shape, const AllowedTypes& allowed,
                                           const std::string& user) const;
  const tinygltf::Accessor& checkedIntegers(int accessor, Shape shape, bool allow32, const std::string& user) const;
  void checkFinite(const tinygltf::Accessor& accessor, const double* values, std::size_t components,
                   const std::string& user) const;
  const tinygltf::BufferView& view(int index, const std::string& user) const;
  const unsigned char* bytes(int viewIndex, std::size_t offset, std::size_t stride, std::size_t elementBytes,
                             std::size_t count, const std::string& user) const;
  // `room` gives the zeroed place for all components; it is asked only when the file has bytes for them.
  template <class Map, class Room>
  void fill(const tinygltf::Accessor& accessor, const std::string& user, std::size_t components, Map map,
            Room room) const;
  template <class Stored, class Map, class Room>
  void copy(const tinygltf::Accessor& accessor, const std::string& user, std::size_t components, Map map,
            Room room) const;
  std::vector<std::uint32_t> sparseIndices(const tinygltf::Accessor& accessor, const std::string& user) const;

  const tinygltf::Model& model_;
  const Reading& reading_;
};

}  // namespace lorica::io
