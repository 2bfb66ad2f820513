#include "controllers/motion.h"

#include <array>

#include "controllers/recorded.h"
#include "controllers/s_curve.h"
#include "controllers/sine.h"
#include "controllers/stair.h"
#include "controllers/triangle.h"

namespace feedtwin::controllers {

std::span<const MotionKind> motion_kinds() noexcept {
  static constexpr std::array kinds{
      MotionKind{"triangle", "to and fro at constant speed, with short ramps: the source's square velocity profile",
                 make_triangle},
      MotionKind{"sine", "sinusoidal velocity: the source's second motion", make_sine},
      MotionKind{"s_curve", "jerk-limited moves from end to end with dwells", make_s_curve},
      MotionKind{"stair", "out and back at one constant speed after another: for Stribeck and loss curves", make_stair},
      MotionKind{"recorded", "what a recording's axis was asked to do, or did", make_recorded, true},
  };
  return kinds;
}

}  // namespace feedtwin::controllers
