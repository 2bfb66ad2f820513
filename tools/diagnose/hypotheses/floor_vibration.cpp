// The floor or the base shakes the table at one frequency, with a phase of its own in every run.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add_line(view.track, q, sum.guide_N);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& axis) {
  return {{"acceleration_m_per_s2", line_amplitude(q) / axis.guide_mass_kg}, {"frequency_Hz", rate_of_line(q)}};
}

/// Floors shake at 10 to 40 Hz; teeth seldom pass as slowly as this.
bool slower_than_teeth(std::span<const double> q) {
  return rate_of_line(q) < 30.0;
}

}  // namespace

Hypothesis floor_vibration() {
  return {.id = "floor_vibration",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::frequency,
          .parameters = line_parameters({"frequency_Hz", Kind::shape, 1e-3, 2.0, 45.0}),
          .shapes = frequencies(8.0, 40.0),
          .apply = apply,
          .named = named,
          .sentence = "the floor shakes the table with {acceleration_m_per_s2} m/s^2 at {frequency_Hz} Hz",

          .law_error = 0.03,
          .confused_with = {"process_force"},
          .always_beside = "process_force",
          .far_from_beside = slower_than_teeth,
          .line_of = line_of_run,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
