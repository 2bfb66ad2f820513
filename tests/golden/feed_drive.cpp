#include "tests/golden/feed_drive.h"

#include <cmath>

namespace feedtwin::golden {
namespace {

struct Contact {
  double force_N, bristle_rate_m_per_s;
};

/// Eqs. 2 and 3; `speed` is |v| in the mode's direction.
Contact lugre(const Friction& f, double v, double speed, double z) {
  const double steady_N = f.coulomb_N + (f.static_N - f.coulomb_N) * std::exp(-speed / f.stribeck_m_per_s);
  const double rate = v - f.sigma0_N_per_m * speed / steady_N * z;
  return {f.sigma0_N_per_m * z + f.sigma1_Ns_per_m * rate + f.viscous_Ns_per_m * v, rate};
}

}  // namespace

double FeedDrive::radians_per_m() const {
  return 6.283185307179586 / lead_m;
}

double FeedDrive::mass_kg() const {
  const double k = radians_per_m();
  return (motor_inertia_kgm2 + screw_inertia_kgm2) * k * k + table_kg;
}

Mode mode_from_rest(const FeedDrive& drive, const State& y, double force_N) {
  const double net_N = force_N - drive.forward.screw.sigma0_N_per_m * y[screw_bristle] -
                       drive.forward.guide.sigma0_N_per_m * y[guide_bristle];
  if (net_N > drive.forward.motor_coulomb_N) return Mode::forward;
  return net_N < -drive.backward.motor_coulomb_N ? Mode::backward : Mode::stuck;
}

void derivative(const FeedDrive& drive, Mode mode, double force_N, const double* y, double* dy) {
  if (mode == Mode::stuck) {
    for (int i = 0; i < unknowns; ++i) dy[i] = 0.0;
    dy[electrical_loss] = drive.ke0_W;
    return;
  }
  const double sign = mode == Mode::forward ? 1.0 : -1.0;
  const Direction& d = mode == Mode::forward ? drive.forward : drive.backward;
  const double v = y[velocity];
  const double speed = sign * v;
  const double k = drive.radians_per_m();
  const Contact screw = lugre(d.screw, v, speed, y[screw_bristle]);
  const Contact guide = lugre(d.guide, v, speed, y[guide_bristle]);
  const double motor_N = sign * d.motor_coulomb_N + d.motor_damping_Nms * k * k * v;
  dy[position] = v;
  dy[velocity] = (force_N - motor_N - screw.force_N - guide.force_N) / drive.mass_kg();
  dy[screw_bristle] = screw.bristle_rate_m_per_s;
  dy[guide_bristle] = guide.bristle_rate_m_per_s;
  dy[motor_loss] = motor_N * v;
  dy[screw_work] = screw.force_N * v;
  dy[guide_work] = guide.force_N * v;
  dy[electrical_loss] = drive.ke0_W + d.ke1_Ws_per_m * speed + d.ke2_Ws2_per_m2 * v * v;
}

}  // namespace feedtwin::golden
