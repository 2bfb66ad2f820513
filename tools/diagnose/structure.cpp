#include "tools/diagnose/structure.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t folds = 4;

/// A row of the remainder and what may explain it.
struct Moment {
  double force_N, position_m, velocity_m_per_s, acceleration_m_per_s2, since_reversal_s, time_s;
  std::vector<double> past;  ///< accelerations before
  std::size_t run, fold;
};

constexpr int past_steps = 24;
constexpr double past_step_s = 0.012, stretch_s = 1.0;

std::vector<Moment> moments_of(const InverseModel& model, const Candidate& at) {
  const Vector residual = model.residual(at.axis, at.effects);
  std::vector<Moment> all;
  for (std::size_t run = 0; run < model.tracks().size(); ++run) {
    const Track& track = model.tracks()[run];
    Vector sum;
    const Segment* any = nullptr;
    for (const auto& s : model.segments()) {
      const auto& e = model.equations()[s.equation];
      if (s.run != run || s.size == 0 || e.slip || e.power) continue;
      add(sum, residual.segment(s.start, s.size));
      any = &s;
    }
    if (any == nullptr) continue;
    const Index step = std::max<Index>(1, std::lround(past_step_s / track.sample_s));
    const auto acceleration = [&](Index k) {  // over two steps about k
      const Index a = std::clamp<Index>(k - step / 2, 0, track.size - 1),
                  b = std::clamp<Index>(k + step / 2, 0, track.size - 1);
      return b > a ? (track.centred_m_per_s[b] - track.centred_m_per_s[a]) / (static_cast<double>(b - a) * track.sample_s)
                   : 0.0;
    };
    for (Index i = 0; i < any->size; ++i) {
      if (!model.settled(any->start + i)) continue;
      const Index k = model.sample_of(*any, i);
      const double t = static_cast<double>(k) * track.sample_s;
      Moment m{sum[i],
               track.position_m[k],
               track.centred_m_per_s[k],
               acceleration(k),
               track.since_reversal_s[k],
               t,
               {},
               run,
               (static_cast<std::size_t>(t / stretch_s) + run) % folds};
      for (int j = 0; j < past_steps; ++j) m.past.push_back(acceleration(std::max<Index>(0, k - j * step)));
      all.push_back(std::move(m));
    }
  }
  return all;
}

/// Hat functions over a range: adds them, times a weight, to one row.
void hats(double x, double low, double high, Index count, double weight, Eigen::Ref<Vector> row, Index from) {
  const double place = std::clamp((x - low) / (high - low + 1e-12), 0.0, 1.0) * static_cast<double>(count - 1);
  const Index i = std::min<Index>(static_cast<Index>(place), count - 2);
  const double share = place - static_cast<double>(i);
  row[from + i] += weight * (1.0 - share);
  row[from + i + 1] += weight * share;
}

Eigen::MatrixXd regressors_of(const std::vector<Moment>& all) {
  constexpr Index places = 30, speeds = 12, times = 8, pulls = 10, beats = 22, runs = 4;
  double low = 1e300, high = -1e300, fastest = 1e-9, hardest = 1e-9;
  for (const auto& m : all) {
    low = std::min(low, m.position_m), high = std::max(high, m.position_m);
    fastest = std::max(fastest, std::abs(m.velocity_m_per_s));
    hardest = std::max(hardest, std::abs(m.acceleration_m_per_s2));
  }
  const Index width = 3 * places + 2 * speeds + 2 * times + 2 * pulls + past_steps + 2 * beats * runs;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(width, static_cast<Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& m = all[k];
    Vector row = Vector::Zero(width);
    const bool forth = m.velocity_m_per_s > 0.0;
    Index from = 0;
    const auto both_ways = [&](double x, double a, double b, Index count) {
      hats(x, a, b, count, 1.0, row, from + (forth ? 0 : count));
      from += 2 * count;
    };
    both_ways(m.position_m, low, high, places);
    hats(m.position_m, low, high, places, m.velocity_m_per_s / fastest, row, from);
    from += places;
    both_ways(std::sqrt(std::abs(m.velocity_m_per_s) / fastest), 0.0, 1.0, speeds);
    both_ways(std::log(std::clamp(m.since_reversal_s, 0.02, 2.0)), std::log(0.02), std::log(2.0), times);
    both_ways(std::cbrt(m.acceleration_m_per_s2 / hardest), -1.0, 1.0, pulls);
    for (int j = 0; j < past_steps; ++j) row[from + j] = m.past[static_cast<std::size_t>(j)] / hardest;
    from += past_steps + 2 * beats * static_cast<Index>(std::min<std::size_t>(m.run, runs - 1));
    for (Index b = 0; b < beats; ++b) {
      const double angle = 2.0 * std::numbers::pi * (0.5 + 0.14 * static_cast<double>(b)) * m.time_s;
      row[from + 2 * b] = (forth ? 1.0 : -1.0) * std::sin(angle);
      row[from + 2 * b + 1] = (forth ? 1.0 : -1.0) * std::cos(angle);
    }
    rows.col(static_cast<Index>(k)) = row;
  }
  return rows;
}

}  // namespace

double Structure::structured_N() const {
  return remainder_N * std::sqrt(std::max(0.0, share));
}

Structure remaining_structure(const InverseModel& model, const Candidate& at) {
  const auto all = moments_of(model, at);
  Structure found;
  if (all.size() < 400) return found;
  const Eigen::MatrixXd rows = regressors_of(all);
  const Index width = rows.rows(), count = rows.cols();
  std::vector<std::vector<Index>> members(folds);
  Vector y(count);
  for (Index k = 0; k < count; ++k) {
    const auto& m = all[static_cast<std::size_t>(k)];
    y[k] = m.force_N;
    members[m.fold].push_back(k);
  }
  std::vector<Eigen::MatrixXd> normal;
  std::vector<Vector> right;
  for (const auto& own : members) {
    const Eigen::MatrixXd part = rows(Eigen::all, own);
    normal.push_back(part * part.transpose());
    right.push_back(part * y(own));
  }
  double after = 0.0;
  for (std::size_t f = 0; f < folds; ++f) {
    Eigen::MatrixXd n = Eigen::MatrixXd::Zero(width, width);
    Vector r = Vector::Zero(width);
    for (std::size_t g = 0; g < folds; ++g)
      if (g != f) n += normal[g], r += right[g];
    for (Index i = 0; i < width; ++i) n(i, i) += 10.0 + 0.02 * n(i, i);  // as if ten more rows had said zero
    const Vector weight = n.ldlt().solve(r);
    for (const Index k : members[f]) after += std::pow(y[k] - weight.dot(rows.col(k)), 2);
  }
  const double before = y.squaredNorm();
  found.remainder_N = std::sqrt(before / static_cast<double>(count));
  found.share = before > 0.0 ? 1.0 - after / before : 0.0;
  return found;
}

}  // namespace feedtwin::tools::diagnosis
