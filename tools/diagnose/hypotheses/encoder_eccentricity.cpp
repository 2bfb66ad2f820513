// Eccentric encoder: it reads A sin(n theta + phase) beyond the shaft's travel; an oval one twice a revolution.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const Vector error = wave(track.position_m, view.transmission().lead_m, q[2], q[0], q[1]);
  Vector acceleration = Vector::Zero(track.size);  // that is not there
  const Index n = track.size;
  acceleration.segment(1, n - 2) =
      (error.tail(n - 2) - 2.0 * error.segment(1, n - 2) + error.head(n - 2)) / (track.sample_s * track.sample_s);
  const double k = per_lead(view.transmission());
  add(sum.slip_m, -error);
  add(sum.motor_N, -view.axis().motor.inertia_kgm2 * k * k * acceleration);
  add(sum.screw_N, -view.axis().ball_screw_inertia_kgm2 * k * k * acceleration);
  if (track.slip_m.size() == 0) add(sum.guide_N, -view.axis().guide_mass_kg * acceleration);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_m", std::hypot(q[0], q[1])}, {"cycles_per_rev", q[2]}, {"phase_rad", std::atan2(q[1], q[0])}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& axis) {
  return wavers_little(std::hypot(q[0], q[1]), q[2], axis.axis);
}

}  // namespace

Hypothesis encoder_eccentricity() {
  return {.id = "encoder_eccentricity",
          .component = "sensors",
          .channel = "position_m",
          .where = Where::order,
          .parameters = {{"sine_m", Kind::amplitude, 1e-7},
                         {"cosine_m", Kind::amplitude, 1e-7},
                         {"cycles_per_rev", Kind::fixed, 1.0, 1.0, 100.0}},
          .shapes = whole_orders(1, 2),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the encoder runs out of true: it reads {amplitude_m} m too far, {cycles_per_rev} times a revolution",

          .confused_with = {"cyclic_lead_error", "rev_ripple"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
