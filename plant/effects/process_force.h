#pragma once
// A force of the process on the table: cutting, with the passing of teeth.
//
//   F = F_0 + R tanh(v / 0.5 mm/s) + A sin(2 pi f t + phase)   from start to end, otherwise none
//
// F_0 = mean_N, R = opposing_N, A = amplitude_N, f = frequency_Hz, t since the run began; start_s and end_s: the tool is in
// the cut. It comes into it and leaves it over ramp_s, in proportion, half of that before and half after; at once where
// that is none: a sub-step that is in the cut for a part then has that part of its mean.
//
// Or all of it opposes the motion, teeth and mean alike, as where a tool cuts both ways through a workpiece that lies
// somewhere along the travel:
//
//   F = (R + A sin(2 pi f t + phase)) s (1 + d s) / 2,   s = tanh(v / 0.5 mm/s),   from from_m to to_m, otherwise none
//
// d = only_direction: 1 or -1 where it cuts that way alone and goes back in the air; both ways, 0, the factor is s.

#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

/// Speed at which what opposes the motion has turned round.
inline constexpr double process_turns_m_per_s = 5e-4;

class ProcessForce final : public Effect {
 public:
  ProcessForce(const EffectContext& /*context*/, const EffectSetting& setting)
      : mean_N_(setting.values[0]),
        start_s_(setting.values[4]),
        end_s_(setting.values[5]),
        opposing_N_(setting.values[6]),
        ramp_s_(setting.values[7]),
        teeth_(setting.values[1], setting.values[2], setting.values[3]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double share = share_in_cut(m);
    if (share == 0.0) return {};
    const double pushing_N = mean_N_ + teeth_.mean_N(m);
    if (opposing_N_ == 0.0) return {share * pushing_N, 0.0};
    const double against = std::tanh(m.velocity_m_per_s / process_turns_m_per_s);
    return {share * (pushing_N + opposing_N_ * against),
            share * opposing_N_ / process_turns_m_per_s * (1.0 - against * against)};
  }

 private:
  /// Of the sub-step. One that is in it whole is told so: after days the difference of two times is no measure of an
  /// instant.
  [[nodiscard]] double share_in_cut(const EffectMotion& m) const noexcept {
    if (ramp_s_ > 0.0) {
      const double middle_s = m.time_s + 0.5 * m.h_s;
      return std::clamp(std::min(middle_s - start_s_, end_s_ - middle_s) / ramp_s_ + 0.5, 0.0, 1.0);
    }
    const double from_s = std::max(start_s_ - m.time_s, 0.0), to_s = std::min(end_s_ - m.time_s, m.h_s);
    return from_s == 0.0 && to_s == m.h_s ? 1.0 : std::max(0.0, (to_s - from_s) / m.h_s);
  }

  double mean_N_, start_s_, end_s_, opposing_N_, ramp_s_;
  TimeWave teeth_;
};

/// Of what opposes the motion where s is its sign, which turns round smoothly: all of it both ways, or in one direction.
[[nodiscard]] inline double cutting(double s, double only_direction) noexcept {
  return only_direction == 0.0 ? s : 0.5 * s * (1.0 + only_direction * s);
}

/// Part of a tool that is in a workpiece from one place to another: it comes in and goes out over a path of 0.2 mm.
[[nodiscard]] inline double share_in_workpiece(double position_m, double from_m, double to_m) noexcept {
  constexpr double over_m = 2e-4;
  return std::clamp(std::min(position_m - from_m, to_m - position_m) / over_m + 0.5, 0.0, 1.0);
}

