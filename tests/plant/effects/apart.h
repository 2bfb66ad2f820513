#pragma once
// Two axes under the same torques.

#include <algorithm>
#include <cmath>
#include <random>

#include "plant/feed_axis.h"

namespace feedtwin::plant {

/// How far apart two axes come within 3 s under one random torque of up to so much, which lets them rest now and then.
inline double apart_m(const AxisParameters& first, const AxisParameters& second, double most_Nm) {
  FeedAxis one(first), other(second);
  std::mt19937 random(5);  // NOLINT(bugprone-random-generator-seed): the same torques every time
  std::uniform_real_distribution<double> torque_Nm(-most_Nm, most_Nm);
  double apart = 0.0, held_Nm = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 60 == 0) held_Nm = i % 240 == 180 ? 0.0 : torque_Nm(random);
    one.step({held_Nm}, 1e-3), other.step({held_Nm}, 1e-3);
    apart = std::max(apart, std::abs(one.state().position_m - other.state().position_m));
  }
  return apart;
}

}  // namespace feedtwin::plant
