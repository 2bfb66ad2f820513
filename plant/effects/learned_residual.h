#pragma once
// What no law of the catalogue explains: a force table over position, speed or time since the last reversal.
//
//   F = (f+ + f-) / 2 + zeta (f+ - f-) / 2,   d zeta/dx = (1 - zeta sgn v) / D,   -1 <= zeta <= 1
//
// f+ and f- are a force and a damping times the speed, read from the table on straight lines between its points (constant
// beyond the ends) for motion forth and back; zeta is the direction of motion, turned over the path D = 2 um after a
// reversal, so that at rest the axis is held, not pushed. Exactly one of position_m, velocity_m_per_s (speeds) and
// since_reversal_s is given; without force_neg_N the force is force_pos_N in both directions; without a damping there is
// none.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plant/effects/entry.h"
#include "plant/effects/table.h"

namespace feedtwin::plant::effects {

class LearnedResidual final : public Effect {
 public:
  LearnedResidual(const EffectContext& /*context*/, const EffectSetting& setting)
      : over_(!setting.lists[0].empty()   ? 0
              : !setting.lists[1].empty() ? 1
                                          : 2),
        at_(setting.lists[static_cast<std::size_t>(over_)]),
        pos_N_(setting.lists[3]),
        neg_N_(setting.lists[4].empty() ? setting.lists[3] : setting.lists[4]),
        pos_Ns_per_m_(setting.lists[5]),
        neg_Ns_per_m_(setting.lists[6]) {
    for (auto* damping : {&pos_Ns_per_m_, &neg_Ns_per_m_}) damping->resize(at_.size(), 0.0);
  }

  static std::string problem(const EffectSetting& setting) {
    const auto given =
        std::count_if(setting.lists.begin(), setting.lists.begin() + 3, [](const auto& l) { return !l.empty(); });
    if (given != 1) return "expected exactly one of position_m, velocity_m_per_s and since_reversal_s";
    const auto& at = *std::find_if(setting.lists.begin(), setting.lists.end(), [](const auto& l) { return !l.empty(); });
    if (auto wrong = problem_of_table(at); !wrong.empty()) return wrong;
    if (setting.lists[3].size() != at.size()) return "force_pos_N must have one number for each point";
    for (const auto& [list, name] :
         {std::pair{4, "force_neg_N"}, {5, "damping_pos_Ns_per_m"}, {6, "damping_neg_Ns_per_m"}}) {
      const std::size_t size = setting.lists[static_cast<std::size_t>(list)].size();
      if (size > 0 && size != at.size()) return std::string(name) + " must have one number for each point";
    }
    return {};
  }

  void reset(double /*position_m*/) noexcept override {
    direction_ = 0.0;
    since_s_ = 0.0;
    last_sign_ = 0.0;
  }

  [[nodiscard]] EffectLoad load(const EffectMotion& m) const noexcept override {
    const double where = over_ == 0   ? m.position_m + 0.5 * m.velocity_m_per_s * m.h_s
                         : over_ == 1 ? std::abs(m.velocity_m_per_s)
                                      : since_s_ + 0.5 * m.h_s;
    const TablePlace place = place_in(at_, where);
    const double speed = std::abs(m.velocity_m_per_s);
    const double forth_Ns_per_m = on_line(pos_Ns_per_m_, place), back_Ns_per_m = on_line(neg_Ns_per_m_, place);
    const double forth_N = on_line(pos_N_, place) + forth_Ns_per_m * speed;
    const double back_N = on_line(neg_N_, place) + back_Ns_per_m * speed;
    const double y = speed * m.h_s / turning_m;
    const double old_share = y > 1e-6 ? -std::expm1(-y) / y : 1.0 - 0.5 * y;
    const double turned = y > 0.0 ? m.sign + (direction_ - m.sign) * old_share : direction_;
    return {0.5 * (forth_N + back_N) + 0.5 * (forth_N - back_N) * turned, m.sign > 0.0 ? forth_Ns_per_m : -back_Ns_per_m};
  }

  void advance(const EffectMotion& m) noexcept override {
    since_s_ += m.h_s;
    if (m.velocity_m_per_s == 0.0) return;
    const double sign = m.velocity_m_per_s > 0.0 ? 1.0 : -1.0;
    if (sign != last_sign_) since_s_ = m.h_s;
    last_sign_ = sign;
    direction_ = sign + (direction_ - sign) * std::exp(-std::abs(m.velocity_m_per_s) * m.h_s / turning_m);
  }

 private:
  static constexpr double turning_m = 2e-6;

  int over_;
  std::vector<double> at_, pos_N_, neg_N_, pos_Ns_per_m_, neg_Ns_per_m_;
  double direction_ = 0.0, since_s_ = 0.0, last_sign_ = 0.0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array learned_residual_parameters{
    EffectParameter{"position_m", "m", -100.0, 100.0, {}, {}, "points of the table: table positions, ascending", true},
    EffectParameter{"velocity_m_per_s", "m/s", 0.0, 10.0, {}, {}, "points of the table: speeds, ascending", true},
    EffectParameter{"since_reversal_s", "s", 0.0, 10000.0, {}, {}, "points of the table: time since the last change of direction, ascending", true},
    EffectParameter{"force_pos_N", "N", -100000.0, 100000.0, {}, {}, "force at each point while moving forth; positive: acts against positive motion", true},
    EffectParameter{"force_neg_N", "N", -100000.0, 100000.0, {}, {}, "the same while moving back; missing: as forth", true},
    EffectParameter{"damping_pos_Ns_per_m", "N s/m", -100000.0, 100000.0, {}, {}, "force more at each point by speed while moving forth; missing: none", true},
    EffectParameter{"damping_neg_Ns_per_m", "N s/m", -100000.0, 100000.0, {}, {}, "the same while moving back", true},
};
// clang-format on

inline constexpr EffectEntry learned_residual{
    .id = "learned_residual",
    .component = EffectComponent::ball_screw,
    .work = EffectWork::exchanges,
    .meaning = "a force that no known effect explains, learned where it acts",
    .channels = "torque_cmd_Nm position_m power_W torque_sensor_Nm",
    .confused_with = "",
    .exciting_move = "the move of the recording that showed it",
    .parameters = learned_residual_parameters,
    .make = make_effect<LearnedResidual>,
    .hooks = hooks_of<LearnedResidual>(),
    .problem = LearnedResidual::problem,
};

}  // namespace feedtwin::plant::effects
