#pragma once
// A force of the process on the table: cutting, with the passing of teeth.
//
//   F = F_0 + R tanh(v / 0.5 mm/s) + A sin(2 pi f t + phase)   from start to end, otherwise none
//
// F_0 = mean_N, R = opposing_N, A = amplitude_N, f = frequency_Hz, t since the run began; start_s and end_s: the tool is in
// the cut. A sub-step that is in it for a part has that part of its mean.

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
        teeth_(setting.values[1], setting.values[2], setting.values[3]) {}
  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double in_cut_s = std::min(m.time_s + m.h_s, end_s_) - std::max(m.time_s, start_s_);
    const double share = std::max(0.0, in_cut_s / m.h_s), against = std::tanh(m.velocity_m_per_s / process_turns_m_per_s);
    return {share * (mean_N_ + opposing_N_ * against + teeth_.mean_N(m)),
            share * opposing_N_ / process_turns_m_per_s * (1.0 - against * against)};
  }

 private:
  double mean_N_, start_s_, end_s_, opposing_N_;
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

}  // namespace feedtwin::plant::effects
