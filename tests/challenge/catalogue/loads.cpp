// Hidden effects of drive and load.

#include "tests/challenge/catalogue/tables.h"

namespace feedtwin::challenge {

std::vector<Hidden> hidden_in_loads() {
  return {
      {"cable_spring", none, true, false, 20.0, 1500.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.cable_N_per_m = s;
         e.cable_neutral_m = uniform(r, -0.03, 0.03);
       },
       [](const Effects& e) { return Numbers{{"stiffness_N_per_m", e.cable_N_per_m}, {"neutral_m", e.cable_neutral_m}}; }},
      {"current_loop_lag",
       none,
       true,
       false,
       3e-4,
       5e-3,
       [](Effects& e, double s, Shape, const Reach&) { e.current_loop_s = s; },
       [](const Effects& e) { return Numbers{{"time_constant_s", e.current_loop_s}}; },
       {"input_delay"}},
      {"input_delay",
       none,
       true,
       false,
       2e-4,
       4e-3,
       [](Effects& e, double s, Shape, const Reach&) { e.input_delay_s = s; },
       [](const Effects& e) { return Numbers{{"delay_s", e.input_delay_s}}; },
       {"current_loop_lag"}},
      {"torque_saturation", none, false, false, 0.75, 0.93,
       [](Effects& e, double s, Shape, const Reach& reach) { e.saturation_Nm = s * reach.torque_Nm; },
       [](const Effects& e) { return Numbers{{"limit_Nm", e.saturation_Nm}}; }},
      {"quadratic_drag", none, true, false, 50.0, 8000.0,
       [](Effects& e, double s, Shape, const Reach&) { e.drag_Ns2_per_m2 = s; },
       [](const Effects& e) { return Numbers{{"coefficient_Ns2_per_m2", e.drag_Ns2_per_m2}}; }},
      {"floor_vibration",
       none,
       true,
       false,
       0.05,
       10.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.floor_m_per_s2 = s;
         e.floor_Hz = uniform(r, 8.0, 40.0);
       },
       [](const Effects& e) { return Numbers{{"acceleration_m_per_s2", e.floor_m_per_s2}, {"frequency_Hz", e.floor_Hz}}; },
       {"process_force"}},
      {"process_force",
       none,
       true,
       false,
       0.5,
       30.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.process_N = s;
         e.process_mean_N = 0.0;
         e.process_Hz = uniform(r, 30.0, 90.0);
       },
       [](const Effects& e) { return Numbers{{"amplitude_N", e.process_N}, {"frequency_Hz", e.process_Hz}}; },
       {"floor_vibration"}},
      {"hard_stop", none, false, false, 0.96, 0.995,
       [](Effects& e, double s, Shape, const Reach& reach) {
         e.stop_m = s * reach.position_m;
         e.stop_N_per_m = 2e5;
       },
       [](const Effects& e) {
         return Numbers{
             {"position_m", e.stop_m}, {"stiffness_N_per_m", e.stop_N_per_m}, {"damping_Ns_per_m", e.stop_Ns_per_m}};
       }},
      {"payload",
       none,
       true,
       false,
       1.0,
       20.0,
       [](Effects& e, double s, Shape, const Reach&) { e.payload_kg = s; },
       [](const Effects& e) { return Numbers{{"mass_kg", e.payload_kg}}; },
       {},
       true},
      {"gravity",
       force_sensor,
       false,
       true,
       1.0,
       40.0,
       [](Effects& e, double s, Shape r, const Reach&) { e.gravity_N = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"force_N", e.gravity_N}}; },
       {"torque_offset", "direction_dependent_friction"},
       false},
  };
}

}  // namespace feedtwin::challenge
