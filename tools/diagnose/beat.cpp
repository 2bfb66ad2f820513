#include "tools/diagnose/beat.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double lowest_Hz = 0.3, step_Hz = 0.01;
constexpr Index frequencies = 371;
constexpr double said_zero = 10.0;  // as if ten more rows had said zero

/// Sums over the rows of a run and a fold, a row a frequency.
struct Sums {
  Eigen::ArrayXd ss, sc, cc, sy, cy;
  Sums() {
    for (auto* part : {&ss, &sc, &cc, &sy, &cy}) part->setZero(frequencies);
  }
  void add(const Sums& other, double sign) {
    ss += sign * other.ss, sc += sign * other.sc, cc += sign * other.cc, sy += sign * other.sy, cy += sign * other.cy;
  }
  /// Fall of the squares that sine and cosine bring at each frequency.
  [[nodiscard]] Eigen::ArrayXd gain() const {
    const Eigen::ArrayXd s = ss + said_zero, c = cc + said_zero;
    return (c * sy * sy - 2.0 * sc * sy * cy + s * cy * cy) / (s * c - sc * sc);
  }
  /// Amplitudes of sine and cosine at one.
  [[nodiscard]] std::pair<double, double> at(Index i) const {
    const double s = ss[i] + said_zero, c = cc[i] + said_zero, determinant = s * c - sc[i] * sc[i];
    return {(c * sy[i] - sc[i] * cy[i]) / determinant, (s * cy[i] - sc[i] * sy[i]) / determinant};
  }
};

}  // namespace

Beat::Beat(std::span<const BeatMoment> moments, std::size_t folds)
    : moments_(moments.begin(), moments.end()),
      folds_(folds),
      sine_(frequencies, static_cast<Index>(moments.size())),
      cosine_(sine_) {
  const Eigen::ArrayXd rate =
      2.0 * std::numbers::pi * (lowest_Hz + step_Hz * Eigen::ArrayXd::LinSpaced(frequencies, 0.0, frequencies - 1.0));
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const auto& m = moments[k];
    const double way = m.forth ? 1.0 : -1.0;
    sine_.col(static_cast<Index>(k)) = way * (rate * m.time_s).sin();
    cosine_.col(static_cast<Index>(k)) = way * (rate * m.time_s).cos();
    runs_ = std::max(runs_, m.run + 1);
  }
}

Vector Beat::unseen(const Vector& y) const {
  std::vector<Sums> all(runs_), own(runs_ * folds_);
  for (std::size_t k = 0; k < moments_.size(); ++k) {
    const auto column = static_cast<Index>(k);
    auto& sums = own[moments_[k].run * folds_ + moments_[k].fold];
    const auto s = sine_.col(column).array(), c = cosine_.col(column).array();
    sums.ss += s * s, sums.sc += s * c, sums.cc += c * c, sums.sy += y[column] * s, sums.cy += y[column] * c;
  }
  for (std::size_t r = 0; r < runs_; ++r)
    for (std::size_t f = 0; f < folds_; ++f) all[r].add(own[r * folds_ + f], 1.0);
  Vector predicted = Vector::Zero(y.size());
  for (std::size_t f = 0; f < folds_; ++f) {
    std::vector<Sums> others = all;
    Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(frequencies);
    for (std::size_t r = 0; r < runs_; ++r) others[r].add(own[r * folds_ + f], -1.0), gain += others[r].gain();
    Index best = 0;
    gain.maxCoeff(&best);
    std::vector<std::pair<double, double>> phases;  // sine and cosine of each run
    for (const auto& run : others) phases.push_back(run.at(best));
    for (std::size_t k = 0; k < moments_.size(); ++k) {
      if (moments_[k].fold != f) continue;
      const auto column = static_cast<Index>(k);
      const auto [sine, cosine] = phases[moments_[k].run];
      predicted[column] = sine * sine_(best, column) + cosine * cosine_(best, column);
    }
  }
  return predicted;
}

}  // namespace feedtwin::tools::diagnosis
