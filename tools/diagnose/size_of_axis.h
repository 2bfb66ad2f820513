#pragma once
// Forces that count, to name what makes them or to say that something makes them, were measured on axes whose contacts have
// 35 N of Coulomb friction and more. On a smaller axis a smaller force counts, in proportion.

#include "plant/parameters.h"

namespace feedtwin::tools::diagnosis {

/// What stands for a newton on this axis: 1, or as much less as its friction is below 30 N and so is the force that moves it
/// at 1 m/s^2.
[[nodiscard]] double newton_of(const plant::AxisParameters& axis);

}  // namespace feedtwin::tools::diagnosis
