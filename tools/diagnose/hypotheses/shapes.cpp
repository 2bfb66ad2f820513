#include "tools/diagnose/hypotheses/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedtwin::tools::diagnosis {

namespace {

/// Sine and cosine along a path.
struct Circle {
  Vector x;
  double turn = 0.0;
  Eigen::ArrayXd sine, cosine;
};

/// Columns of a Jacobian ask for the same ones over and over, and they were a quarter of the time of a search beside a
/// ripple: the last few are kept. Compared by value, since another run may come to lie where one was.
const Circle& circle_of(const Vector& x, double turn) {
  thread_local std::array<Circle, 12> kept;
  thread_local std::size_t oldest = 0;
  for (const auto& circle : kept)
    if (circle.turn == turn && circle.x.size() == x.size() && circle.x == x) return circle;
  Circle& circle = kept[oldest];
  oldest = (oldest + 1) % kept.size();
  circle = {x, turn, Eigen::ArrayXd(x.size()), Eigen::ArrayXd(x.size())};
  for (Index k = 0; k < x.size(); ++k) {  // both of one angle at once
    const double angle = turn * x[k];
    circle.sine[k] = std::sin(angle);
    circle.cosine[k] = std::cos(angle);
  }
  return circle;
}

}  // namespace

Vector wave(const Vector& x, double period, double order, double sine, double cosine) {
  const Circle& circle = circle_of(x, 2.0 * std::numbers::pi * order / period);
  Vector out = Vector::Zero(x.size());
  if (sine != 0.0) out += (sine * circle.sine).matrix();
  if (cosine != 0.0) out += (cosine * circle.cosine).matrix();
  return out;
}

Vector force_on_table(const View& view) {
  const Track& track = view.track;
  if (track.force_sensor_N.size() > 0) return track.force_sensor_N;
  return view.base().guide_N + view.axis().guide_mass_kg * track.table_acceleration_m_per_s2;
}

Vector delayed(const Vector& values, double samples) {
  Vector out(values.size());
  const double last = static_cast<double>(values.size() - 1);
  for (Index k = 0; k < values.size(); ++k) {
    const double at = std::clamp(static_cast<double>(k) - samples, 0.0, last);
    const auto before = static_cast<Index>(at);
    const Index after = std::min(before + 1, values.size() - 1);
    out[k] = values[before] + (at - static_cast<double>(before)) * (values[after] - values[before]);
  }
  return out;
}

Vector lagged(const Vector& values, double samples) {
  if (samples < 1e-6) return values;
  const double keep = std::exp(-1.0 / samples);
  Vector out(values.size());
  double at = values[0];
  for (Index k = 0; k < values.size(); ++k) {
    out[k] = values[k] + (at - values[k]) * samples * (1.0 - keep);
    at = values[k] + (at - values[k]) * keep;
  }
  return out;
}

Grid whole_orders(int first, int last) {
  Grid grid;
  for (int order = first; order <= last; ++order) grid.push_back({static_cast<double>(order)});
  return grid;
}

Grid ripple_orders() {
  Grid grid;
  for (int i = 20; i <= 400; ++i) {
    const double order = 0.025 * i;
    if (order <= 2.0 || std::abs(order - std::round(order)) > 0.04) grid.push_back({order});
  }
  return grid;
}

Grid frequencies(double low_Hz, double high_Hz) {
  Grid grid;
  for (int i = 0; low_Hz + 0.1 * i <= high_Hz + 1e-9; ++i) grid.push_back({low_Hz + 0.1 * i});
  return grid;
}

bool late_beyond_a_model(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 1e-4;
}

bool gone_within_a_sample(std::span<const double> q, double sample_s) {
  return q[0] < 0.2 * sample_s;
}

