#pragma once
// The components of an axis that energy is accounted by, under the names that every verb's JSON gives them.

#include <array>

#include "plant/energy.h"

namespace feedtwin::tools {

struct AxisComponent {
  const char* name;
  double plant::AxisEnergy::* joules;
};

inline constexpr std::array axis_components{
    AxisComponent{"motor_electrical", &plant::AxisEnergy::motor_electrical_J},
    AxisComponent{"motor_mechanical", &plant::AxisEnergy::motor_mechanical_J},
    AxisComponent{"ball_screw", &plant::AxisEnergy::ball_screw_J},
    AxisComponent{"guide", &plant::AxisEnergy::guide_J},
};

}  // namespace feedtwin::tools
