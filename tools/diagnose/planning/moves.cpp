#include "tools/diagnose/planning/moves.h"

#include <algorithm>
#include <array>

#include "plant/axis_model.h"

namespace feedtwin::tools::diagnosis {

std::span<const Move> moves() noexcept {
  static constexpr std::array all{
      Move{.text = "the same moves with the process stopped (tool lifted, spindle off)",
           .motion = "sine",
           .process_runs = false},
      Move{.text = "a staircase of steady speeds, from a hundredth of the fastest up to it, both ways",
           .motion = "stair",
           .duration_s = 8.0},
      Move{.text = "S-curve moves as hard as the motor can, with strong jerk",
           .motion = "s_curve",
           .acceleration_in_torque_limit = 0.6,
           .jerk_m_per_s3 = 500.0,
           .dwell_s = 0.1},
      Move{.text = "slow moves over the whole stroke, both ways",
           .motion = "triangle",
           .amplitude_in_half_strokes = 0.85,
           .speed_in_fastest = 0.3,
           .duration_s = 10.0},
      Move{.text = "slow reversals of 30 um to and fro",
           .motion = "sine",
           .amplitude_in_half_strokes = 4e-4,
           .speed_in_fastest = 3e-3},
      Move{.text = "starts after rests of two seconds",
           .motion = "s_curve",
           .speed_in_fastest = 0.3,
           .dwell_s = 2.0,
           .duration_s = 12.0},
      Move{.text = "the fastest move of the recordings to and fro for half a minute, from cold",
           .motion = "triangle",
           .duration_s = 30.0},
      Move{.text = "a tenth of the fastest speed to and fro for half a minute, from cold",
           .motion = "triangle",
           .speed_in_fastest = 0.1,
           .duration_s = 30.0},
      Move{.text = "hard S-curve moves with 10 kg more on the table",
           .motion = "s_curve",
           .acceleration_in_torque_limit = 0.5,
           .jerk_m_per_s3 = 200.0,
           .more_on_table_kg = 10.0},
      Move{.text = "a staircase of steady speeds with a torque sensor between motor and screw",
           .motion = "stair",
           .duration_s = 8.0,
           .extra = Extra::torque_sensor},
      Move{.text = "a staircase of steady speeds with a linear scale at the table",
           .motion = "stair",
           .duration_s = 8.0,
           .extra = Extra::scale},
      Move{.text = "S-curve moves with rests and a force sensor between nut and table",
           .motion = "s_curve",
           .acceleration_in_torque_limit = 0.4,
           .dwell_s = 0.4,
           .extra = Extra::force_sensor},
  };
  return all;
}

controllers::MotionSettings settings_of(const Move& move, const plant::AxisParameters& axis, double fastest_m_per_s) {
  const auto model = plant::make_axis_model(axis);
  const double hardest = axis.axis.torque_limit_Nm * model.transmission_rad_per_m / model.mass_kg;
  controllers::MotionSettings settings;
  settings.centre_m = axis.axis.stroke_centre_m;
  settings.amplitude_m = std::max(1e-5, move.amplitude_in_half_strokes * 0.5 * axis.axis.stroke_m);
  settings.speed_m_per_s = std::max(1e-4, move.speed_in_fastest * fastest_m_per_s);
  settings.acceleration_m_per_s2 = std::max(0.05, move.acceleration_in_torque_limit * hardest);
  settings.jerk_m_per_s3 = move.jerk_m_per_s3;
  settings.dwell_s = move.dwell_s;
  settings.steps = 8;
  settings.hold_s = 0.3;
  return settings;
}

}  // namespace feedtwin::tools::diagnosis
