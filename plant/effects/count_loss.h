#pragma once
// The encoder loses counts whenever its shaft passes a mark: dirt on the disc, a worn line.
//
//   each pass in the positive direction: shown -= n;   in the negative direction: shown -= n too where n is not returned
//
// n = counts_per_pass, once a revolution at angle_rad. With returned = 1 a pass back restores the count (a bad line of the
// disc), with 0 it does not (pulses lost on the way: the position walks off).

#include <array>
#include <cmath>
#include <cstdint>

#include "plant/effects/entry.h"
#include "plant/effects/wave.h"

namespace feedtwin::plant::effects {

class CountLoss final : public Effect {
 public:
  CountLoss(const EffectContext& context, const EffectSetting& setting)
      : counts_per_rev_(context.axis.axis.encoder_counts_per_rev),
        per_pass_(std::llround(setting.values[0])),
        mark_rev_(setting.values[1] / whole_turn_rad),
        returned_(setting.values[2] >= 0.5) {}

  void reset(double /*position_m*/) noexcept override {
    started_ = false;
    lost_ = 0;
  }
  [[nodiscard]] std::int64_t counts(std::int64_t counts) noexcept override {
    const auto turn = static_cast<std::int64_t>(std::floor(static_cast<double>(counts) / counts_per_rev_ - mark_rev_));
    if (!started_) turn_ = turn;
    started_ = true;
    const std::int64_t passes = turn - turn_;
    turn_ = turn;
    lost_ += per_pass_ * (returned_ || passes > 0 ? passes : -passes);
    return counts - lost_;
  }

 private:
  double counts_per_rev_;
  std::int64_t per_pass_;
  double mark_rev_;
  bool returned_;
  bool started_ = false;
  std::int64_t turn_ = 0, lost_ = 0;
};

// name, unit, lowest, highest, preset, neutral, meaning
// clang-format off: a line a parameter
inline constexpr std::array count_loss_parameters{
    EffectParameter{"counts_per_pass", "1", 0.0, 10000.0, {}, 0.0, "counts lost at a pass; whole"},
    EffectParameter{"angle_rad", "rad", -6.283185307179586, 6.283185307179586, 3.141592653589793, {}, "shaft angle of the mark"},
    EffectParameter{"returned", "1", 0.0, 1.0, 1.0, {}, "1: a pass back restores the count; 0 (below one half): it loses as many again"},
};
// clang-format on

inline constexpr EffectEntry count_loss{
    .id = "count_loss",
    .component = EffectComponent::sensors,
    .work = EffectWork::none,
    .meaning = "the encoder loses counts where its shaft passes a mark",
    .channels = "position_m torque_cmd_Nm",
    .confused_with = "lead_error encoder_eccentricity",
    .exciting_move = "many revolutions to and fro with a scale or an index pulse",
    .parameters = count_loss_parameters,
    .make = make_effect<CountLoss>,
    .hooks = hooks_of<CountLoss>(),
};

}  // namespace feedtwin::plant::effects
