#pragma once
// A setting of each effect as it is met on an axis of the source's size, for tests that want every effect to act.

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "plant/effects/registry.h"

namespace feedtwin::test {

/// Throws where an effect of the registry has none yet.
inline plant::EffectSetting typical_effect(const plant::EffectEntry& entry) {
  static const std::map<std::string, std::vector<double>, std::less<>> values{
      {"backlash", {5e-6, 6e7, 2e3}},
      {"cable_spring", {800.0, -0.02}},
      {"channel_skew", {4e-4, 1.3e-3, 2.5e-3, 5e-3}},
      {"cogging", {0.02, 12.0, 0.3}},
      {"copper_loss", {9.0}},
      {"count_loss", {3.0, 0.7, 0.0}},
      {"current_loop_lag", {1.5e-3}},
      {"cyclic_lead_error", {2e-6, 1.0, 0.4}},
      {"direction_dependent_friction", {10.0, 300.0}},
      {"dwell_breakaway", {0.3, 0.1, 2e-5}},
      {"encoder_eccentricity", {3e-6, 1.0, 0.2}},
      {"floor_vibration", {0.5, 25.0, 0.0}},
      {"friction_drift", {0.3, 1.0, 0.0}},
      {"frictional_lag", {8e-3}},
      {"frictional_lag_of_velocity", {8e-3}},
      {"gravity", {30.0}},
      {"hard_stop", {2e-3, 1.0, 1e7, 1e4}},
      {"hidden_friction_compensation", {0.03, 1e-3, 0.0, 0.0}},
      {"input_delay", {1.4e-3}},
      {"lead_error", {2e-4}},
      {"learned_mode", {4.0, 8.0, 0.03}},
      {"load_dependent_friction", {0.2, 0.5}},
      {"local_friction", {20.0, 1e-3, 2e-3, 0.0}},
      {"motor_presliding", {1e-6}},
      {"payload", {8.0}},
      {"position_friction", {0.5, 3000.0, -2500.0}},
      {"position_friction_wave", {0.3, 0.045, 0.7, 300.0, -0.4}},
      {"power_meter_window", {0.05, 1.0}},
      {"presliding_memory", {15.0, 1e-5}},
      {"process_force", {20.0, 10.0, 150.0, 0.0, 0.05, 1e9, 5.0, 0.02}},
      {"process_force_against_motion", {20.0, 10.0, 150.0, 0.0, -0.02, 0.03, 0.0}},
      {"quadratic_drag", {800.0}},
      {"regeneration_clipped", {1.0}},
      {"rev_ripple", {4.0, 2.0, 0.1}},
      {"rev_ripple_of_friction", {4.0, 2.0, 0.1}},
      {"screw_compliance", {4e7, 2e3}},
      {"screw_growth", {5e-5, 5.0, -0.075, 0.0}},
      {"sensor_gain", {1.01, 0.97, 1.04, 1.02}},
      {"sublinear_viscous", {0.7, 0.1}},
      {"thermal_friction", {0.3, 2.0, 0.0}},
      {"thermal_friction_of_all", {0.3, 2.0, 0.0}},
      {"torque_gain_error", {0.05}},
      {"torque_offset", {0.02}},
      {"torque_ripple", {0.08, 6.0, 0.5}},
      {"torque_saturation", {0.3}},
      {"wrong_lead", {0.8}},
      {"wrong_sign", {1.0, 1.0, 1.0, -1.0, -1.0}},
  };
  if (entry.id == "learned_residual") {
    return {"learned_residual",
            {},
            {{-0.05, 0.0, 0.05}, {}, {}, {4.0, 9.0, 2.0}, {-5.0, -1.0, -6.0}, {20.0, 60.0, 10.0}, {-30.0, 0.0, -40.0}}};
  }
  if (entry.id == "learned_reading")
    return {"learned_reading", {0.0}, {{-0.05, 0.0, 0.05}, {}, {}, {}, {}, {2.0, -3.0, 1.0}, {}, {}}};
  if (entry.id == "learned_command") return {"learned_command", {0.05}, {{0.0, 0.02, 0.04}, {0.002, -0.004, 0.003}}};
  const auto found = values.find(entry.id);
  if (found == values.end()) throw std::logic_error("no typical setting of " + std::string(entry.id));
  return {std::string(entry.id), found->second, {}};
}

}  // namespace feedtwin::test
