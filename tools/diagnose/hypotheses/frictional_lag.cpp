// Frictional lag: T du/dt = |v| - u, with g(u) and mu u in place of g(|v|) and mu |v|; or, of the screw alone,
// T du/dt = v - u, through zero at a reversal.

#include <cmath>

#include "plant/steady_friction.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// What follows the motion late: its mean over each sample.
/// @param followed of a velocity
template <typename Followed>
Vector late(const Track& track, double time_constant_s, const Followed& followed) {
  const double kept = time_constant_s > 1e-9 ? std::exp(-track.sample_s / time_constant_s) : 0.0;
  Vector mean(track.size);
  double film = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const double now = followed(track.velocity_m_per_s[k]);
    mean[k] = now + (film - now) * time_constant_s / track.sample_s * (1.0 - kept);
    film = now + (film - now) * kept;
  }
  return mean;
}

/// g of the film in place of that of the speed.
Vector sliding(const Track& track, const plant::LugreParameters& screw, const Vector& film) {
  Vector factor(track.size);
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.velocity_m_per_s[k];
    const bool forth = v > 0.0;
    factor[k] =
        plant::stribeck_force_N(screw, forth, std::abs(film[k])) / plant::stribeck_force_N(screw, forth, std::abs(v));
  }
  return factor;
}

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto& screw = view.ball_screw();
  const auto& guide = view.axis().guide;
  constexpr double small_m_per_s = 1e-4;
  const Vector film = late(track, q[0], [](double v) { return std::abs(v); });
  Vector screw_N(track.size), guide_N(track.size);
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.velocity_m_per_s[k], speed = std::abs(v);
    const bool forth = v > 0.0;
    const double behind = (forth ? 1.0 : -1.0) * (film[k] - speed) * speed / (speed + small_m_per_s);
    screw_N[k] = (forth ? screw.viscous_Ns_per_m.pos : screw.viscous_Ns_per_m.neg) * behind;
    guide_N[k] = (forth ? guide.viscous_Ns_per_m.pos : guide.viscous_Ns_per_m.neg) * behind;
  }
  scale(sum.screw_sliding, sliding(track, screw, film));
  add(sum.screw_N, about_sample(screw_N));
  add(sum.guide_N, about_sample(guide_N));
}

/// The ball screw's, of the velocity.
void apply_of_velocity(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const auto& screw = view.ball_screw();
  const auto viscous_N = [&](double v) { return (v < 0.0 ? screw.viscous_Ns_per_m.neg : screw.viscous_Ns_per_m.pos) * v; };
  const Vector film = late(track, q[0], [](double v) { return v; });
  Vector screw_N(track.size);
  for (Index k = 0; k < track.size; ++k) screw_N[k] = viscous_N(film[k]) - viscous_N(track.velocity_m_per_s[k]);
  scale(sum.screw_sliding, sliding(track, screw, film));
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
