// The floor or the base shakes the table at one frequency, with a phase of its own in every run.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const std::size_t run = std::min<std::size_t>(view.track.run, 3);
  if (q[2 * run] == 0.0 && q[2 * run + 1] == 0.0) return;
  const Vector t = Vector::LinSpaced(view.track.size, 0.0, static_cast<double>(view.track.size - 1) * view.track.sample_s);
  add(sum.guide_N, wave(t, 1.0, q[8], q[2 * run], q[2 * run + 1]));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& axis) {
  double square = 0.0;
  for (std::size_t i = 0; i < 8; ++i) square += q[i] * q[i];
  return {{"acceleration_m_per_s2", std::sqrt(square / 3.0) / axis.guide_mass_kg}, {"frequency_Hz", q[8]}};
}

}  // namespace

Hypothesis floor_vibration() {
  return {.id = "floor_vibration",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::frequency,
          .parameters = {{"sine_0_N", Kind::amplitude, 0.1},
                         {"cosine_0_N", Kind::amplitude, 0.1},
                         {"sine_1_N", Kind::amplitude, 0.1},
                         {"cosine_1_N", Kind::amplitude, 0.1},
                         {"sine_2_N", Kind::amplitude, 0.1},
                         {"cosine_2_N", Kind::amplitude, 0.1},
                         {"sine_3_N", Kind::amplitude, 0.1},
                         {"cosine_3_N", Kind::amplitude, 0.1},
                         {"frequency_Hz", Kind::shape, 1e-3, 2.0, 90.0}},
          .shapes = frequencies(),
          .apply = apply,
          .named = named,
          .sentence = "the floor shakes the table with {acceleration_m_per_s2} m/s^2 at {frequency_Hz} Hz",

          .confused_with = {"process_force"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
