#pragma once
// The plant's equations are written once, for one axis (double) or for several at a time (a vector of
// doubles, one axis a lane). Comparison, `?:` and arithmetic read the same for both; what does not is here.

#include <bit>
#include <cstddef>
#include <cstdint>

namespace feedtwin::plant {

template <int Lanes>
using Doubles [[gnu::vector_size(Lanes * sizeof(double))]] = double;

template <class Real>
struct LaneTraits {  // vectors of doubles
  using Int [[gnu::vector_size(sizeof(Real))]] = std::int64_t;
  using Mask = Int;  ///< what a comparison gives: all bits set where true
};

template <>
struct LaneTraits<double> {
  using Int = std::int64_t;
  using Mask = bool;
};

template <class Real>
using MaskOf = typename LaneTraits<Real>::Mask;

[[nodiscard]] inline bool any(bool condition) noexcept {
  return condition;
}

template <class Mask>
[[nodiscard]] inline bool any(const Mask& condition) noexcept {
  std::int64_t seen = 0;
  for (std::size_t lane = 0; lane < sizeof(Mask) / sizeof(std::int64_t); ++lane) seen |= condition[lane];
  return seen != 0;
}

template <class Real>
[[nodiscard]] inline Real absolute(Real value) noexcept {
  return value < 0.0 ? -value : value;
}

template <class Real>
[[nodiscard]] inline Real smaller(Real a, Real b) noexcept {
  return a < b ? a : b;
}

template <class Real>
[[nodiscard]] inline Real larger(Real a, Real b) noexcept {
  return a > b ? a : b;
}

/// Value cut to [-limit, limit].
template <class Real>
[[nodiscard]] inline Real within(Real value, Real limit) noexcept {
  return larger<Real>(smaller<Real>(value, limit), -limit);
}

template <class To, class From>
[[nodiscard]] inline To reinterpret(const From& value) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, value);
}

/// exp(-y) for y >= 0, branch-free and the same in every lane width; relative error below 8e-9, which is a few
/// billionths of the Stribeck rise. exp(-y) = 2^-n exp(r) with r = n ln 2 - y in [-ln2/2, ln2/2], exp(r) to r^7.
/// The rounding to n adds and subtracts 1.5 * 2^52: -ffast-math would delete it in silence.
template <class Real>
[[nodiscard]] inline Real exp_of_minus(Real y) noexcept {
  using Int = typename LaneTraits<Real>::Int;
  constexpr double log2e = 1.4426950408889634;
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr double round = 6755399441055744.0;
  y = y < 700.0 ? y : Real{} + 700.0;  // e^-700 = 1e-304: nothing left
  const Real shifted = y * log2e + round;
  const Real n = shifted - round;
  const Real r = (n * ln2_high - y) + n * ln2_low;
  const Real r2 = r * r;
  const Real low = (1.0 + r) + r2 * (1.0 / 2.0 + r * (1.0 / 6.0));
  const Real high = (1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0 + r * (1.0 / 5040.0));
  const Int exponent = (1023 - (reinterpret<Int>(shifted) - std::bit_cast<std::int64_t>(round))) << 52;
  return (low + (r2 * r2) * high) * reinterpret<Real>(exponent);
}

}  // namespace feedtwin::plant
