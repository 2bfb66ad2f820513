// Ball-pass or once-a-revolution ripple of the screw: F = A sin(n theta + phase), n rarely whole; theta counts from where
// the run began, and balls creep against the screw, so each run has a phase of its own.

#include <cmath>
#include <complex>

#include "plant/steady_friction.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

Vector wave_N(const View& view, std::span<const double> q, std::complex<double> line) {
  return wave(view.track.position_m, view.transmission().lead_m, rate_of_line(q), line.real(), line.imag());
}

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  if (const auto line = line_of_run(q, view.track.run); line != 0.0) add(sum.screw_N, wave_N(view, q, line));
}

/// Of the sliding friction, which near rest is the static one.
void apply_to_friction(const View& view, std::span<const double> q, Contribution& sum) {
  const auto line = line_of_run(q, view.track.run);
  if (line == 0.0) return;
  const auto& screw = view.ball_screw();
  Vector force_N = wave_N(view, q, line).cwiseProduct(view.track.motor_direction);
  for (Index k = 0; k < force_N.size(); ++k) {
    const double v = view.track.velocity_m_per_s[k], coulomb_N = v > 0.0 ? screw.coulomb_N.pos : screw.coulomb_N.neg;
    if (coulomb_N > 0.0) force_N[k] *= plant::stribeck_force_N(screw, v > 0.0, std::abs(v)) / coulomb_N;
  }
  add(sum.screw_N, force_N);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_N", line_amplitude(q)}, {"cycles_per_rev", rate_of_line(q)}};
}

/// A whole number above two is the motor's: poles and slots. Balls go round with the screw 0.4 times a turn and more: what
/// is slower is a matter of place.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  if (rate_of_line(q) < 0.4) return false;
  return rate_of_line(q) < 2.05 || std::abs(rate_of_line(q) - std::round(rate_of_line(q))) > 0.02;
}

}  // namespace

Hypothesis rev_ripple() {
  return {.id = "rev_ripple",
          .component = "ball_screw",
          .channel = "torque_cmd_Nm",
          .where = Where::order,
          .parameters = line_parameters({"cycles_per_rev", Kind::shape, 1e-3, 0.2, 40.0}),
          .shapes = ripple_orders(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the screw runs unevenly: {amplitude_N} N, {cycles_per_rev} times a revolution",

          .confused_with = {"cogging", "torque_ripple", "encoder_eccentricity"},
          .line_of = line_of_run,
          .friction = false};
}

/// Friction that varies so has the motion's sign.
Hypothesis rev_ripple_of_friction() {
  Hypothesis law = rev_ripple();
  law.id = "rev_ripple_of_friction";
  law.told_as = "rev_ripple";
  law.apply = apply_to_friction;
  law.sentence = "the screw's friction goes up and down by {amplitude_N} N, {cycles_per_rev} times a revolution";
  law.confused_with = {"rev_ripple", "position_friction"};
  law.least_missed_nats = 100.0;  // a drag that came and went at random was told so, and missed by 18
  return law;
}

}  // namespace feedtwin::tools::diagnosis
