#pragma once
// One line of the effects' registry: all that a user, a file or a diagnosis needs to know of an effect.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "plant/effects/effect.h"
#include "plant/parameters.h"

namespace feedtwin::plant {

/// The component that an effect belongs to. Effects of guide and load act on the table, all others on motor and screw.
enum class EffectComponent : std::uint8_t { motor, drive, ball_screw, guide, load, power, sensors, set_up };
[[nodiscard]] std::string_view name_of(EffectComponent component) noexcept;

/// Where the work of an effect's force goes.
enum class EffectWork : std::uint8_t {
  none,             ///< no force of its own
  dissipates,       ///< never gives back more than it holds
  conserves,        ///< gives back all that it took
  alters_friction,  ///< of a contact: only together with the nominal friction does it dissipate
  exchanges,        ///< with the world outside
  motor_torque      ///< part of what the motor delivers
};

/// One number of an effect.
struct EffectParameter {
  std::string_view name;  ///< with its unit: "amplitude_Nm"
  std::string_view unit;  ///< "N m"; "1" for a ratio
  double lowest, highest;
  std::optional<double> preset;   ///< value where the key is missing; none: required
  std::optional<double> neutral;  ///< at this value of it the effect is gone; none: shapes the effect only
  std::string_view meaning;       ///< with its sign
  bool list = false;              ///< a list of numbers; may be missing, then empty
};

struct EffectEntry {
  std::string_view id;
  EffectComponent component;
  EffectWork work;
  std::string_view meaning;        ///< one line
  std::string_view channels;       ///< recording columns that it touches, blank-separated
  std::string_view confused_with;  ///< ids, blank-separated; may be empty
  std::string_view exciting_move;  ///< the motion that shows it best
  std::span<const EffectParameter> parameters;
  /// Changes the numbers of the axis at set-up, for effects that are such a number; may be null.
  void (*adapt)(AxisParameters& axis, const EffectSetting& setting) = nullptr;
  /// Makes what runs in the tick; null where adapt is all.
  std::unique_ptr<Effect> (*make)(const EffectContext& context, const EffectSetting& setting) = nullptr;
  EffectHooks hooks{};
  /// While the axis slides its force hardly changes along a tick, so that it asks for no sub-steps there.
  bool even_in_motion = false;
  /// Of what only scales friction: by a load that changes along a tick, so that it asks for them.
  bool uneven_in_motion = false;
  /// Acts on the contact that laws of friction change: at the table where that is the guide's.
  bool of_contact = false;
  /// What is wrong with a setting whose numbers are each in range; empty: nothing. May be null.
  std::string (*problem)(const EffectSetting& setting) = nullptr;
};

template <class E>
std::unique_ptr<Effect> make_effect(const EffectContext& context, const EffectSetting& setting) {
  return std::make_unique<E>(context, setting);
}

/// An inherited member's address has the base's type, an overriding one the effect's.
template <class E>
consteval EffectHooks hooks_of() {
  return {.join = !std::is_same_v<decltype(&E::join), decltype(&Effect::join)>,
          .tick = !std::is_same_v<decltype(&E::tick), decltype(&Effect::tick)>,
          .torque = !std::is_same_v<decltype(&E::torque_Nm), decltype(&Effect::torque_Nm)>,
          .take_torque = !std::is_same_v<decltype(&E::take_torque), decltype(&Effect::take_torque)>,
          .load = !std::is_same_v<decltype(&E::load), decltype(&Effect::load)>,
          .scale = !std::is_same_v<decltype(&E::scale), decltype(&Effect::scale)>,
          .advance = !std::is_same_v<decltype(&E::advance), decltype(&Effect::advance)>,
          .sense = !std::is_same_v<decltype(&E::sense), decltype(&Effect::sense)>,
          .counts = !std::is_same_v<decltype(&E::counts), decltype(&Effect::counts)>,
          .power = !std::is_same_v<decltype(&E::power_W), decltype(&Effect::power_W)>,
          .show = !std::is_same_v<decltype(&E::show), decltype(&Effect::show)>,
          .show_forces = !std::is_same_v<decltype(&E::show_forces), decltype(&Effect::show_forces)>,
          .take_forces = !std::is_same_v<decltype(&E::take_forces), decltype(&Effect::take_forces)>};
}

}  // namespace feedtwin::plant
