// Frictional lag: T du/dt = |v| - u, with g(u) and mu u in place of g(|v|) and mu |v|; or, of the screw alone,
// T du/dt = v - u, through zero at a reversal.

#include <cmath>

#include "plant/steady_friction.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto& screw = view.ball_screw();
  const auto& guide = view.axis().guide;
  constexpr double small_m_per_s = 1e-4;
  const double kept = q[0] > 1e-9 ? std::exp(-track.sample_s / q[0]) : 0.0;
  Vector factor = Vector::Ones(track.size), screw_N(track.size), guide_N(track.size);
  double film = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.velocity_m_per_s[k], speed = std::abs(v);
    const bool forth = v > 0.0;
    const double mean = speed + (film - speed) * q[0] / track.sample_s * (1.0 - kept);  // over the sample
    film = speed + (film - speed) * kept;
    factor[k] = plant::stribeck_force_N(screw, forth, mean) / plant::stribeck_force_N(screw, forth, speed);
    const double late = (forth ? 1.0 : -1.0) * (mean - speed) * speed / (speed + small_m_per_s);
    screw_N[k] = (forth ? screw.viscous_Ns_per_m.pos : screw.viscous_Ns_per_m.neg) * late;
    guide_N[k] = (forth ? guide.viscous_Ns_per_m.pos : guide.viscous_Ns_per_m.neg) * late;
  }
  scale(sum.screw_sliding, factor);
  add(sum.screw_N, about_sample(screw_N));
  add(sum.guide_N, about_sample(guide_N));
}

/// The ball screw's, of the velocity.
void apply_of_velocity(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto& screw = view.ball_screw();
  const auto viscous_N = [&](double v) { return (v < 0.0 ? screw.viscous_Ns_per_m.neg : screw.viscous_Ns_per_m.pos) * v; };
  const double kept = q[0] > 1e-9 ? std::exp(-track.sample_s / q[0]) : 0.0;
  Vector factor = Vector::Ones(track.size), screw_N(track.size);
  double film = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.velocity_m_per_s[k];
    const double mean = v + (film - v) * q[0] / track.sample_s * (1.0 - kept);  // over the sample
    film = v + (film - v) * kept;
    factor[k] =
        plant::stribeck_force_N(screw, v > 0.0, std::abs(mean)) / plant::stribeck_force_N(screw, v > 0.0, std::abs(v));
    screw_N[k] = viscous_N(mean) - viscous_N(v);
  }
  scale(sum.screw_sliding, factor);
  add(sum.screw_N, about_sample(screw_N));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"time_constant_s", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 8e-4;
}

}  // namespace

Hypothesis frictional_lag() {
  return {
      .id = "frictional_lag",
      .component = "ball_screw",
      .channel = "torque_cmd_Nm",
      .where = Where::time,
      .parameters = {{"time_constant_s", Kind::amplitude, 1e-3, 0.0, 0.2}},
      .shapes = {{}},
      .apply = apply,
      .named = named,
      .admissible = possible,
      .sentence = "friction follows speed with a lag of {time_constant_s} s",

      // true ones were missed by 6018 and more, false ones of three hands, beside friction of slip elements, by up to 1131
      .least_missed_nats = 1200.0,
      .least_deviations = deviations_of_lags,
      .confused_with = {"input_delay", "current_loop_lag"},
      .reaches = {1.0, 10.0},
      .friction = true,
      .forces_too = true};
}

/// A law of the same physics: what lags has a sign.
Hypothesis frictional_lag_of_velocity() {
  Hypothesis law = frictional_lag();
  law.id = "frictional_lag_of_velocity";
  law.told_as = "frictional_lag";
  law.apply = apply_of_velocity;
  law.sentence = "the screw's friction follows velocity, through zero at a reversal, with a lag of {time_constant_s} s";
  law.confused_with.emplace_back("frictional_lag");
  return law;
}

}  // namespace feedtwin::tools::diagnosis
