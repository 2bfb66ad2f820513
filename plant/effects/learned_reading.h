#pragma once
// What a channel shows and the axis does not do, where no known effect explains it: a table learned from a recording.
//
//   shown = true + table(x),   x = position, velocity, what is read, or time;   over and over where it has a period
//
// Exactly one list of points and exactly one of what is added: to torque sensor, force sensor or linear scale as they are
// shown, or to the power that the drive draws. A reading's own table is read where the true value lies.

#include <array>
#include <string>
#include <vector>

#include "plant/effects/entry.h"
#include "plant/effects/table.h"

namespace feedtwin::plant::effects {

class LearnedReading final : public Effect {
 public:
  LearnedReading(const EffectContext& /*context*/, const EffectSetting& setting)
      : over_(given(setting, 0)),
        adds_to_(given(setting, channels_from) - channels_from),
        period_(setting.values[0]),
        at_(setting.lists[over_]),
        added_(setting.lists[channels_from + adds_to_]) {}

  static std::string problem(const EffectSetting& setting) {
    if (count(setting, 0) != 1) return "expected exactly one of position_m, velocity_m_per_s, reading and time_s";
    if (count(setting, channels_from) != 1)
      return "expected exactly one of torque_sensor_Nm, force_sensor_N, scale_position_m and power_W";
    const auto& at = setting.lists[given(setting, 0)];
    if (auto wrong = problem_of_table(at, setting.values[0]); !wrong.empty()) return wrong;
    if (setting.lists[given(setting, channels_from)].size() != at.size())
      return "what is added must have one number for each point";
    return {};
  }

  void reset(double position_m) noexcept override { position_m_ = position_m, velocity_m_per_s_ = time_s_ = 0.0; }
  void tick(const TickStart& start) noexcept override { time_s_ = start.time_s + start.tick_s; }
  [[nodiscard]] double power_W(const TickPower& power) noexcept override {
    return power.power_W + (adds_to_ == to_power ? table(power.power_W) : 0.0);
  }
  void show(AxisSignals& signals) noexcept override {
    position_m_ = signals.position_m, velocity_m_per_s_ = signals.velocity_m_per_s;
    if (adds_to_ == to_scale) signals.scale_position_m += table(signals.scale_position_m);
  }
  void show_forces(ForceSignals& forces) const noexcept override {
    if (adds_to_ == to_torque_sensor) forces.torque_sensor_Nm += table(forces.torque_sensor_Nm);
    if (adds_to_ == to_force_sensor) forces.force_sensor_N += table(forces.force_sensor_N);
  }

 private:
  static constexpr std::size_t channels_from = 4;  // lists of points before them
  enum Adds : std::size_t { to_torque_sensor, to_force_sensor, to_scale, to_power };

  static std::size_t count(const EffectSetting& setting, std::size_t from) {
    const auto first = setting.lists.begin() + static_cast<std::ptrdiff_t>(from);
    return static_cast<std::size_t>(
        std::count_if(first, first + channels_from, [](const auto& list) { return !list.empty(); }));
  }
  static std::size_t given(const EffectSetting& setting, std::size_t from) {
    const auto first = setting.lists.begin() + static_cast<std::ptrdiff_t>(from);
    return static_cast<std::size_t>(
        std::find_if(first, setting.lists.end(), [](const auto& list) { return !list.empty(); }) - setting.lists.begin());
  }
  [[nodiscard]] double table(double reading) const noexcept {
    const std::array where{position_m_, velocity_m_per_s_, reading, time_s_};
    return on_line(added_, place_in(at_, where[over_], period_));
  }

  std::size_t over_, adds_to_;
  double period_;
  std::vector<double> at_, added_;
  double position_m_ = 0.0, velocity_m_per_s_ = 0.0, time_s_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array learned_reading_parameters{
    EffectParameter{"period", "1", 0.0, 1000000.0, 0.0, {}, "in the points' unit: the table comes over and over; 0: it does not"},
    EffectParameter{"position_m", "m", -100.0, 100.0, {}, {}, "points of the table: positions, ascending", true},
    EffectParameter{"velocity_m_per_s", "m/s", -10.0, 10.0, {}, {}, "points of the table: velocities, ascending", true},
    EffectParameter{"reading", "1", -1000000.0, 1000000.0, {}, {}, "points of the table: true values in the channel's unit, ascending", true},
    EffectParameter{"time_s", "s", 0.0, 1000000.0, {}, {}, "points of the table: time since the run's start, ascending", true},
    EffectParameter{"torque_sensor_Nm", "N m", -10000.0, 10000.0, {}, {}, "what the torque sensor shows more at each point", true},
    EffectParameter{"force_sensor_N", "N", -100000.0, 100000.0, {}, {}, "what the force sensor shows more at each point", true},
    EffectParameter{"scale_position_m", "m", -0.1, 0.1, {}, {}, "what the linear scale shows more at each point", true},
    EffectParameter{"power_W", "W", -100000.0, 100000.0, {}, {}, "what the drive draws more at each point", true},
};
// clang-format on

inline constexpr EffectEntry learned_reading{
    .id = "learned_reading",
    .component = EffectComponent::sensors,
    .work = EffectWork::none,
    .meaning = "a channel shows what the axis does not do, learned where no known effect explains the recording",
    .channels = "torque_sensor_Nm force_sensor_N scale_position_m power_W",
    .confused_with = "sensor_gain channel_skew",
    .exciting_move = "the move of the recording that showed it",
    .parameters = learned_reading_parameters,
    .make = make_effect<LearnedReading>,
    .hooks = hooks_of<LearnedReading>(),
    .problem = LearnedReading::problem,
};

}  // namespace feedtwin::plant::effects
