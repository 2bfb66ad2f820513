#include "tools/diagnose/ringing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double lowest_Hz = 1.5, finer = 1.02;
constexpr Index frequencies = 160;            // to 35 Hz
constexpr double dampings[] = {0.015, 0.05};  // more of it, and the recent past holds all
constexpr Index modes = frequencies * std::size(dampings);

Mode mode_at(Index i) {
  return {lowest_Hz * std::pow(finer, static_cast<double>(i % frequencies)),
          dampings[static_cast<std::size_t>(i / frequencies)]};
}

/// z (imaginary) and z' (real), each to a factor and some of the other, at every sample of a run: the mode's own motion is
/// turned exactly, the acceleration held over a sample.
std::vector<std::complex<double>> swung(const Track& track, const Mode& mode) {
  const double w = 2.0 * std::numbers::pi * mode.frequency_Hz, d = mode.damping_ratio, h = track.sample_s;
  const std::complex<double> pole(-d * w, w * std::sqrt(1.0 - d * d)), turn = std::exp(pole * h), push = (turn - 1.0) / pole;
  std::vector<std::complex<double>> all(static_cast<std::size_t>(track.size));
  std::complex<double> state = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    all[static_cast<std::size_t>(k)] = state;
    state = turn * state - push * track.table_acceleration_m_per_s2[k];
  }
  return all;
}

Index best_of(const PairSums& sums) {
  Index best = 0;
  sums.gain().maxCoeff(&best);
  return best;
}

}  // namespace

Ringing::Ringing(const std::vector<Track>& tracks, std::span<const RingingMoment> moments, std::size_t folds)
    : folds_(folds), swing_(modes, static_cast<Index>(moments.size())), speed_(swing_) {
  for (const auto& m : moments) fold_.push_back(m.fold);
  for (Index i = 0; i < modes; ++i) {
    std::vector<std::vector<std::complex<double>>> by_run;
    for (const auto& track : tracks) by_run.push_back(swung(track, mode_at(i)));
    for (std::size_t k = 0; k < moments.size(); ++k) {
      const auto state = by_run[moments[k].run][static_cast<std::size_t>(moments[k].sample)];
      swing_(i, static_cast<Index>(k)) = state.imag();
      speed_(i, static_cast<Index>(k)) = state.real();
    }
    const double size = std::sqrt((swing_.row(i).squaredNorm() + speed_.row(i).squaredNorm()) /
                                  (2.0 * static_cast<double>(moments.size()) + 1.0)) +
                        1e-30;
    swing_.row(i) /= size;
    speed_.row(i) /= size;
    size_.push_back(size);
  }
}

std::vector<PairSums> Ringing::sums_by_fold(const Vector& y) const {
  std::vector<PairSums> own(folds_, PairSums(modes));
  for (std::size_t k = 0; k < fold_.size(); ++k) {
    const auto column = static_cast<Index>(k);
    own[fold_[k]].add_row(swing_.col(column), speed_.col(column), y[column]);
  }
  return own;
}

Vector Ringing::unseen(const Vector& y) const {
  const auto own = sums_by_fold(y);
  Vector predicted = Vector::Zero(y.size());
  for (std::size_t f = 0; f < folds_; ++f) {
    PairSums others(modes);
    for (std::size_t g = 0; g < folds_; ++g)
      if (g != f) others.add(own[g]);
    const Index best = best_of(others);
    const auto [swing, speed] = others.at(best);
    for (std::size_t k = 0; k < fold_.size(); ++k) {
      const auto column = static_cast<Index>(k);
      if (fold_[k] == f) predicted[column] = swing * swing_(best, column) + speed * speed_(best, column);
    }
  }
  return predicted;
}

Mode Ringing::mode(const Vector& y) const {
  PairSums all(modes);
  for (const auto& own : sums_by_fold(y)) all.add(own);
  const Index best = best_of(all);
  Mode mode = mode_at(best);
  mode.mass_kg = -all.at(best).first / (size_[static_cast<std::size_t>(best)] * 2.0 * std::numbers::pi * mode.frequency_Hz);
  return mode;
}

}  // namespace feedtwin::tools::diagnosis
