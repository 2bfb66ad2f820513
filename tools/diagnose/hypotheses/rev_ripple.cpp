// Ball-pass or once-a-revolution ripple of the screw: F = A sin(n theta + phase), n rarely whole; theta counts from where
// the run began, and balls creep against the screw, so each run has a phase of its own.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const auto line = line_of_run(q, view.track.run);
  if (line == 0.0) return;
  add(sum.screw_N, wave(view.track.position_m, view.transmission().lead_m, rate_of_line(q), line.real(), line.imag()));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_N", line_amplitude(q)}, {"cycles_per_rev", rate_of_line(q)}};
}

/// A whole number above two is the motor's: poles and slots.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
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

}  // namespace feedtwin::tools::diagnosis
