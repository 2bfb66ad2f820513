// Hidden effects of power and sensors, of set-up, and what the numbers can take up.

#include "tests/challenge/catalogue/tables.h"

namespace feedtwin::challenge {

std::vector<Hidden> hidden_in_readings() {
  return {
      {"copper_loss", power, false, false, 2.0, 25.0,
       [](Effects& e, double s, Shape, const Reach&) { e.copper_W_per_Nm2 = s; },
       [](const Effects& e) { return Numbers{{"coefficient_W_per_Nm2", e.copper_W_per_Nm2}}; }},
      {"regeneration_clipped", power, false, false, 1.0, 1.0,
       [](Effects& e, double s, Shape, const Reach&) { e.regeneration_lost = s; },
       [](const Effects& e) { return Numbers{{"share", e.regeneration_lost}}; }},
      {"power_meter_window", power, false, false, 0.02, 0.06,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.meter_window_s = std::round(1e3 * (sign(r) > 0.0 ? s : 5.0 * s)) * 1e-3;
       },
       [](const Effects& e) { return Numbers{{"window_s", e.meter_window_s}}; }},
      {"count_loss",
       scale,
       false,
       false,
       10.0,
       200.0,
       [](Effects& e, double s, Shape, const Reach&) { e.count_loss = std::round(s); },
       [](const Effects& e) { return Numbers{{"counts_per_pass", e.count_loss}, {"angle_rad", e.count_angle_rad}}; },
       {"lead_error"}},
      {"sensor_gain", torque_sensor | force_sensor, false, false, 0.04, 0.2,
       [](Effects& e, double s, Shape r, const Reach&) {
         (sign(r) > 0.0 ? e.torque_sensor_gain : e.force_sensor_gain) = 1.0 + sign(r) * s;
       },
       [](const Effects& e) {
         return Numbers{{"torque_sensor_gain", e.torque_sensor_gain}, {"force_sensor_gain", e.force_sensor_gain}};
       }},
      {"channel_skew", torque_sensor | force_sensor, false, false, 1e-3, 8e-3,
       [](Effects& e, double s, Shape r, const Reach&) {
         (sign(r) > 0.0 ? e.torque_sensor_delay_s : e.force_sensor_delay_s) = s;
       },
       [](const Effects& e) {
         return Numbers{{"torque_sensor_delay_s", e.torque_sensor_delay_s},
                        {"force_sensor_delay_s", e.force_sensor_delay_s}};
       }},
      {"wrong_lead", scale, false, false, 0.7, 1.4,
       [](Effects& e, double, Shape r, const Reach&) { e.lead_factor = one_of(r, {0.8, 1.25, 2.0, 0.5}); },
       [](const Effects& e) { return Numbers{{"factor", e.lead_factor}}; }},
      {"wrong_sign", torque_sensor | force_sensor, false, false, 1.0, 1.0,
       [](Effects& e, double, Shape r, const Reach&) {
         (sign(r) > 0.0 ? e.torque_sensor_sign : e.force_sensor_sign) = -1.0;
       },
       [](const Effects& e) {
         return Numbers{{"torque_sensor_sign", e.torque_sensor_sign}, {"force_sensor_sign", e.force_sensor_sign}};
       }},
      {"load_dependent_friction", torque_sensor | force_sensor, true, false, 0.02, 0.5,
       [](Effects& e, double s, Shape, const Reach&) { e.load_friction = s; },
       [](const Effects& e) { return Numbers{{"friction_per_load", e.load_friction}}; }},
      {"torque_gain_error",
       torque_sensor | force_sensor,
       false,
       false,
       0.04,
       0.2,
       [](Effects& e, double s, Shape r, const Reach&) { e.torque_gain = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"relative_error", e.torque_gain}}; },
       {"sensor_gain"}},
      {"torque_offset",
       torque_sensor,
       false,
       true,
       2e-3,
       0.03,
       [](Effects& e, double s, Shape r, const Reach&) { e.torque_offset_Nm = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"offset_Nm", e.torque_offset_Nm}}; },
       {"gravity", "direction_dependent_friction"},
       false},
      {"hidden_friction_compensation",
       torque_sensor,
       true,
       false,
       5e-3,
       0.05,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.hidden_Nm = s;
         e.hidden_m_per_s = uniform(r, 1e-3, 5e-3);
       },
       [](const Effects& e) { return Numbers{{"torque_Nm", e.hidden_Nm}, {"speed_m_per_s", e.hidden_m_per_s}}; },
       {},
       true},
  };
}

}  // namespace feedtwin::challenge
