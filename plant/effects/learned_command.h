#pragma once
// The drive makes another torque of some commands than it is told to - steps of its converter, a missing code - where no
// known effect explains it: a table learned from a recording.
//
//   T = u + table(u),   over and over where it has a period

#include <array>
#include <string>
#include <vector>

#include "plant/effects/entry.h"
#include "plant/effects/table.h"

namespace feedtwin::plant::effects {

class LearnedCommand final : public Effect {
 public:
  LearnedCommand(const EffectContext& /*context*/, const EffectSetting& setting)
      : period_Nm_(setting.values[0]), at_Nm_(setting.lists[0]), added_Nm_(setting.lists[1]) {}

  static std::string problem(const EffectSetting& setting) {
    if (setting.lists[0].empty()) return "expected torque_cmd_Nm";
    if (auto wrong = problem_of_table(setting.lists[0], setting.values[0]); !wrong.empty()) return wrong;
    if (setting.lists[1].size() != setting.lists[0].size()) return "torque_Nm must have one number for each point";
    return {};
  }

  [[nodiscard]] double torque_Nm(double torque_Nm, const TickStart& /*start*/) const noexcept override {
    return torque_Nm + on_line(added_Nm_, place_in(at_Nm_, torque_Nm, period_Nm_));
  }

 private:
  double period_Nm_;
  std::vector<double> at_Nm_, added_Nm_;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array learned_command_parameters{
    EffectParameter{"period_Nm", "N m", 0.0, 10000.0, 0.0, {}, "the table comes over and over; 0: it does not"},
    EffectParameter{"torque_cmd_Nm", "N m", -10000.0, 10000.0, {}, {}, "points of the table: torque commands, ascending", true},
    EffectParameter{"torque_Nm", "N m", -10000.0, 10000.0, {}, {}, "what the drive makes more of it at each point", true},
};
// clang-format on

inline constexpr EffectEntry learned_command{
    .id = "learned_command",
    .component = EffectComponent::drive,
    .work = EffectWork::none,
    .meaning = "the drive makes another torque of some commands, learned where no known effect explains the recording",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "torque_gain_error torque_offset torque_saturation",
    .exciting_move = "the move of the recording that showed it",
    .parameters = learned_command_parameters,
    .make = make_effect<LearnedCommand>,
    .hooks = hooks_of<LearnedCommand>(),
    .problem = LearnedCommand::problem,
};

}  // namespace feedtwin::plant::effects
