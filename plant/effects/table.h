#pragma once
// Values at ascending points, read on straight lines between them: constant beyond the ends or, of a table with a period,
// over and over.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace feedtwin::plant::effects {

/// The points about a place, and how far it lies between them.
struct TablePlace {
  std::size_t below, above;
  double share;
};

/// @param at ascending, at least one @param period 0: none; else the points lie within one. Wait-free.
[[nodiscard]] inline TablePlace place_in(const std::vector<double>& at, double where, double period = 0.0) noexcept {
  if (period > 0.0) where -= period * std::floor((where - at.front()) / period);
  const auto above = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), where) - at.begin());
  if (above == 0) return {0, 0, 0.0};
  if (above < at.size()) return {above - 1, above, (where - at[above - 1]) / (at[above] - at[above - 1])};
  if (period > 0.0) return {above - 1, 0, (where - at.back()) / (at.front() + period - at.back())};
  return {above - 1, above - 1, 0.0};
}

/// Wait-free.
[[nodiscard]] inline double on_line(const std::vector<double>& values, const TablePlace& p) noexcept {
  return values[p.below] + p.share * (values[p.above] - values[p.below]);
}

inline constexpr std::size_t most_table_points = 256;

/// What is wrong with points of a file; empty: nothing.
[[nodiscard]] inline std::string problem_of_table(const std::vector<double>& at, double period = 0.0) {
  if (at.size() > most_table_points) return "more than " + std::to_string(most_table_points) + " points";
  if (std::adjacent_find(at.begin(), at.end(), std::greater_equal<>{}) != at.end()) return "the points must ascend";
  if (period > 0.0 && at.back() - at.front() >= period) return "the points must lie within one period";
  return {};
}

}  // namespace feedtwin::plant::effects
