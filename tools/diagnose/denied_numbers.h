#pragma once
// Recalibrated numbers that unseen runs deny: they fit the runs they were fitted to, and leave others farther off than the
// axis file's own.

#include "tools/diagnose/diagnosis.h"

namespace feedtwin::tools::diagnosis {

/// So many times as far off (geometric mean over the channels), and the file's numbers stay. Of 420 made machines with
/// nothing hidden two had more: 1.11, by right numbers, and 1.25, by one that was off.
inline constexpr double numbers_of_harm_ratio = 1.02;

/// So many times as far off on the whole, a channel beyond its noise twice as far: no chance bends numbers so, they stand
/// for what is none of the model. Of some 600 answers one had that: a drive with a dead zone, which friction in the motor
/// stood for while the axis moved (1.65 times, the torque sensor 2.5 times). Nothing hidden had more than 1.4 in a channel.
inline constexpr double bent_ratio = 1.4, bent_channel_ratio = 2.0, beyond_noise_ratio = 5.0;

/// @param result with its figures on runs that were not fitted, nothing named that rests on a force
[[nodiscard]] bool numbers_are_denied(const Diagnosis& result);
[[nodiscard]] bool numbers_stand_for_the_unknown(const Diagnosis& result);

/// The file's numbers in place of the recalibrated ones, which are told no more.
/// @param axis the file's, with what is named beside them
void take_the_files_numbers(Diagnosis& result, plant::AxisParameters axis);

/// After that: is nothing gained?
[[nodiscard]] bool still_denied(const Diagnosis& result);

/// Of a model's effects those that are named.
[[nodiscard]] Candidate only_told(Candidate model, const std::vector<NamedEffect>& named);

}  // namespace feedtwin::tools::diagnosis
