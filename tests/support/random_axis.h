#pragma once
// Random axes for property tests: the source's axis with every number moved about its value, or anything that an axis file
// admits.

#include <algorithm>
#include <cmath>
#include <random>

#include "plant/parameter_table.h"

namespace feedtwin::tests {

inline void make_admissible(plant::AxisParameters& p) {
  for (auto* friction : {&p.ball_screw, &p.guide}) {
    friction->static_N.pos = std::max(friction->static_N.pos, friction->coulomb_N.pos);
    friction->static_N.neg = std::max(friction->static_N.neg, friction->coulomb_N.neg);
  }
}

/// How many readings a meter's window spans moves nothing, and is left as it is.
inline bool is_drawn(const plant::ParameterEntry& entry) {
  return entry.key != "power.meter_readings";
}

/// Every number but the transmission's times a factor within [1 / spread, spread].
inline plant::AxisParameters axis_near_source(std::mt19937_64& random, double spread) {
  std::uniform_real_distribution<double> exponent(-std::log(spread), std::log(spread));
  auto p = plant::source_axis();
  for (const auto& entry : plant::parameter_table()) {
    if (is_drawn(entry) && !entry.key.starts_with("axis.")) entry.in(p) *= std::exp(exponent(random));
  }
  make_admissible(p);
  return p;
}

/// Any axis that a file may describe: each number uniform in its logarithm over its admitted range.
inline plant::AxisParameters any_axis(std::mt19937_64& random) {
  plant::AxisParameters p;
  for (const auto& entry : plant::parameter_table()) {
    if (!is_drawn(entry)) continue;
    const double lowest = std::max(entry.lowest, 1e-9);
    const double value = std::exp(std::uniform_real_distribution<double>(std::log(lowest), std::log(entry.highest))(random));
    const bool zero = entry.lowest <= 0.0 && std::bernoulli_distribution(0.2)(random);
    entry.in(p) = zero ? 0.0 : std::clamp(value, entry.lowest, entry.highest);
  }
  p.axis.stroke_centre_m = 0.0;
  make_admissible(p);
  return p;
}

}  // namespace feedtwin::tests
