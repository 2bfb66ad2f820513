#include "plant/effects/registry.h"

#include <algorithm>
#include <array>

#include "plant/effects/backlash.h"
#include "plant/effects/cable_spring.h"
#include "plant/effects/channel_skew.h"
#include "plant/effects/cogging.h"
#include "plant/effects/copper_loss.h"
#include "plant/effects/count_loss.h"
#include "plant/effects/current_loop_lag.h"
#include "plant/effects/cyclic_lead_error.h"
#include "plant/effects/direction_dependent_friction.h"
#include "plant/effects/dwell_breakaway.h"
#include "plant/effects/encoder_eccentricity.h"
#include "plant/effects/floor_vibration.h"
#include "plant/effects/friction_drift.h"
#include "plant/effects/frictional_lag.h"
#include "plant/effects/gravity.h"
#include "plant/effects/hard_stop.h"
#include "plant/effects/hidden_friction_compensation.h"
#include "plant/effects/input_delay.h"
#include "plant/effects/lead_error.h"
#include "plant/effects/learned_command.h"
#include "plant/effects/learned_mode.h"
#include "plant/effects/learned_reading.h"
#include "plant/effects/learned_residual.h"
#include "plant/effects/load_dependent_friction.h"
#include "plant/effects/local_friction.h"
#include "plant/effects/motor_presliding.h"
#include "plant/effects/payload.h"
#include "plant/effects/position_friction.h"
#include "plant/effects/position_friction_wave.h"
#include "plant/effects/power_meter_window.h"
#include "plant/effects/presliding_memory.h"
#include "plant/effects/process_force.h"
#include "plant/effects/quadratic_drag.h"
#include "plant/effects/regeneration_clipped.h"
#include "plant/effects/rev_ripple.h"
#include "plant/effects/screw_compliance.h"
#include "plant/effects/screw_growth.h"
#include "plant/effects/sensor_gain.h"
#include "plant/effects/sublinear_viscous.h"
#include "plant/effects/thermal_friction.h"
#include "plant/effects/torque_gain_error.h"
#include "plant/effects/torque_offset.h"
#include "plant/effects/torque_ripple.h"
#include "plant/effects/torque_saturation.h"
#include "plant/effects/wrong_lead.h"
#include "plant/effects/wrong_sign.h"

namespace feedtwin::plant {
namespace {

using namespace effects;

// The order of the lines is that of the signal's way through the axis.
// clang-format off: a line an effect
constexpr std::array table{
    wrong_sign,
    learned_command,
    hidden_friction_compensation,
    torque_offset,
    input_delay,
    torque_saturation,
    current_loop_lag,
    torque_gain_error,
    torque_ripple,
    cogging,
    motor_presliding,
    direction_dependent_friction,
    sublinear_viscous,
    presliding_memory,
    dwell_breakaway,
    frictional_lag,
    frictional_lag_of_velocity,
    thermal_friction,
    thermal_friction_of_all,
    friction_drift,
    position_friction,
    position_friction_wave,
    rev_ripple_of_friction,
    load_dependent_friction,
    learned_residual,
    rev_ripple,
    wrong_lead,
    backlash,
    screw_compliance,
    local_friction,
    payload,
    gravity,
    cable_spring,
    quadratic_drag,
    learned_mode,
    floor_vibration,
    process_force,
    process_force_against_motion,
    hard_stop,
    lead_error,
    cyclic_lead_error,
    screw_growth,
    encoder_eccentricity,
    count_loss,
    copper_loss,
    regeneration_clipped,
    power_meter_window,
    learned_reading,
    sensor_gain,
    channel_skew,
};
// clang-format on

}  // namespace

std::string_view name_of(EffectComponent component) noexcept {
  constexpr std::array<std::string_view, 8> names{"motor", "drive", "ball_screw", "guide",
                                                  "load",  "power", "sensors",    "set_up"};
  return names[static_cast<std::size_t>(component)];
}

std::span<const EffectEntry> effect_registry() noexcept {
  return table;
}

const EffectEntry* find_effect(std::string_view id) noexcept {
  const auto found = std::ranges::find(table, id, &EffectEntry::id);
  return found == table.end() ? nullptr : &*found;
}

EffectSetting preset_of(const EffectEntry& entry) {
  EffectSetting setting{.id = std::string(entry.id), .values = {}, .lists = {}};
  for (const auto& parameter : entry.parameters) {
    if (parameter.list) {
      setting.lists.emplace_back();
    } else {
      setting.values.push_back(parameter.preset.value_or(parameter.neutral.value_or(parameter.lowest)));
    }
  }
  return setting;
}

double* value_in(EffectSetting& setting, const EffectEntry& entry, std::string_view parameter) noexcept {
  std::size_t place = 0;
  for (const auto& known : entry.parameters) {
    if (known.list) continue;
    if (known.name == parameter) return place < setting.values.size() ? &setting.values[place] : nullptr;
    ++place;
  }
  return nullptr;
}

}  // namespace feedtwin::plant
