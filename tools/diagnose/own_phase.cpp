#include "tools/diagnose/own_phase.h"

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

/// Sine and cosine of each run by least squares, everything else as it is.
void take_phases(const InverseModel& unseen, const Whitening& whitening, Candidate& model, std::size_t effect) {
  Active& line = model.effects[effect];
  const auto contacts = unseen.contacts(model.axis, model.effects);
  const auto left = [&] { return whitening.applied(unseen, unseen.residual(model.axis, model.effects, contacts)); };
  for (std::size_t run = 0; run < line_runs; ++run) set_line(line, run, 0.0);
  const Vector without = left();
  const std::size_t runs = std::min(line_runs, unseen.tracks().size());
  Eigen::MatrixXd columns(without.size(), static_cast<Index>(2 * runs));
  for (std::size_t j = 0; j < 2 * runs; ++j) {
    line.q[j] = 1.0;
    columns.col(static_cast<Index>(j)) = without - left();
    line.q[j] = 0.0;
  }
  const Vector found = least_squares(columns, without);
  for (std::size_t j = 0; j < 2 * runs; ++j) line.q[j] = found[static_cast<Index>(j)];
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
    if (model.effects[e].hypothesis->line_of == nullptr) continue;
    if (phases_agree(model.effects[e])) {
      const auto line = common_line(model.effects[e]);
      for (std::size_t run = 0; run < line_runs; ++run) set_line(model.effects[e], run, line);
    } else {
      take_phases(unseen, whitening, model, e);
    }
  }
  return model;
}

}  // namespace feedtwin::tools::diagnosis
