// Friction that rises with the load on the nut: F_C and F_S times 1 + c |F| / F_C, F = M_L a + what else loads the
// table, with the guide's friction or without.

#include <cmath>

#include "plant/steady_friction.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto& coulomb = view.ball_screw().coulomb_N;
  const Contribution none, &loads = view.on_table() != nullptr ? *view.on_table() : none;
  const double mass_kg = view.axis().guide_mass_kg + loads.table_mass_kg;
  Vector factor = Vector::Ones(track.size);
  for (Index k = 1; k < track.size; ++k) {  // from the smoothed motion: its noise would be rectified
    const double change = track.table_velocity_m_per_s[k] - track.table_velocity_m_per_s[k - 1];
    const double load_N = loads.guide_N.size() > 0 ? loads.guide_N[k] : 0.0;
    const double guide_N =
        q[1] > 0.0 ? q[1] * plant::steady_force_N(view.axis().guide, track.table_velocity_m_per_s[k]) : 0.0;
    const double nut_N = std::abs(mass_kg * change / track.sample_s + load_N + guide_N);
    factor[k] += q[0] * nut_N / (track.velocity_m_per_s[k] > 0.0 ? coulomb.pos : coulomb.neg);
  }
  scale(sum.screw_sliding, factor);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"friction_per_load", q[0]}, {"guide_friction_share", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis load_dependent_friction() {
  return {.id = "load_dependent_friction",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::time,
          .parameters = {{"friction_per_load", Kind::amplitude, 1e-2, 0.0, 0.5}, {"guide_friction_share", Kind::fixed}},
          .shapes = {{0.0}, {1.0}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw's friction rises by {friction_per_load} N for each newton on the nut",
          .least_missed_nats = 100.0,  // true ones 166 and more; beside a delay a false one 64
          .law_error = 0.06,
          .confused_with = {"torque_gain_error"},
          .friction = true,
          .by_load = true};
}

}  // namespace feedtwin::tools::diagnosis
