#include "tools/diagnose/size_of_axis.h"

#include <algorithm>
#include <numbers>

namespace feedtwin::tools::diagnosis {

double newton_of(const plant::AxisParameters& axis) {
  constexpr double ordinary_N = 30.0, moving_m_per_s2 = 1.0, least = 1e-3;
  const auto mean = [](const auto& both) { return 0.5 * (both.pos + both.neg); };
  const double friction_N = mean(axis.motor.coulomb_N) + mean(axis.ball_screw.coulomb_N) + mean(axis.guide.coulomb_N);
  const double per_m = 2.0 * std::numbers::pi / axis.axis.lead_m;
  const double moved_kg = (axis.motor.inertia_kgm2 + axis.ball_screw_inertia_kgm2) * per_m * per_m + axis.guide_mass_kg;
  return std::clamp(std::max(friction_N, moved_kg * moving_m_per_s2) / ordinary_N, least, 1.0);
}

}  // namespace feedtwin::tools::diagnosis
