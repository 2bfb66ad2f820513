#include "tools/identify/whitening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/median.h"

namespace feedtwin::tools {

void Whitening::apply(std::span<double> residuals) const {
  constexpr std::size_t block = 512;
  const std::size_t order = coefficients.size();
  std::array<double, block> e;
  // from the end, block by block, one coefficient after the other over a block: loops that a compiler makes vectors of
  std::size_t end = residuals.size();
  while (end > order) {
    const std::size_t first = std::max(order, end > block ? end - block : 0), count = end - first;
    std::copy_n(residuals.data() + first, count, e.data());
    for (std::size_t i = 1; i <= order; ++i) {
      const double a = coefficients[i - 1];
      const double* past = residuals.data() + first - i;
      for (std::size_t k = 0; k < count; ++k) e[k] -= a * past[k];
    }
    for (std::size_t k = 0; k < count; ++k) residuals[first + k] = e[k] / sigma;
    end = first;
  }
  for (std::size_t k = end; k-- > 0;) {  // what has no full past
    double rest = residuals[k];
    for (std::size_t i = 1; i <= k; ++i) rest -= coefficients[i - 1] * residuals[k - i];
    residuals[k] = rest / sigma;
  }
}

Whitening fit_whitening(std::span<const std::vector<double>> stretches, std::size_t highest_order, double smallest_sigma) {
  std::size_t samples = 0;
  for (const auto& stretch : stretches) samples += stretch.size();
  const std::size_t order = std::min(highest_order, samples / 40);
  std::vector<double> correlation(order + 1, 0.0);
  for (const auto& r : stretches) {
    for (std::size_t lag = 0; lag <= std::min(order, r.size() - (r.empty() ? 0 : 1)); ++lag) {
      for (std::size_t k = lag; k < r.size(); ++k) correlation[lag] += r[k] * r[k - lag];
    }
  }
  for (double& c : correlation) c /= static_cast<double>(std::max<std::size_t>(samples, 1));
  Whitening whitening;
  double variance = correlation[0] * (1.0 + 1e-9);
  std::vector<double>& a = whitening.coefficients;
  for (std::size_t m = 0; m < order && variance > 0.0; ++m) {
    double k = correlation[m + 1];
    for (std::size_t i = 0; i < m; ++i) k -= a[i] * correlation[m - i];
    k /= variance;
    std::vector<double> next(a);
    next.push_back(k);
    for (std::size_t i = 0; i < m; ++i) next[i] = a[i] - k * a[m - 1 - i];
    a = std::move(next);
    variance *= 1.0 - k * k;
  }
  whitening.sigma = std::max(std::sqrt(std::max(variance, 0.0)), smallest_sigma);
  return whitening;
}

double white_sigma(std::span<const double> x) {
  std::vector<double> d;
  for (std::size_t k = 3; k < x.size(); ++k) d.push_back(std::abs(x[k] - 3.0 * x[k - 1] + 3.0 * x[k - 2] - x[k - 3]));
  if (d.empty()) return 0.0;
  return 1.4826 * median_of(std::move(d)) / std::sqrt(20.0);
}

}  // namespace feedtwin::tools
