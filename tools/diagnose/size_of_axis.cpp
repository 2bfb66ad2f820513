#include "tools/diagnose/size_of_axis.h"

#include <algorithm>

#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

double newton_of(const plant::AxisParameters& axis) {
  constexpr double ordinary_N = 30.0, moving_m_per_s2 = 1.0, least = 1e-3;
  const double friction_N = mean(axis.motor.coulomb_N) + mean(axis.ball_screw.coulomb_N) + mean(axis.guide.coulomb_N);
  const double all_kg = moved_kg({.name = {}, .motor = true, .screw = true, .guide = true}, axis);
  return std::clamp(std::max(friction_N, all_kg * moving_m_per_s2) / ordinary_N, least, 1.0);
}

}  // namespace feedtwin::tools::diagnosis
