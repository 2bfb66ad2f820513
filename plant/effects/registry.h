#pragma once
// The explicit table of effects. A new one is a file beside this one and a line in registry.cpp.

#include <span>
#include <string_view>

#include "plant/effects/entry.h"

namespace feedtwin::plant {

/// In signal-flow order (command, drive, motor, screw, guide, load, sensors): the order in which effects are applied.
[[nodiscard]] std::span<const EffectEntry> effect_registry() noexcept;

/// The entry of an id, or nullptr.
[[nodiscard]] const EffectEntry* find_effect(std::string_view id) noexcept;

/// A setting with every parameter at its preset, or where it has none at its neutral value or lowest.
[[nodiscard]] EffectSetting preset_of(const EffectEntry& entry);

/// The value of a scalar parameter in a setting of this entry; nullptr for a name that it does not have.
[[nodiscard]] double* value_in(EffectSetting& setting, const EffectEntry& entry, std::string_view parameter) noexcept;

}  // namespace feedtwin::plant
