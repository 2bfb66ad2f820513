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

/// Place of a frequency's multiple.
Index multiple(Index frequency, Index times) {
  return times * frequency + (times - 1) * std::lround(lowest_Hz / step_Hz);
}

/// The frequency, with its multiples, that brings most.
std::vector<Index> waves_of(const Eigen::ArrayXd& gain, Index harmonics) {
  double most = -1.0;
  std::vector<Index> best;
  for (Index i = 0; multiple(i, harmonics) < frequencies; ++i) {
    std::vector<Index> waves;
    double together = 0.0;
    for (Index h = 1; h <= harmonics; ++h) waves.push_back(multiple(i, h)), together += gain[waves.back()];
    if (together > most) most = together, best = std::move(waves);
  }
  return best;
}

/// Of each run, from those of its folds in turn.
std::vector<PairSums> all_folds(const std::vector<PairSums>& by_fold, std::size_t runs) {
  std::vector<PairSums> all(runs, PairSums(frequencies));
  const std::size_t folds = by_fold.size() / runs;
  for (std::size_t i = 0; i < by_fold.size(); ++i) all[i / folds].add(by_fold[i]);
  return all;
}

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

Vector Beat::in_motion(const Vector& y) const {
  Vector turned = y;
  for (std::size_t k = 0; k < moments_.size(); ++k)
    if (!moments_[k].forth) turned[static_cast<Index>(k)] = -turned[static_cast<Index>(k)];
  return turned;
}

Vector Beat::pulses_unseen(const Vector& y) const {
  return in_motion(unseen(in_motion(y), pulse_waves));
}

std::vector<PairSums> Beat::sums_by_fold(const Vector& y) const {
  std::vector<PairSums> own(runs_ * folds_, PairSums(frequencies));
  for (std::size_t k = 0; k < moments_.size(); ++k) {
    const auto column = static_cast<Index>(k);
    own[moments_[k].run * folds_ + moments_[k].fold].add_row(sine_.col(column), cosine_.col(column), y[column]);
  }
  return own;
}

double Beat::strongest_Hz(const Vector& y, Index harmonics) const {
  Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(frequencies);
  for (const auto& run : all_folds(sums_by_fold(y), runs_)) gain += run.gain();
  return lowest_Hz + step_Hz * static_cast<double>(waves_of(gain, harmonics).front());
}

Vector Beat::unseen(const Vector& y, Index harmonics) const {
  const auto own = sums_by_fold(y);
  const auto all = all_folds(own, runs_);
  Vector predicted = Vector::Zero(y.size());
  for (std::size_t f = 0; f < folds_; ++f) {
    std::vector<PairSums> others = all;
    Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(frequencies);
    for (std::size_t r = 0; r < runs_; ++r) others[r].add(own[r * folds_ + f], -1.0), gain += others[r].gain();
    for (const Index best : waves_of(gain, harmonics)) {
      std::vector<std::pair<double, double>> phases;  // sine and cosine of each run
      for (const auto& run : others) phases.push_back(run.at(best));
      for (std::size_t k = 0; k < moments_.size(); ++k) {
        if (moments_[k].fold != f) continue;
        const auto column = static_cast<Index>(k);
        const auto [sine, cosine] = phases[moments_[k].run];
        predicted[column] += sine * sine_(best, column) + cosine * cosine_(best, column);
      }
    }
  }
  return predicted;
}

}  // namespace feedtwin::tools::diagnosis
