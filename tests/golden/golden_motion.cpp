#include "tests/golden/golden_motion.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::golden {
namespace {

constexpr double two_pi = 6.283185307179586;

/// 0 to 1 with two continuous derivatives.
double rise(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 - s * (15.0 - 6.0 * s));
}

}  // namespace

double golden_reference_m(double t) {
  if (t < 3.0) return 0.008 * rise(t) * rise(3.0 - t) * std::sin(4.0 * two_pi * t);
  if (t < 5.0) return 4e-5 * rise(0.5 * (t - 3.0));  // creep below 40 um/s
  if (t < 7.0) return 4e-5;                          // dwell, then swings in pre-sliding under golden_swing_N
  return 4e-5 + 0.026 * rise((t - 7.0) / 0.6) * (1.0 - std::cos(10.0 * (t - 7.0)));  // to 0.26 m/s
}

double golden_swing_N(double t) {
  if (t < 5.7 || t > 7.0) return 0.0;
  return 120.0 * rise(4.0 * (t - 5.7)) * rise(4.0 * (7.0 - t)) * std::sin(two_pi * 5.0 * (t - 5.7));
}

double GoldenController::force_N(int tick, double position_m) {
  const double t = tick * tick_s;
  const double reference_m = golden_reference_m(t);
  const double wanted_m_per_s = 60.0 * (reference_m - position_m) + (golden_reference_m(t + tick_s) - reference_m) / tick_s;
  const double error_m_per_s = wanted_m_per_s - (position_m - last_m_) / tick_s;
  last_m_ = position_m;
  integral_m_ += error_m_per_s * tick_s;
  return std::clamp(golden_swing_N(t) + 9000.0 * error_m_per_s + 2.0e5 * integral_m_, -2387.0, 2387.0);
}

}  // namespace feedtwin::golden
