#pragma once
// An axis whose friction is viscous alone, and an independent integration of such an axis in steps of a microsecond: what
// dynamic effects are compared with. No code is shared with the plant.

#include <functional>

#include "plant/parameter_table.h"

namespace feedtwin::test {

/// The source's axis with Coulomb friction of a micronewton and bristles that hold nothing.
inline plant::AxisParameters smooth_axis() {
  plant::AxisParameters p = plant::source_axis();
  p.motor.coulomb_N = {0.0, 0.0};
  p.motor.damping_Nms = {1e-4, 1e-4};
  for (auto* friction : {&p.ball_screw, &p.guide}) {
    friction->coulomb_N = friction->static_N = {1e-6, 1e-6};
    friction->stiffness_N_per_m = 1e3;
    friction->damping_Ns_per_m = 0.0;
    friction->viscous_Ns_per_m = {400.0, 400.0};
  }
  return p;
}

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double rad_per_m = 2.0 * pi / 0.005;
inline constexpr double screw_mass_kg = (4.0e-5 + 1.5e-5) * rad_per_m * rad_per_m;
inline constexpr double table_mass_kg = 4.0;
inline constexpr double screw_viscous_Ns_per_m = 400.0 + 1e-4 * rad_per_m * rad_per_m;
inline constexpr double guide_viscous_Ns_per_m = 400.0;

/// One body: M dv/dt = motor(t) - B v - load(t, x, v), by Runge and Kutta's classical rule.
struct ReferenceBody {
  double x = 0.0, v = 0.0, t = 0.0;

  void run(double duration_s, const std::function<double(double)>& motor_N,
           const std::function<double(double, double, double)>& load_N) {
    constexpr double h = 1e-6;
    constexpr double mass = screw_mass_kg + table_mass_kg;
    constexpr double viscous = screw_viscous_Ns_per_m + guide_viscous_Ns_per_m;
    const auto rate = [&](double at_t, double at_x, double at_v) {
      return (motor_N(at_t) - viscous * at_v - load_N(at_t, at_x, at_v)) / mass;
    };
    const auto steps = static_cast<long>(duration_s / h + 0.5);
    for (long i = 0; i < steps; ++i) {
      const double a1 = rate(t, x, v);
      const double v2 = v + 0.5 * h * a1;
      const double a2 = rate(t + 0.5 * h, x + 0.5 * h * v, v2);
      const double v3 = v + 0.5 * h * a2;
      const double a3 = rate(t + 0.5 * h, x + 0.5 * h * v2, v3);
      const double v4 = v + h * a3;
      const double a4 = rate(t + h, x + h * v3, v4);
      x += h * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0;
      v += h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0;
      t += h;
    }
  }
};

}  // namespace feedtwin::test
