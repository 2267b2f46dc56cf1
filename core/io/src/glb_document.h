#pragma once

/// \file
/// A binary glTF file while it is put together: its lists, its one buffer and its container.

#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "lorica/geometry/vectors.h"

namespace lorica::io {

using Json = nlohmann::ordered_json;

/// What an accessor's numbers are for: vertex attributes and indices say so in their buffer view.
enum class GlbUse { attribute, indices, other };

class GlbDocument {
 public:
  Json nodes = Json::array();
  Json roots = Json::array();  ///< indices of the scene's nodes
  Json meshes = Json::array();
  Json materials = Json::array();
  Json skins = Json::array();
  Json animations = Json::array();

  /// Appends numbers as an accessor on a view of its own; its index. A row of `T` is one element of `type`, but a
  /// triangle is three.
  /// \pre values are not empty and fill whole words of four bytes
  template <class T>
  std::size_t add(std::span<const T> values, const char* type, GlbUse use) {
    constexpr bool isTriangle = std::is_same_v<T, geometry::Triangle>;
    return addRaw(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()),
                  componentType<T>(), (isTriangle ? 3 : 1) * values.size(), type, use);
  }
  /// The accessor's smallest and largest numbers, where glTF asks for them.
  void setRange(std::size_t accessor, const Json& least, const Json& greatest);

  /// The whole file.
  std::string bytes() const;

 private:
  template <class T>
  static constexpr int componentType() {
    if constexpr (requires { typename T::Scalar; }) {
      return componentType<typename T::Scalar>();
    } else if constexpr (std::is_same_v<T, geometry::Triangle>) {
      return 5125;
    } else if constexpr (requires { typename T::value_type; }) {
      return componentType<typename T::value_type>();
    } else if constexpr (std::is_same_v<T, std::uint8_t>) {
      return 5121;
    } else if constexpr (std::is_same_v<T, std::uint16_t>) {
      return 5123;
    } else {
      static_assert(std::is_same_v<T, float>);
      return 5126;
    }
  }
  std::size_t addRaw(std::string_view raw, int componentType, std::size_t count, const char* type, GlbUse use);

  Json accessors_ = Json::array();
  Json views_ = Json::array();
  std::string binary_;
};

}  // namespace lorica::io
