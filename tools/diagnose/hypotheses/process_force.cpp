// A process pushes the table at one frequency, with a phase of its own in every run: cutting, tooth by tooth.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add_line(view.track, q, sum.guide_N);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"amplitude_N", line_amplitude(q)}, {"frequency_Hz", q.back()}};
}

/// Than the 10 to 40 Hz of a floor.
bool faster_than_a_floor(std::span<const double> q) {
  return q.back() > 45.0;
}

}  // namespace

Hypothesis process_force() {
  return {.id = "process_force",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::frequency,
          .parameters = line_parameters({"frequency_Hz", Kind::shape, 1e-3, 35.0, 110.0}),
          .shapes = frequencies(40.0, 100.0),
          .apply = apply,
          .named = named,
          .sentence = "a process pushes the table with {amplitude_N} N at {frequency_Hz} Hz",

          .confused_with = {"floor_vibration"},
          .always_beside = "floor_vibration",
          .far_from_beside = faster_than_a_floor,
          .line_of = line_of_run,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
