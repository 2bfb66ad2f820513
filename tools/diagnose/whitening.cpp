#include "tools/diagnose/whitening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index order = 12;
constexpr double clip_at_sigmas = 4.0;

double robust_sigma(std::vector<double> values) {
  if (values.empty()) return 1.0;
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return 1.4826 * *middle;
}

Vector clipped(const Vector& values, double limit) {
  return values.cwiseMax(-limit).cwiseMin(limit);
}

}  // namespace

Whitening Whitening::estimate(const InverseModel& model, const Vector& residual) {
  Whitening made;
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    std::vector<double> all;
    for (const auto& s : model.segments())
      if (s.equation == e) all.insert(all.end(), residual.data() + s.start, residual.data() + s.start + s.size);
    double energy = 0.0;
    for (double value : all) energy += value * value;
    const double rms = std::sqrt(energy / static_cast<double>(std::max<std::size_t>(1, all.size())));
    const double limit = clip_at_sigmas * std::max(robust_sigma(all), 0.1 * rms) + 1e-300;

    const Index p = model.equations()[e].slip ? 0 : model.equations()[e].power ? 2 : order;  // grids are white
    Vector correlation = Vector::Zero(p + 1);
    double count = 0.0;
    for (const auto& s : model.segments()) {
      if (s.equation != e) continue;
      const Vector r = clipped(residual.segment(s.start, s.size), limit);
      count += static_cast<double>(s.size);
      for (Index lag = 0; lag <= p && lag < s.size; ++lag)
        correlation[lag] += r.head(s.size - lag).dot(r.tail(s.size - lag));
    }
    correlation /= std::max(1.0, count);
    correlation[0] = correlation[0] * (1.0 + 1e-6) + 1e-300;
    Eigen::MatrixXd toeplitz(p, p);
    for (Index i = 0; i < p; ++i)
      for (Index j = 0; j < p; ++j) toeplitz(i, j) = correlation[std::abs(i - j)];
    const Vector a = p > 0 ? Vector(toeplitz.ldlt().solve(correlation.tail(p))) : Vector();
    const double innovation = correlation[0] - a.dot(correlation.tail(p));
    made.coefficients_.push_back(a);
    made.sigma_.push_back(std::sqrt(std::max(innovation, 1e-6 * correlation[0])));
    made.rms_.push_back(std::sqrt(correlation[0]));
  }
  return made;
}

void Whitening::apply(const InverseModel& model, Eigen::Ref<Eigen::MatrixXd> columns) const {
  for (const auto& s : model.segments()) {
    const Vector& a = coefficients_[s.equation];
    const double per_sigma = 1.0 / sigma_[s.equation];
    for (Index c = 0; c < columns.cols(); ++c) {
      auto part = columns.col(c).segment(s.start, s.size);
      if (s.size == 0 || part.cwiseAbs().maxCoeff() == 0.0) continue;
      for (Index k = s.size - 1; k >= 0; --k) {
        double value = part[k];
        for (Index j = 1; j <= a.size() && j <= k; ++j) value -= a[j - 1] * part[k - j];
        part[k] = value * per_sigma;
      }
    }
  }
}

Vector Whitening::applied(const InverseModel& model, const Vector& column) const {
  Eigen::MatrixXd matrix = column;
  apply(model, matrix);
  return matrix.col(0);
}

}  // namespace feedtwin::tools::diagnosis
