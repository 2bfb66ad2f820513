#include "tools/diagnose/lines.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "tools/linear_systems.h"
#include "tools/median.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double lowest_Hz = 6.0;  // below, motion itself repeats
constexpr double above_neighbours = 40.0;
constexpr int most_lines = 6;
constexpr Index neighbourhood = 40, own_width = 5, least_rows = 200;

struct Rows {
  Vector values;   ///< of one segment, zero where the axis has not settled
  Vector settled;  ///< 1 or 0
  double per_row_s;
};

/// Frequency of the strongest line above another in radians a row, if there is one.
std::optional<double> strongest_line(const Rows& rows, double above_Hz) {
  const Index n = rows.values.size();
  const auto length = static_cast<Index>(std::bit_ceil(static_cast<std::size_t>(2 * n)));
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(length);
  padded.head(n) = rows.values;
  Eigen::VectorXcd spectrum;
  Eigen::FFT<double> fft;
  fft.fwd(spectrum, padded);
  const Eigen::VectorXd power = spectrum.cwiseAbs2().head(length / 2);
  const auto first = static_cast<Index>(std::ceil(above_Hz * rows.per_row_s * static_cast<double>(length)));
  Index at = 0;
  double most = 0.0;
  for (Index i = std::max<Index>(first, 1); i + 1 < power.size(); ++i)
    if (power[i] > most) most = power[i], at = i;
  if (at == 0) return {};
  std::vector<double> beside;
  for (Index i = std::max<Index>(1, at - neighbourhood); i <= std::min(at + neighbourhood, power.size() - 1); ++i)
    if (std::abs(i - at) > own_width) beside.push_back(power[i]);
  if (beside.size() < 10) return {};
  if (most < above_neighbours * median_of(std::move(beside))) return {};
  const double before = std::sqrt(power[at - 1]), here = std::sqrt(most), after = std::sqrt(power[at + 1]);
  const double off = 0.5 * (before - after) / (before - 2.0 * here + after - 1e-300);
  return 2.0 * std::numbers::pi * (static_cast<double>(at) + std::clamp(off, -0.5, 0.5)) / static_cast<double>(length);
}

/// The line of that frequency by least squares on the settled rows.
Vector line_at(const Rows& rows, double radians_per_row) {
  const Index n = rows.values.size();
  Eigen::MatrixXd waves(n, 2);
  for (Index k = 0; k < n; ++k) {
    waves(k, 0) = rows.settled[k] * std::sin(radians_per_row * static_cast<double>(k));
    waves(k, 1) = rows.settled[k] * std::cos(radians_per_row * static_cast<double>(k));
  }
  const Eigen::MatrixXd normal = waves.transpose() * waves + 1e-9 * Eigen::Matrix2d::Identity();
  return waves * solved(normal, waves.transpose() * rows.values);
}

Rows settled_rows(const InverseModel& model, const Vector& residual, const Segment& s) {
  Rows rows{residual.segment(s.start, s.size), Vector(s.size), model.tracks()[s.run].row_s()};
  for (Index k = 0; k < s.size; ++k) rows.settled[k] = model.settled(s.start + k) ? 1.0 : 0.0;
  rows.values = rows.values.cwiseProduct(rows.settled);
  return rows;
}

}  // namespace

std::optional<double> strongest_line_Hz(const InverseModel& model, const Vector& residual, const Segment& segment,
                                        double above_Hz) {
  if (segment.size < least_rows) return {};
  const Rows rows = settled_rows(model, residual, segment);
  const auto radians = strongest_line(rows, above_Hz);
  return radians ? std::optional(*radians / (2.0 * std::numbers::pi * rows.per_row_s)) : std::nullopt;
}

Vector sharp_lines(const InverseModel& model, const Vector& residual) {
  Vector lines = Vector::Zero(residual.size());
  for (const auto& s : model.segments()) {
    const auto& equation = model.equations()[s.equation];
    if (equation.slip || equation.power || s.size < least_rows) continue;
    Rows rows = settled_rows(model, residual, s);
    for (int i = 0; i < most_lines; ++i) {
      const auto found = strongest_line(rows, lowest_Hz);
      if (!found) break;
      const Vector line = line_at(rows, *found);
      lines.segment(s.start, s.size) += line;
      rows.values -= line;
    }
  }
  return lines;
}

}  // namespace feedtwin::tools::diagnosis
