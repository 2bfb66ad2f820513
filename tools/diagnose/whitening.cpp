#include "tools/diagnose/whitening.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/linear_systems.h"
#include "tools/median.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index order = 12;
constexpr double clip_at_sigmas = 4.0, least_share_of_rms = 1.0 / 1.5;

double robust_sigma(std::vector<double> values) {
  if (values.empty()) return 1.0;
  for (double& value : values) value = std::abs(value);
  return 1.4826 * median_of(std::move(values));
}

Vector clipped(const Vector& values, double limit) {
  return values.cwiseMax(-limit).cwiseMin(limit);
}

/// Without what is steady in each direction of motion, or goes steadily with time or place: that is no noise, and must not
/// be whitened away.
Vector less_steady(const InverseModel& model, const Vector& residual) {
  Vector out = residual;
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    if (model.equations()[e].power || model.equations()[e].slip) continue;
    for (const bool forth : {true, false}) {
      std::vector<Index> rows;
      std::vector<Eigen::Vector3d> steady;
      for (const auto& s : model.segments()) {
        const Track& track = model.tracks()[s.run];
        for (Index i = 0; s.equation == e && i < s.size; ++i) {
          const Index k = model.sample_of(s, i);
          if (!model.settled(s.start + i) || (track.centred_m_per_s[k] > 0.0) != forth) continue;
          rows.push_back(s.start + i);
          steady.emplace_back(1.0, static_cast<double>(k) / static_cast<double>(track.size), track.shown_m[k]);
        }
      }
      if (rows.empty()) continue;
      const Eigen::Matrix3Xd::ConstMapType by_column(steady.front().data(), 3, static_cast<Index>(steady.size()));
      const Eigen::MatrixX3d regressors = by_column.transpose();
      const Vector there = residual(rows);
      out(rows) -= regressors * least_squares(regressors, there);
    }
  }
  return out;
}

}  // namespace

Whitening Whitening::estimate(const InverseModel& model, const Vector& given) {
  Whitening made;
  const Vector residual = less_steady(model, given);
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    std::vector<double> settled;
    for (const auto& s : model.segments())
      for (Index k = s.start; s.equation == e && k < s.start + s.size; ++k)
        if (model.settled(k)) settled.push_back(residual[k]);
    double energy = 0.0;
    for (double value : settled) energy += value * value;
    const double rms = std::sqrt(energy / static_cast<double>(std::max<std::size_t>(1, settled.size())));
    const double limit = clip_at_sigmas * std::max(robust_sigma(settled), 0.1 * rms) + 1e-300;

    const Index p = model.equations()[e].slip ? 0 : model.equations()[e].power ? 2 : order;  // grids are white
    Vector correlation = Vector::Zero(p + 1);
    double pairs = 0.0;
    for (const auto& s : model.segments()) {
      if (s.equation != e) continue;
      Vector r = clipped(residual.segment(s.start, s.size), limit), here(s.size);
      for (Index k = 0; k < s.size; ++k) here[k] = model.settled(s.start + k) ? 1.0 : 0.0;
      r = r.cwiseProduct(here);
      pairs += here.sum();
      for (Index lag = 0; lag <= p && lag < s.size; ++lag)
        correlation[lag] += r.head(s.size - lag).dot(r.tail(s.size - lag));
    }
    correlation /= std::max(1.0, pairs);  // for all lags alike: what has gaps keeps a positive spectrum
    correlation[0] = correlation[0] * (1.0 + 1e-6) + 1e-300;
    Eigen::MatrixXd toeplitz(p, p);
    for (Index i = 0; i < p; ++i)
      for (Index j = 0; j < p; ++j) toeplitz(i, j) = correlation[std::abs(i - j)];
    const Vector a = p > 0 ? solved(toeplitz, correlation.tail(p)) : Vector();
    const double innovation = correlation[0] - a.dot(correlation.tail(p));
    // what leaves spikes is a law's mistake and no noise: a play that is taken up a moment early would outweigh all else
    const double least = model.equations()[e].slip ? least_share_of_rms * rms : 0.0;
    made.colours_.push_back({{a.begin(), a.end()}, std::max(least, std::sqrt(std::max(innovation, 1e-6 * correlation[0])))});
    made.rms_.push_back(std::sqrt(correlation[0]));
    made.unsettled_.push_back(1.0);
  }
  const Vector white = made.applied(model, residual);
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    double square = 0.0, count = 0.0;
    for (const auto& s : model.segments())
      for (Index k = s.start; s.equation == e && k < s.start + s.size; ++k)
        if (!model.settled(k)) square += white[k] * white[k], count += 1.0;
    if (count > 0.0) made.unsettled_[e] = 1.0 / std::max(1.0, std::sqrt(square / count));
  }
  return made;
}

void Whitening::apply(const InverseModel& model, Eigen::Ref<Eigen::MatrixXd> columns) const {
  for (const auto& s : model.segments()) {
    for (Index c = 0; c < columns.cols(); ++c) {
      auto part = columns.col(c).segment(s.start, s.size);
      if (s.size == 0 || part.cwiseAbs().maxCoeff() == 0.0) continue;
      colours_[s.equation].apply({part.data(), static_cast<std::size_t>(s.size)});
      for (Index k = 0; k < s.size; ++k)
        if (!model.settled(s.start + k)) part[k] *= unsettled_[s.equation];
    }
  }
}

Vector Whitening::applied(const InverseModel& model, const Vector& column) const {
  Eigen::MatrixXd matrix = column;
  apply(model, matrix);
  return matrix.col(0);
}

}  // namespace feedtwin::tools::diagnosis
