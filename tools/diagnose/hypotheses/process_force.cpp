// A process pushes the table at one frequency, with a phase of its own in every run: cutting, tooth by tooth. Where it cuts
// in a part of each run alone, what it pushes with in the mean shows too; otherwise that is a weight. Or it opposes the
// motion, teeth and all: then its line turns with the motion, which no floor's does.

#include <algorithm>
#include <cmath>

#include "plant/effects/process_force.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/windows.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t mean = 2 * line_runs + 1, opposing = mean + 1, ramp = opposing + 1, first_window = ramp + 1;

/// What it pushes with in the mean without teeth that pass is something else.
constexpr double least_of_mean = 0.1;

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const Windows cuts = windows_of_run(first_window, q, track.run);
  if (cuts.empty()) return add_line(track, q, sum.guide_N);
  Vector force_N =
      (q[mean] + q[opposing] * (track.centred_m_per_s.array() / plant::effects::process_turns_m_per_s).tanh()).matrix();
  add_line(track, q, force_N);
  add(sum.guide_N, force_N.cwiseProduct(covered(cuts, q[ramp], track.size, track.sample_s)));
}

constexpr std::size_t own_opposing = 2 * line_runs + 1, from = own_opposing + 1, to = from + 1, only_direction = to + 1;

/// Otherwise it acts along all of the travel.
bool has_place(std::span<const double> q) {
  return q[to] > q[from];
}

void apply_against_motion(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  Vector force_N = Vector::Constant(track.size, q[own_opposing]);
  add_line(track, q, force_N);
  const bool somewhere = has_place(q);
  for (Index k = 0; k < track.size; ++k) {
    const double sign = std::tanh(track.centred_m_per_s[k] / plant::effects::process_turns_m_per_s);
    force_N[k] *= (somewhere ? plant::effects::share_in_workpiece(track.table_position_m[k], q[from], q[to]) : 1.0) *
                  plant::effects::cutting(sign, q[only_direction]);
  }
  add(sum.guide_N, force_N);
}

std::vector<NamedValue> named_against_motion(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  std::vector<NamedValue> values{{"opposing_N", q[own_opposing]},
                                 {"amplitude_N", line_amplitude(q)},
                                 {"frequency_Hz", rate_of_line(q)},
                                 {"from_m", q[from]},
                                 {"to_m", q[to]}};
  if (q[only_direction] != 0.0) values.push_back({"only_direction", q[only_direction]});
  return values;
}

/// Along all of the travel a line that turns with the motion is the drive's: a real one's rectifier hums at 100 Hz with the
/// sign of its torque. And a tool does not pull: the teeth go with a mean that opposes the motion.
bool possible_against_motion(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  constexpr double least_of_amplitude = 0.5;
  const double amplitude_N = line_amplitude(q);
  return has_place(q) && amplitude_N > least_of_mean * q[own_opposing] && q[own_opposing] > least_of_amplitude * amplitude_N;
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

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
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

std::vector<WorkingParameter> parameters_against_motion() {
  auto all = line_parameters({"frequency_Hz", Kind::shape, 1e-3, 10.0, 450.0});
  all.push_back({"opposing_N", Kind::amplitude, 0.1, 0.0, 1e5});
  all.push_back({"from_m", Kind::shape, 2e-4});
  all.push_back({"to_m", Kind::shape, 2e-4});
  all.push_back({"only_direction", Kind::fixed});
  return all;
}

/// Along all of the travel; the screen adds, to the strongest, from where to where they act.
Grid along_the_travel() {
  Grid grid = frequencies(12.0, 400.0);
  for (auto& shape : grid) shape.insert(shape.end(), {0.0, 0.0, 0.0});
  return grid;
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

          .law_error = 0.01,
          .confused_with = {"floor_vibration"},
          .always_beside = "floor_vibration",
          .far_from_beside = faster_than_a_floor,
          .line_of = line_of_run,
          .first_window = first_window,
          .friction = false};
}

Hypothesis process_force_against_motion() {
  Hypothesis law = process_force();
  law.id = "process_force_against_motion";
  law.told_as = "process_force";
  law.parameters = parameters_against_motion();
  law.shapes = along_the_travel();
  law.apply = apply_against_motion;
  law.named = named_against_motion;
  law.admissible = possible_against_motion;
  law.sentence =
      "a process opposes the table's motion from {from_m} to {to_m} m, with {opposing_N} N, and {amplitude_N} N more and "
      "less "
      "at {frequency_Hz} Hz";
  law.confused_with = {};
  law.always_beside = {};
  law.far_from_beside = nullptr;
  law.first_window = 0;
  law.turns = true;
  return law;
}

}  // namespace feedtwin::tools::diagnosis
