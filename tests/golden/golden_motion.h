#pragma once
// Ten seconds of closed-loop motion that show everything an integrator can get wrong: reversals, creep, dwell and small
// swings in pre-sliding, speeds to 0.26 m/s. It starts at rest and its acceleration never jumps. The position loop takes the
// unquantised position: a quantised one would drive any two right integrators apart by its own flipped counts.

#include "tests/support/tick.h"

namespace feedtwin::golden {

using test::tick_s;
inline constexpr int golden_ticks = 10000;

[[nodiscard]] double golden_reference_m(double time_s);
/// Added to the controller's force: swings within pre-sliding and the motor's Coulomb friction during the dwell.
[[nodiscard]] double golden_swing_N(double time_s);

/// The force at the table that a P-PI controller asks for; limited to the motor's 1.9 N m.
class GoldenController {
 public:
  [[nodiscard]] double force_N(int tick, double position_m);

 private:
  double last_m_ = 0.0, integral_m_ = 0.0;
};

}  // namespace feedtwin::golden
