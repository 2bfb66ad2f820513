// A process pushes the table at one frequency, with a phase of its own in every run: cutting, tooth by tooth. Where it cuts
// in a part of each run alone, what it pushes with in the mean shows too; otherwise that is a weight.

#include <algorithm>
#include <cmath>

#include "plant/effects/process_force.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/windows.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t mean = 2 * line_runs + 1, opposing = mean + 1, ramp = opposing + 1, first_window = ramp + 1;

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const Windows cuts = windows_of_run(first_window, q, track.run);
  if (cuts.empty()) return add_line(track, q, sum.guide_N);
  Vector force_N =
      (q[mean] + q[opposing] * (track.centred_m_per_s.array() / plant::effects::process_turns_m_per_s).tanh()).matrix();
  add_line(track, q, force_N);
  add(sum.guide_N, force_N.cwiseProduct(covered(cuts, q[ramp], track.size, track.sample_s)));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  std::vector<NamedValue> values{{"amplitude_N", line_amplitude(q)}, {"frequency_Hz", rate_of_line(q)}};
  if (windowed(first_window, q)) {
    values.push_back({"mean_N", q[mean]});
    values.push_back({"opposing_N", q[opposing]});
    values.push_back({"ramp_s", q[ramp]});
  }
  return values;
}

/// What it pushes with in the mean without teeth that pass is something else.
bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double least_of_mean = 0.1;
  return !windowed(first_window, q) || line_amplitude(q) > least_of_mean * std::hypot(q[mean], q[opposing]);
}

/// Than the 10 to 40 Hz of a floor.
bool faster_than_a_floor(std::span<const double> q) {
  return rate_of_line(q) > 45.0;
}

std::vector<WorkingParameter> parameters() {
  auto all = line_parameters({"frequency_Hz", Kind::shape, 1e-3, 35.0, 450.0});
  all.push_back({"mean_N", Kind::amplitude, 0.1});
  all.push_back({"opposing_N", Kind::amplitude, 0.1, 0.0, 1e5});
  all.push_back({"ramp_s", Kind::fixed});
  all.resize(first_window + window_parameters, {"edge_of_a_cut_s", Kind::fixed});
  return all;
}

/// In the whole of every run, as far as its rows show a line; the screen adds windows to the strongest.
Grid shapes() {
  Grid grid = frequencies(40.0, 400.0);
  for (auto& shape : grid) shape.resize(2 + window_parameters, 0.0);
  return grid;
}

}  // namespace

Hypothesis process_force() {
  return {.id = "process_force",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::frequency,
          .parameters = parameters(),
          .shapes = shapes(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "a process pushes the table with {amplitude_N} N at {frequency_Hz} Hz",

          .confused_with = {"floor_vibration"},
          .always_beside = "floor_vibration",
          .far_from_beside = faster_than_a_floor,
          .line_of = line_of_run,
          .first_window = first_window,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
