#pragma once
// Intervals that hold all numbers at once in 90 % of repeats. Where each of m intervals holds in 90 %, some m / 10 miss in
// every repeat. For normal scores Z_i of whatever correlation
//
//   P(|Z_1| <= c_1, ..., |Z_m| <= c_m)  >=  P(|Z_1| <= c_1) ... P(|Z_m| <= c_m)
//
// (Sidak, J. Am. Stat. Assoc. 62, 1967), so that m intervals of the level 0.9^(1/m) each hold together in at least 90 %.
// With the correlation known they could be narrower; but it is the least certain part of a fit's covariance.
//
// A variance that only a few draws have shown makes a score Student's t; a sum of such a part and a known one has the
// degrees of freedom of Satterthwaite (Biometrics Bull. 2, 1946).

#include <cstddef>

namespace feedtwin::tools {

/// Half-width, in deviations, of each of `count` intervals that hold together in 90 %.
/// @param count at least 1
/// @param degrees_of_freedom of the deviation, from about 10 on (Cornish and Fisher's series for Student's t, Abramowitz and
/// Stegun 26.7.5); infinite: it is known
[[nodiscard]] double joint_90(std::size_t count, double degrees_of_freedom);

/// Degrees of freedom of a variance of which `part` was seen in so many independent draws about a known mean, and the rest
/// is known; infinite where there is no such part.
[[nodiscard]] double degrees_of_freedom(double variance, double part, int draws);

}  // namespace feedtwin::tools
