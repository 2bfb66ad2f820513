#include "tools/diagnose/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double reach_s = 0.2, step_s = 0.002;
constexpr int farthest_steps = 40;
constexpr double farthest_s = farthest_steps * step_s;
constexpr double low_pass_s = 0.006;  // what the rows' low pass makes of a step
constexpr Index least_rows = 30;
constexpr std::array ramps_s{0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.14};

/// Rows of one equation about an edge, by the time since it: what stands beside it may be a slow force.
struct About {
  std::vector<double> since_s, values_N;

  /// Rows times the logarithm of what a step at that instant leaves over; without one: of a slow force alone.
  [[nodiscard]] double misfit(double at_s, double ramp_s, double direction, double frequency_Hz, bool step) const {
    const auto n = static_cast<Index>(since_s.size());
    if (n < least_rows) return 0.0;
    Eigen::MatrixXd columns(n, step ? 5 : 2);
    Vector left(n);
    for (Index i = 0; i < n; ++i) {
      const double t = since_s[static_cast<std::size_t>(i)];
      left[i] = values_N[static_cast<std::size_t>(i)];
      columns(i, 0) = 1.0, columns(i, 1) = t;
      if (!step) continue;
      const double in_cut = std::clamp(direction * (t - at_s) / std::hypot(ramp_s, low_pass_s) + 0.5, 0.0, 1.0);
      const double phase = 2.0 * std::numbers::pi * frequency_Hz * t;
      columns(i, 2) = in_cut, columns(i, 3) = in_cut * std::sin(phase), columns(i, 4) = in_cut * std::cos(phase);
    }
    left -= columns * least_squares(columns, left);
    return static_cast<double>(n) * std::log(left.squaredNorm() / static_cast<double>(n) + 1e-300);
  }
};

struct Edge {
  double* time_s;
  double direction;  ///< 1: into the cut
  std::vector<About> rows;

  [[nodiscard]] double misfit(double at_s, double ramp_s, double frequency_Hz, bool step = true) const {
    double sum = 0.0;
    for (const auto& about : rows) sum += about.misfit(at_s, ramp_s, direction, frequency_Hz, step);
    return sum;
  }
  /// Least misfit with that ramp, and where.
  [[nodiscard]] std::pair<double, double> best(double ramp_s, double frequency_Hz) const {
    std::pair<double, double> least{1e300, 0.0};
    for (int i = -farthest_steps; i <= farthest_steps; ++i)
      least = std::min(least, {misfit(i * step_s, ramp_s, frequency_Hz), i * step_s});
    return least;
  }
};

/// Settled rows of the table's force within reach of an instant, up to half of the way to other edges.
std::vector<About> rows_about(const InverseModel& model, const Vector& residual, std::size_t run, double from_s, double at_s,
                              double to_s) {
  std::vector<About> all;
  for (const auto& s : model.segments()) {
    if (s.run != run || !model.equations()[s.equation].guide) continue;
    auto& about = all.emplace_back();
    for (Index k = 0; k < s.size; ++k) {
      const double t = static_cast<double>(model.sample_of(s, k)) * model.tracks()[run].sample_s;
      if (t < std::max(from_s, at_s - reach_s) || t > std::min(to_s, at_s + reach_s) || !model.settled(s.start + k))
        continue;
      about.since_s.push_back(t - at_s), about.values_N.push_back(residual[s.start + k]);
    }
  }
  return all;
}

/// Those of a run that show a step.
std::vector<Edge> edges_of(const InverseModel& model, const Vector& residual, std::size_t run, double frequency_Hz,
                           Windows& windows) {
  constexpr double clearly = 60.0;  // of the misfit: three numbers and where, among 81 places
  std::vector<double*> times_s;
  for (auto& window : windows) times_s.insert(times_s.end(), {&window.start_s, &window.end_s});
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double at_s = *times_s[i], from_s = i > 0 ? 0.5 * (*times_s[i - 1] + at_s) : -1e300,
                 to_s = i + 1 < times_s.size() ? 0.5 * (at_s + *times_s[i + 1]) : 1e300;
    Edge edge{times_s[i], i % 2 == 0 ? 1.0 : -1.0, rows_about(model, residual, run, from_s, at_s, to_s)};
    if (edge.best(0.0, frequency_Hz).first < edge.misfit(0.0, 0.0, frequency_Hz, false) - clearly)
      edges.push_back(std::move(edge));
  }
  return edges;
}

}  // namespace

Cuts sharpened(const InverseModel& model, const Vector& residual, double frequency_Hz, std::vector<Windows> windows) {
  Cuts cuts{std::move(windows), 0.0};
  std::vector<Edge> edges;
  for (std::size_t run = 0; run < cuts.windows.size(); ++run)
    for (auto& edge : edges_of(model, residual, run, frequency_Hz, cuts.windows[run])) edges.push_back(std::move(edge));
  double least = 1e300;
  std::vector<double> moved_s(edges.size());
  for (const double ramp_s : ramps_s) {
    double sum = 0.0;
    std::vector<double> best_s;
    for (const auto& edge : edges) {
      const auto [misfit, at_s] = edge.best(ramp_s, frequency_Hz);
      sum += misfit, best_s.push_back(at_s);
    }
    if (sum < least) least = sum, cuts.ramp_s = ramp_s, moved_s = best_s;
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (std::abs(moved_s[i]) < farthest_s - 0.5 * step_s) *edges[i].time_s += moved_s[i];
  return cuts;
}

}  // namespace feedtwin::tools::diagnosis