class ProcessForceAgainstMotion final : public Effect {
 public:
  ProcessForceAgainstMotion(const EffectContext& /*context*/, const EffectSetting& setting)
      : opposing_N_(setting.values[0]),
        from_m_(setting.values[4]),
        to_m_(setting.values[5]),
        only_direction_(std::round(setting.values[6])),
        teeth_(setting.values[1], setting.values[2], setting.values[3]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double middle_m = m.position_m + 0.5 * m.h_s * m.velocity_m_per_s;
    const double now_N = share_in_workpiece(middle_m, from_m_, to_m_) * (opposing_N_ + teeth_.mean_N(m));
    const double against = std::tanh(m.velocity_m_per_s / process_turns_m_per_s);
    const double by_sign = only_direction_ == 0.0 ? 1.0 : std::max(0.0, 0.5 + only_direction_ * against);
    return {now_N * cutting(against, only_direction_),
            by_sign * std::max(0.0, now_N) / process_turns_m_per_s * (1.0 - against * against)};
  }

 private:
  double opposing_N_, from_m_, to_m_, only_direction_;
  TimeWave teeth_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array process_force_parameters{
    EffectParameter{"mean_N", "N", -100000.0, 100000.0, 0.0, 0.0, "mean force; positive: acts against positive motion"},
    EffectParameter{"amplitude_N", "N", 0.0, 1e4, 0.0, 0.0, "half of the alternating force from peak to peak"},
    EffectParameter{"frequency_Hz", "Hz", 0.1, 2000.0, 100.0, {}, "teeth that pass in a second"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "at the start of the run"},
    EffectParameter{"start_s", "s", 0.0, 1e9, 0.0, {}, "the tool comes into the cut, since the run began"},
    EffectParameter{"end_s", "s", 0.0, 1e9, 1e9, {}, "it leaves the cut"},
    EffectParameter{"opposing_N", "N", 0.0, 100000.0, 0.0, 0.0, "mean force against the motion, whichever way it goes"},
    EffectParameter{"ramp_s", "s", 0.0, 10.0, 0.0, {}, "over what the tool comes into the cut and leaves it"},
};

inline constexpr std::array process_force_against_motion_parameters{
    EffectParameter{"opposing_N", "N", 0.0, 100000.0, 0.0, 0.0, "mean force against the motion, whichever way it goes"},
    EffectParameter{"amplitude_N", "N", 0.0, 1e4, 0.0, 0.0, "half of the alternating force from peak to peak"},
    EffectParameter{"frequency_Hz", "Hz", 0.1, 2000.0, 100.0, {}, "teeth that pass in a second"},
    EffectParameter{"phase_rad", "rad", -6.283185307179586, 6.283185307179586, 0.0, {}, "at the start of the run"},
    EffectParameter{"from_m", "m", -1e3, 1e3, -1e3, {}, "table position from which on the tool is in the workpiece"},
    EffectParameter{"to_m", "m", -1e3, 1e3, 1e3, {}, "and up to which it is"},
    EffectParameter{"only_direction", "1", -1.0, 1.0, 0.0, {}, "1, -1: cuts that way alone; 0: both ways"},
};
// clang-format on

inline constexpr EffectEntry process_force{
    .id = "process_force",
    .component = EffectComponent::load,
    .work = EffectWork::exchanges,
    .meaning = "a force of the process acts on the table, with the passing of teeth",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "gravity floor_vibration",
    .exciting_move = "the same move with and without cutting",
    .parameters = process_force_parameters,
    .make = make_effect<ProcessForce>,
    .hooks = hooks_of<ProcessForce>(),
    .even_in_motion = true,
};

inline constexpr EffectEntry process_force_against_motion{
    .id = "process_force_against_motion",
    .component = EffectComponent::load,
    .work = EffectWork::exchanges,
    .meaning = "a force of the process acts on the table against its motion, with the passing of teeth",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm force_sensor_N",
    .confused_with = "process_force",
    .exciting_move = "the same move with and without cutting",
    .parameters = process_force_against_motion_parameters,
    .make = make_effect<ProcessForceAgainstMotion>,
    .hooks = hooks_of<ProcessForceAgainstMotion>(),
    .even_in_motion = true,
};

}  // namespace feedtwin::plant::effects
