#pragma once

/// \file
/// Indices of different things are different types, so that a joint is never taken for a triangle.

#include <compare>
#include <cstddef>
#include <cstdint>

namespace lorica::base {

template <class Tag>
struct Index {
  std::uint32_t value = 0;

  constexpr Index() = default;
  constexpr explicit Index(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
  // The 0 that a defaulted comparison is rewritten with is the compiler's own.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend constexpr auto operator<=>(const Index&, const Index&) = default;
};

}  // namespace lorica::base
