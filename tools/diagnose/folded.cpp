#include "tools/diagnose/folded.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double slowest_Hz = 0.25, fold_step_Hz = 0.01;
constexpr std::size_t periods = 376;     // to 4 Hz
constexpr double moments_of_zero = 5.0;  // in each part, as if they had said zero

double period_at(std::size_t i) {
  return 1.0 / (slowest_Hz + fold_step_Hz * static_cast<double>(i));
}

}  // namespace

Folded::Folded(std::span<const BeatMoment> moments, std::size_t folds) : folds_(folds) {
  for (const auto& m : moments) {
    run_.push_back(m.run), fold_.push_back(m.fold);
    runs_ = std::max(runs_, m.run + 1);
  }
  part_.reserve(periods * moments.size());
  for (std::size_t i = 0; i < periods; ++i)
    for (const auto& m : moments) {
      const double turns = m.time_s / period_at(i);
      part_.push_back(static_cast<std::uint8_t>(static_cast<double>(parts) * (turns - std::floor(turns))));
    }
}

std::vector<Folded::Sums> Folded::sums_by_fold(const Vector& y, std::size_t period) const {
  const auto size = static_cast<Index>(runs_ * parts);
  std::vector<Sums> sums(folds_, {Eigen::ArrayXd::Zero(size), Eigen::ArrayXd::Zero(size)});
  for (std::size_t k = 0; k < run_.size(); ++k) {
    const auto at = static_cast<Index>(place(period, k));
    sums[fold_[k]].y[at] += y[static_cast<Index>(k)], sums[fold_[k]].count[at] += 1.0;
  }
  return sums;
}

Folded::Sums Folded::sum_of(const std::vector<Sums>& by_fold) {
  Sums all = by_fold.front();
  for (std::size_t f = 1; f < by_fold.size(); ++f) all.y += by_fold[f].y, all.count += by_fold[f].count;
  return all;
}

Vector Folded::unseen(const Vector& y) const {
  struct Best {
    double gain = -1.0;
    std::size_t period = 0;
    Eigen::ArrayXd means;
  };
  std::vector<Best> best(folds_);
  for (std::size_t i = 0; i < periods; ++i) {
    const auto by_fold = sums_by_fold(y, i);
    const Sums all = sum_of(by_fold);
    for (std::size_t f = 0; f < folds_; ++f) {
      const Eigen::ArrayXd others = all.y - by_fold[f].y, rows = all.count - by_fold[f].count + moments_of_zero;
      const double gain = (others * others / rows).sum();
      if (gain > best[f].gain) best[f] = {gain, i, others / rows};
    }
  }
  Vector predicted(y.size());
  for (std::size_t k = 0; k < run_.size(); ++k) {
    const auto& of = best[fold_[k]];
    predicted[static_cast<Index>(k)] = of.means[static_cast<Index>(place(of.period, k))];
  }
  return predicted;
}

double Folded::period_s(const Vector& y) const {
  constexpr std::size_t most_times = 6;
  constexpr double as_good = 0.9;  // folded at twice its period a pulse is there twice, and noise decides
  Eigen::ArrayXd gain(static_cast<Index>(periods));
  for (std::size_t i = 0; i < periods; ++i) {
    const auto by_fold = sums_by_fold(y, i);
    const Sums all = sum_of(by_fold);
    gain[static_cast<Index>(i)] = (all.y * all.y / (all.count + moments_of_zero)).sum();
  }
  Index best = 0;
  const double most = gain.maxCoeff(&best);
  const double times_Hz = 1.0 / period_at(static_cast<std::size_t>(best));
  for (std::size_t times = most_times; times > 1; --times) {
    const auto middle = std::lround((static_cast<double>(times) * times_Hz - slowest_Hz) / fold_step_Hz);
    const auto about = static_cast<Index>(times);  // as many steps as one of the slower
    if (middle + about >= gain.size()) continue;
    Index there = 0;
    if (gain.segment(middle - about, 2 * about + 1).maxCoeff(&there) > as_good * most)
      return period_at(static_cast<std::size_t>(middle - about + there));
  }
  return period_at(static_cast<std::size_t>(best));
}

}  // namespace feedtwin::tools::diagnosis
