#include "tools/identify/zero_phase_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace feedtwin::tools {
namespace {

constexpr double kept_of_nyquist = 0.8;  ///< by the filter before decimation, of the new rate

using Complex = std::complex<double>;

std::vector<double> polynomial(const std::vector<Complex>& roots) {
  std::vector<Complex> c{1.0};
  for (const Complex& root : roots) {
    c.push_back(0.0);
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] -= root * c[i - 1];
  }
  std::vector<double> real(c.size());
  std::ranges::transform(c, real.begin(), [](const Complex& v) { return v.real(); });
  return real;
}

/// Analogue poles at 1 rad/s, warped to the cut-off and brought over by the bilinear transform; unit `gain` at frequency 0.
DigitalFilter low_pass(const std::vector<Complex>& analogue_poles, double cutoff, double gain) {
  const double warped = 4.0 * std::tan(0.5 * std::numbers::pi * cutoff);  // sampled at 2 Hz
  std::vector<Complex> poles, zeros(analogue_poles.size(), -1.0);
  for (const Complex& pole : analogue_poles) poles.push_back((4.0 + pole * warped) / (4.0 - pole * warped));
  DigitalFilter filter{polynomial(zeros), polynomial(poles)};
  double top = 0.0, bottom = 0.0;
  for (const double b : filter.numerator) top += b;
  for (const double a : filter.denominator) bottom += a;
  for (double& b : filter.numerator) b *= gain * bottom / top;
  return filter;
}

/// State of the transposed direct form that a constant input of 1 has settled to.
Eigen::VectorXd settled_state(const DigitalFilter& filter) {
  const auto n = static_cast<Eigen::Index>(filter.denominator.size()) - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd input(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto next = static_cast<std::size_t>(i) + 1;
    companion(i, 0) += filter.denominator[next];
    if (i + 1 < n) companion(i, i + 1) -= 1.0;
    input[i] = filter.numerator[next] - filter.denominator[next] * filter.numerator[0];
  }
  return companion.fullPivLu().solve(input);
}

void filter_once(const DigitalFilter& filter, const Eigen::VectorXd& settled, std::vector<double>& values) {
  std::vector<double> state(static_cast<std::size_t>(settled.size()) + 1, 0.0);
  for (std::size_t i = 0; i + 1 < state.size(); ++i) state[i] = settled[static_cast<Eigen::Index>(i)] * values.front();
  for (double& value : values) {
    const double in = value, out = filter.numerator[0] * in + state[0];
    for (std::size_t i = 0; i + 1 < state.size(); ++i) {
      state[i] = filter.numerator[i + 1] * in + state[i + 1] - filter.denominator[i + 1] * out;
    }
    value = out;
  }
}

}  // namespace

DigitalFilter butterworth(int order, double cutoff) {
  std::vector<Complex> poles;
  for (int k = 0; k < order; ++k)
    poles.push_back(std::polar(1.0, std::numbers::pi * (2.0 * k + order + 1.0) / (2.0 * order)));
  return low_pass(poles, cutoff, 1.0);
}

DigitalFilter chebyshev(int order, double ripple_dB, double cutoff) {
  const double ripple = std::sqrt(std::pow(10.0, 0.1 * ripple_dB) - 1.0);
  const double mu = std::asinh(1.0 / ripple) / order;
  std::vector<Complex> poles;
  for (int k = 0; k < order; ++k) {
    const double theta = std::numbers::pi * (2.0 * k + 1.0) / (2.0 * order);
    poles.emplace_back(-std::sinh(mu) * std::sin(theta), std::cosh(mu) * std::cos(theta));
  }
  return low_pass(poles, cutoff, order % 2 == 0 ? 1.0 / std::sqrt(1.0 + ripple * ripple) : 1.0);
}

std::vector<double> filter_both_ways(const DigitalFilter& filter, std::span<const double> values) {
  const std::size_t edge = 3 * (filter.denominator.size() - 1);
  if (values.size() <= edge) return {values.begin(), values.end()};
  std::vector<double> extended;
  extended.reserve(values.size() + 2 * edge);
  for (std::size_t i = edge; i > 0; --i) extended.push_back(2.0 * values.front() - values[i]);
  extended.insert(extended.end(), values.begin(), values.end());
  for (std::size_t i = 1; i <= edge; ++i) extended.push_back(2.0 * values.back() - values[values.size() - 1 - i]);
  const Eigen::VectorXd settled = settled_state(filter);
  for (int way = 0; way < 2; ++way) {
    filter_once(filter, settled, extended);
    std::ranges::reverse(extended);
  }
  const auto first = extended.begin() + static_cast<std::ptrdiff_t>(edge);
  return {first, first + static_cast<std::ptrdiff_t>(values.size())};
}

int decimation_keeping(double band_Hz, double sample_s) {
  return std::max(1, static_cast<int>(std::round(kept_of_nyquist * 0.5 / sample_s / band_Hz)));
}

std::vector<double> decimated(std::span<const double> values, int factor) {
  if (factor <= 1) return {values.begin(), values.end()};
  const auto step = static_cast<std::size_t>(factor);
  const auto smooth = filter_both_ways(chebyshev(8, 0.05, kept_of_nyquist / factor), values);
  std::vector<double> kept;
  for (std::size_t i = (values.size() - 1) % step; i < values.size(); i += step) kept.push_back(smooth[i]);
  return kept;
}

std::vector<double> central_difference(std::span<const double> values, double step) {
  const std::size_t n = values.size();
  std::vector<double> slope(n, 0.0);
  if (n < 2) return slope;
  for (std::size_t i = 1; i + 1 < n; ++i) slope[i] = (values[i + 1] - values[i - 1]) / (2.0 * step);
  slope[0] = (values[1] - values[0]) / step;
  slope[n - 1] = (values[n - 1] - values[n - 2]) / step;
  return slope;
}

}  // namespace feedtwin::tools