std::vector<WorkingParameter> line_parameters(const WorkingParameter& often) {
  return {{"sine_0_N", Kind::amplitude, 0.1},   {"cosine_0_N", Kind::amplitude, 0.1}, {"sine_1_N", Kind::amplitude, 0.1},
          {"cosine_1_N", Kind::amplitude, 0.1}, {"sine_2_N", Kind::amplitude, 0.1},   {"cosine_2_N", Kind::amplitude, 0.1},
          {"sine_3_N", Kind::amplitude, 0.1},   {"cosine_3_N", Kind::amplitude, 0.1}, often};
}

void add_line(const Track& track, std::span<const double> q, Vector& force_N) {
  const std::size_t run = std::min<std::size_t>(track.run, line_runs - 1);
  if (q[2 * run] == 0.0 && q[2 * run + 1] == 0.0) return;
  constexpr Index renewed = 256;  // each turn from the one before it, so that there is no sine a sample
  const double per_sample = 2.0 * std::numbers::pi * rate_of_line(q) * track.sample_s;
  const std::complex<double> turn = std::polar(1.0, per_sample), line = line_of_run(q, run);
  std::complex<double> now;
  Vector more(track.size);
  for (Index k = 0; k < track.size; ++k) {
    now = k % renewed == 0 ? line * std::polar(1.0, per_sample * static_cast<double>(k)) : now * turn;
    more[k] = now.imag();
  }
  add(force_N, more);
}

double rate_of_line(std::span<const double> q) {
  return q[2 * line_runs];
}

std::complex<double> line_of_run(std::span<const double> q, std::size_t run) {
  const std::size_t own = std::min(run, line_runs - 1);
  return {q[2 * own], q[2 * own + 1]};
}

bool has_line(std::span<const double> q, std::size_t run) {
  constexpr double there = 0.01;  // of the largest square; less is a step of differences
  double largest = 0.0;
  for (std::size_t other = 0; other < line_runs; ++other) largest = std::max(largest, std::norm(line_of_run(q, other)));
  return std::norm(line_of_run(q, run)) > there * largest;
}

double line_amplitude(std::span<const double> q) {
  double sum = 0.0, runs = 0.0;
  for (std::size_t run = 0; run < line_runs; ++run)
    if (has_line(q, run)) sum += std::norm(line_of_run(q, run)), runs += 1.0;
  return std::sqrt(sum / std::max(1.0, runs));
}

std::vector<WorkingParameter> with_states(std::vector<WorkingParameter> parameters, double step, double lowest,
                                          double highest) {
  static constexpr std::array names{"state_0", "state_1", "state_2", "state_3"};
  static_assert(names.size() == line_runs);
  for (std::size_t run = 0; run < line_runs; ++run)
    parameters.push_back({names[run], run == 0 ? Kind::fixed : Kind::amplitude, step, lowest, highest});
  return parameters;
}

std::size_t state_of_run(std::size_t first_state, std::size_t run) {
  return first_state + std::min(run, line_runs - 1);
}

double mean_state(const Active& active) {
  double sum = 0.0, runs = 1.0;
  for (std::size_t run = 0; run < line_runs; ++run) {
    const double one = active.q[state_of_run(active.hypothesis->first_state, run)];
    sum += one, runs += run > 0 && one != 0.0;
  }
  return sum / runs;
}

std::pair<double, double> states_from_to(const Active& active) {
  const auto [low, high] = std::ranges::minmax(std::span(active.q).subspan(active.hypothesis->first_state, line_runs));
  return {low, high};
}

bool states_differ(const Active& active) {
  constexpr double least_share = 0.1;
  const auto [low, high] = states_from_to(active);
  return std::max(-low, high) > std::min(active.hypothesis->clear_step, least_share * std::abs(active.q.front()));
}

bool wavers_little(double amplitude_m, double cycles_per_rev, const plant::TransmissionParameters& transmission) {
  constexpr double most_slope = 0.1;
  return amplitude_m * cycles_per_rev * per_lead(transmission) < most_slope;
}

}  // namespace feedtwin::tools::diagnosis
