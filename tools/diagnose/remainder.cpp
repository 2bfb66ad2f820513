#include "tools/diagnose/remainder.h"

#include <cmath>

#include "tools/diagnose/taken_up.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr auto of_each_row = {&Remainder::force_N, &Remainder::position_m, &Remainder::velocity_m_per_s,
                              &Remainder::acceleration_m_per_s2, &Remainder::since_reversal_s};

Eigen::Map<Vector> force(Remainder& rows) {
  return {rows.force_N.data(), static_cast<Index>(rows.size())};
}

}  // namespace

Remainder Remainder::part(std::size_t which, bool of_it) const {
  Remainder some;
  some.folds = folds;
  for (std::size_t k = 0; k < size(); ++k) {
    if ((fold[k] == which) != of_it) continue;
    for (auto column : of_each_row) (some.*column).push_back((this->*column)[k]);
    some.fold.push_back(fold[k]);
  }
  return some;
}

Remainder remainder_of(const InverseModel& model, const Candidate& at, Forces which) {
  const Vector residual = model.residual(at.axis, at.effects);
  const bool alone = model.tracks().size() == 1;
  Remainder rows;
  rows.folds = alone ? 2 : model.tracks().size();
  for (std::size_t run = 0; run < model.tracks().size(); ++run) {
    Vector sum;
    const Segment* any = nullptr;
    for (const auto& s : model.segments()) {
      const auto& e = model.equations()[s.equation];
      if (s.run != run || s.size == 0 || e.slip || e.power) continue;
      if (which == Forces::of_the_table && !tables_own(e)) continue;
      add(sum, residual.segment(s.start, s.size));
      any = &s;
    }
    const Track& track = model.tracks()[run];
    for (Index i = 0; any != nullptr && i < any->size; ++i) {
      const Index k = model.sample_of(*any, i);
      if (std::abs(track.centred_m_per_s[k]) < 5.0 * standstill_m_per_s) continue;
      rows.force_N.push_back(sum[i]);
      rows.position_m.push_back(track.position_m[k]);
      rows.velocity_m_per_s.push_back(track.centred_m_per_s[k]);
      rows.acceleration_m_per_s2.push_back(slow_acceleration_m_per_s2(track, k));
      rows.since_reversal_s.push_back(track.since_reversal_s[k]);
      const auto second = static_cast<std::size_t>(static_cast<double>(k) * track.sample_s);
      rows.fold.push_back(alone ? second % 2 : run);
    }
  }
  return rows;
}

void take_off_numbers(Remainder& rows, Remainder* others) {
  // As if so many rows, as they are of all, had said that the numbers are right: what slow runs hold of a mass or a damping
  // is noise, and was 8.2 N beside 0.8 N on the fast run that it was taken off from.
  constexpr double rows_of_right_numbers = 20.0;
  const auto of = [](const Remainder& r) { return columns_of_numbers(r.acceleration_m_per_s2, r.velocity_m_per_s); };
  const Eigen::MatrixXd own = of(rows), theirs = others != nullptr ? of(*others) : own;
  const Vector squares = own.colwise().squaredNorm() + theirs.colwise().squaredNorm();
  Eigen::MatrixXd normal = own.transpose() * own;
  normal.diagonal() += rows_of_right_numbers / static_cast<double>(own.rows() + theirs.rows()) * squares;
  const Vector numbers = solved(normal, own.transpose() * force(rows));
  force(rows) -= own * numbers;
  if (others != nullptr) force(*others) -= theirs * numbers;
}

}  // namespace feedtwin::tools::diagnosis
