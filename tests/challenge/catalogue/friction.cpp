// Hidden effects of friction.

#include "tests/challenge/catalogue/tables.h"

namespace feedtwin::challenge {

std::vector<Hidden> hidden_in_friction() {
  return {
      {"position_friction", none, true, false, 0.03, 0.9,
       [](Effects& e, double s, Shape r, const Reach&) { e.position_friction = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"relative_slope_per_half_stroke", e.position_friction}}; }},
      {"local_friction", none, true, false, 1.0, 60.0,
       [](Effects& e, double s, Shape r, const Reach& reach) {
         e.local_height_N = s;
         e.local_centre_m = uniform(r, -0.3, 0.3) * reach.position_m;
         e.local_half_width_m = uniform(r, 0.8e-3, 3e-3);
       },
       [](const Effects& e) {
         return Numbers{
             {"height_N", e.local_height_N}, {"centre_m", e.local_centre_m}, {"half_width_m", e.local_half_width_m}};
       }},
      {"sublinear_viscous", none, true, false, 0.05, 0.5,
       [](Effects& e, double s, Shape, const Reach&) { e.sublinear_exponent = 1.0 - s; },
       [](const Effects& e) {
         return Numbers{{"exponent", e.sublinear_exponent}, {"reference_speed_m_per_s", e.sublinear_speed_m_per_s}};
       }},
      {"presliding_memory",
       none,
       false,
       true,
       1.0,
       50.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.memory_N = s;
         e.memory_m = uniform(r, 5e-6, 5e-5);
       },
       [](const Effects& e) { return Numbers{{"force_N", e.memory_N}, {"distance_m", e.memory_m}}; },
       {"backlash"}},
      {"dwell_breakaway", none, false, true, 0.05, 0.6,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.dwell_rise = s;
         e.dwell_s = uniform(r, 0.3, 2.0);
       },
       [](const Effects& e) {
         return Numbers{
             {"relative_rise", e.dwell_rise}, {"time_constant_s", e.dwell_s}, {"memory_distance_m", e.dwell_memory_m}};
       }},
      {"frictional_lag", none, true, false, 0.001, 0.03,
       [](Effects& e, double s, Shape, const Reach&) { e.frictional_lag_s = s; },
       [](const Effects& e) { return Numbers{{"time_constant_s", e.frictional_lag_s}}; }},
      {"thermal_friction",
       none,
       true,
       false,
       0.03,
       0.45,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.thermal_reduction = s;
         e.thermal_J = uniform(r, 5.0, 25.0);
       },
       [](const Effects& e) { return Numbers{{"viscous_reduction", e.thermal_reduction}, {"energy_scale_J", e.thermal_J}}; },
       {"friction_drift"}},
      {"friction_drift",
       none,
       true,
       false,
       0.03,
       0.5,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.drift_change = sign(r) * s;
         e.drift_s = uniform(r, 1.0, 5.0);
       },
       [](const Effects& e) { return Numbers{{"relative_change", e.drift_change}, {"time_constant_s", e.drift_s}}; },
       {"thermal_friction"}},
  };
}

}  // namespace feedtwin::challenge
