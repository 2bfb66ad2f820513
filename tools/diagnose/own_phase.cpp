#include "tools/diagnose/own_phase.h"

#include <algorithm>
#include <span>

#include "tools/diagnose/edges.h"
#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Of the runs that have the line at all: of the others only what differences left.
std::vector<std::complex<double>> lines_of(const Active& active) {
  std::vector<std::complex<double>> lines;
  for (std::size_t run = 0; run < line_runs; ++run)
    if (has_line(active.q, run)) lines.push_back(active.hypothesis->line_of(active.q, run));
  return lines;
}

void set_line(Active& active, std::size_t run, std::complex<double> line) {
  active.q[2 * run] = line.real();
  active.q[2 * run + 1] = line.imag();
}

/// Some of an effect's numbers by least squares from none, everything else as it is.
/// @param step for differences: 1 where it acts in proportion
void take_from_runs(const InverseModel& unseen, const Whitening& whitening, Candidate& model, std::size_t effect,
                    std::size_t first, std::size_t count, double step) {
  Active& own = model.effects[effect];
  const auto numbers = std::span(own.q).subspan(first, count);
  std::ranges::fill(numbers, 0.0);
  const auto contacts = unseen.contacts(model.axis, model.effects);
  const bool again = moves_friction(*own.hypothesis, model.effects);  // only then is friction another with other numbers
  const auto left = [&] {
    const auto& followed = again ? unseen.contacts(model.axis, model.effects) : contacts;
    return whitening.applied(unseen, unseen.residual(model.axis, model.effects, followed));
  };
  const Vector without = left();
  Eigen::MatrixXd columns(without.size(), static_cast<Index>(count));
  for (std::size_t j = 0; j < count; ++j) {
    numbers[j] = step;
    columns.col(static_cast<Index>(j)) = (without - left()) / step;
    numbers[j] = 0.0;
  }
  const Vector found = least_squares(columns, without);
  for (std::size_t j = 0; j < count; ++j) numbers[j] = found[static_cast<Index>(j)];
}

/// What the runs begin with, where those that were fitted differ in that; otherwise as the first of them.
void take_states(const InverseModel& unseen, const Whitening& whitening, Candidate& model, std::size_t effect) {
  constexpr double step = 1e-2;  // of a change; of a growth all are in proportion
  const bool differ = states_differ(model.effects[effect]);
  auto& own = model.effects[effect];
  const std::size_t first = own.hypothesis->first_state;
  std::ranges::fill(std::span(own.q).subspan(first, line_runs), 0.0);
  if (differ) take_from_runs(unseen, whitening, model, effect, first, std::min(line_runs, unseen.tracks().size()), step);
}

/// The parts of the runs in which the line acts.
void take_windows(const InverseModel& unseen, const Whitening& whitening, Candidate& model, std::size_t effect) {
  const Vector left = unseen.residual(model.axis, without(model, effect).effects);
  auto& own = model.effects[effect];
  const double frequency_Hz = rate_of_line(own.q);
  auto windows = windows_of_line(unseen, whitening.applied(unseen, left), frequency_Hz);
  set_windows(own.hypothesis->first_window, own.q, sharpened(unseen, left, frequency_Hz, std::move(windows)).windows);
}

}  // namespace

bool phases_agree(const Active& line) {
  constexpr double least = 0.99;  // of what the amplitudes would add up to: three by chance in 1 of 120 (0.9: 1 of 12)
  const auto lines = lines_of(line);
  double lengths = 0.0;
  for (const auto& one : lines) lengths += std::abs(one);
  return lines.size() > 1 && std::abs(common_line(line)) * static_cast<double>(lines.size()) > least * lengths;
}

std::complex<double> common_line(const Active& line) {
  std::complex<double> sum = 0.0;
  const auto lines = lines_of(line);
  for (const auto& one : lines) sum += one;
  return lines.empty() ? sum : sum / static_cast<double>(lines.size());
}

Candidate for_unseen(const InverseModel& unseen, const Whitening& whitening, const Candidate& fitted) {
  Candidate model = fitted;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    if (!model.effects[e].hypothesis->state.empty()) take_states(unseen, whitening, model, e);
    if (model.effects[e].hypothesis->line_of == nullptr) continue;
    if (windowed(model.effects[e])) take_windows(unseen, whitening, model, e);
    if (phases_agree(model.effects[e])) {
      const auto line = common_line(model.effects[e]);
      for (std::size_t run = 0; run < line_runs; ++run) set_line(model.effects[e], run, line);
    } else {
      for (std::size_t run = 0; run < line_runs; ++run) set_line(model.effects[e], run, 0.0);
      take_from_runs(unseen, whitening, model, e, 0, 2 * std::min(line_runs, unseen.tracks().size()), 1.0);
    }
  }
  return model;
}

}  // namespace feedtwin::tools::diagnosis
