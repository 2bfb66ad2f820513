#pragma once
// The source's Eqs. 1-3 and 7-10 once more, written apart from plant/ and as differential equations only: what a general
// integrator is given, so that plant/ can be held against it. Table 2's numbers stand here a second time on purpose.

#include <array>

namespace feedtwin::golden {

/// Lugre contact in one direction of motion, and what does not depend on it.
struct Friction {
  double coulomb_N, static_N, stribeck_m_per_s, viscous_Ns_per_m, sigma0_N_per_m, sigma1_Ns_per_m;
};

/// Everything that one direction of motion has.
struct Direction {
  double motor_coulomb_N, motor_damping_Nms, ke1_Ws_per_m, ke2_Ws2_per_m2;
  Friction screw, guide;
};

struct FeedDrive {
  double lead_m = 0.005, motor_inertia_kgm2 = 4.0e-5, screw_inertia_kgm2 = 1.5e-5, table_kg = 4.0, ke0_W = 0.25;
  Direction forward{
      36.5, 4.8e-4, 2.1, 1370.0, {69.8, 82.0, 9.4e-4, 2.2e3, 5.08e7, 7706.0}, {5.2, 10.4, 2.7e-3, 59.8, 5.09e5, 1222.0}};
  Direction backward{
      16.2, 3.3e-4, 18.1, 1610.0, {64.6, 82.9, 7.5e-4, 2.0e3, 5.08e7, 7706.0}, {5.4, 9.1, 3.3e-3, 55.8, 5.09e5, 1222.0}};

  [[nodiscard]] double radians_per_m() const;
  [[nodiscard]] double mass_kg() const;
};

/// Unknowns: motion first, then the losses' integrals.
enum Unknown {
  position,
  velocity,
  screw_bristle,
  guide_bristle,
  motor_loss,
  screw_work,
  guide_work,
  electrical_loss,
  unknowns
};
inline constexpr int motion_unknowns = motor_loss;
using State = std::array<double, unknowns>;

/// How the axis moves: the motor's Coulomb friction is set-valued, so each mode has smooth equations of its own.
enum class Mode { stuck, forward, backward };

/// Mode out of rest under the constant force u: stuck where F_M can hold what drives it.
[[nodiscard]] Mode mode_from_rest(const FeedDrive& drive, const State& y, double force_N);

/// dy/dt in a mode. With the sign taken from the mode it is smooth across v = 0, as root finding wants.
void derivative(const FeedDrive& drive, Mode mode, double force_N, const double* y, double* dy);

}  // namespace feedtwin::golden
