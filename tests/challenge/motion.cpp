#include "tests/challenge/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/challenge/chance.h"

namespace feedtwin::challenge {
namespace {

double rise(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 - s * (15.0 - 6.0 * s));
}

/// Speeds in steps, to and fro, growing: +1 -1 -2 +2 +4 -4 ... each for half a second.
double stair_m(const MotionPlan& plan, double t) {
  constexpr std::array level = {1.0, 2.0, 4.0, 8.0, 15.0, 30.0, 50.0, 80.0, 110.0};
  constexpr double step_s = 0.5;
  double x = 0.0;
  for (int i = 0; i < 18 && t > 0.0; ++i, t -= step_s) {
    const double sign = ((i + 1) / 2) % 2 == 0 ? 1.0 : -1.0;
    x += sign * level[static_cast<std::size_t>(i / 2)] * plan.speed_m_per_s / 110.0 * std::min(t, step_s);
  }
  return x;
}

/// Short moves with dwells of growing length between.
double dwell_m(const MotionPlan& plan, double t) {
  constexpr std::array dwell_s = {0.1, 0.8, 0.2, 1.5, 0.1, 0.4, 0.8, 0.1};
  const double move_s = 1.9 * plan.amplitude_m / plan.speed_m_per_s;
  double x = 0.0;
  for (std::size_t i = 0; t > 0.0; ++i) {
    const double sign = (i / 2) % 2 == 0 ? 1.0 : -1.0;
    x += sign * plan.amplitude_m * rise(t / move_s);
    t -= move_s + dwell_s[i % dwell_s.size()];
  }
  return x;
}

}  // namespace

MotionPlan draw_motion(const std::string& kind, std::mt19937_64& random) {
  MotionPlan plan{
      .kind = kind, .duration_s = kind == "stair" ? 9.0 : 8.0, .frequency_Hz = {}, .share_m = {}, .phase_rad = {}};
  if (kind == "stair") plan.speed_m_per_s = uniform(random, 0.09, 0.125);
  if (kind == "sine") {
    plan.amplitude_m = uniform(random, 0.012, 0.03);
    plan.speed_m_per_s = uniform(random, 0.06, 0.11);
  }
  if (kind == "tri") {
    plan.amplitude_m = uniform(random, 0.01, 0.025);
    plan.speed_m_per_s = uniform(random, 0.018, 0.04);
  }
  if (kind == "dwell") {
    plan.amplitude_m = uniform(random, 0.003, 0.008);
    plan.speed_m_per_s = uniform(random, 0.015, 0.04);
  }
  if (kind == "multi") {
    const double reach_m = uniform(random, 0.7, 1.2);
    for (const double f : {0.27, 0.61, 1.13, 1.97, 3.1, 4.3}) {
      plan.frequency_Hz.push_back(f * uniform(random, 0.9, 1.1));
      plan.share_m.push_back(reach_m * 0.016 * std::pow(f / 0.27, -1.0) * uniform(random, 0.7, 1.3));
      plan.phase_rad.push_back(uniform(random, 0.0, two_pi));
    }
  }
  return plan;
}

double reference_m(const MotionPlan& plan, double t) {
  if (plan.kind == "stair") return stair_m(plan, t);
  if (plan.kind == "dwell") return dwell_m(plan, t);
  const double rate = plan.speed_m_per_s / plan.amplitude_m;
  if (plan.kind == "sine") return plan.amplitude_m * std::sin(rate * t);
  if (plan.kind == "tri") {
    const double u = rate * t / 4.0;  // one period a unit
    const double p = u - std::floor(u);
    return plan.amplitude_m * (p < 0.25 ? 4.0 * p : (p < 0.75 ? 2.0 - 4.0 * p : 4.0 * p - 4.0));
  }
  double x = 0.0;
  for (std::size_t i = 0; i < plan.share_m.size(); ++i)
    x += plan.share_m[i] * std::sin(two_pi * plan.frequency_Hz[i] * t + plan.phase_rad[i]);
  return x * rise(t / 0.5);
}

}  // namespace feedtwin::challenge
