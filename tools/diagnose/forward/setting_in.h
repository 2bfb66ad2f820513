#pragma once
// How the motor's friction sets in: at once, as in the source's Eq. 1, or over a path after each reversal. No sensor shows
// the motor's friction alone, so the other numbers are bent to what it does about rests: the motor's share of the friction,
// gains of the sensors. So it is asked before any name is judged in closed loop.

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {

/// Asked of the numbers alone, before any name: what the motor does while the axis rests can bend all numbers, and gains
/// with them, so far that no name's fit finds the way back.
/// @return the nominal axis's effects; with the motor's path where the inverse model fits it far better, and the closed loop
///         finds the runs surely likelier if it has to be asked
[[nodiscard]] std::vector<plant::EffectSetting> motor_as_it_sets_in(const ForwardModel& forward, const Fitter& fitter,
                                                                    const std::function<void(std::string_view)>& progress);

/// Gives the model a motor whose friction sets in over a path, where in closed loop the runs are surely likelier with it.
/// Asked where a torque sensor shows what is left behind the motor.
/// @param settled the fit's model as the closed loop has it, where it was asked
/// @return the same with it, where it is taken; else `settled`
std::optional<Ruling> ask_how_motor_sets_in(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                                            std::optional<Ruling> settled,
                                            const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
