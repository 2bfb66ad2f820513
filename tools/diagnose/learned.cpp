#include "tools/diagnose/learned.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "plant/effects/registry.h"
#include "tools/diagnose/taken_up.h"

namespace feedtwin::tools::diagnosis {
namespace {

struct Rows {
  std::vector<double> remainder_N, position_m, velocity_m_per_s, acceleration_m_per_s2, since_reversal_s;
};

/// Sum of the force equations' residuals, with where the axis was.
Rows force_rows(const InverseModel& model, const Candidate& at) {
  const Vector residual = model.residual(at.axis, at.effects);
  Rows rows;
  for (std::size_t run = 0; run < model.tracks().size(); ++run) {
    Vector sum;
    const Segment* any = nullptr;
    for (const auto& s : model.segments()) {
      const auto& e = model.equations()[s.equation];
      if (s.run != run || s.size == 0 || e.slip || e.power) continue;
      add(sum, residual.segment(s.start, s.size));
      any = &s;
    }
    const Track& track = model.tracks()[run];
    for (Index i = 0; any != nullptr && i < any->size; ++i) {
      const Index k = model.sample_of(*any, i);
      if (std::abs(track.centred_m_per_s[k]) < 5.0 * standstill_m_per_s) continue;
      rows.remainder_N.push_back(sum[i]);
      rows.position_m.push_back(track.position_m[k]);
      rows.velocity_m_per_s.push_back(track.centred_m_per_s[k]);
      rows.acceleration_m_per_s2.push_back(slow_acceleration_m_per_s2(track, k));
      rows.since_reversal_s.push_back(track.since_reversal_s[k]);
    }
  }
  return rows;
}

/// Takes off what the numbers could do of the rows to learn from, and as much of the others.
void take_off_numbers(Rows& rows, Rows& others) {
  const auto columns = [](const Rows& r) { return columns_of_numbers(r.acceleration_m_per_s2, r.velocity_m_per_s); };
  const auto remainder = [](Rows& r) {
    return Eigen::Map<Vector>(r.remainder_N.data(), static_cast<Index>(r.remainder_N.size()));
  };
  const Vector numbers = columns(rows).colPivHouseholderQr().solve(remainder(rows));
  for (Rows* some : {&rows, &others}) remainder(*some) -= columns(*some) * numbers;
}

std::vector<double> arguments(const Rows& rows, Where axis) {
  if (axis == Where::position) return rows.position_m;
  if (axis == Where::reversal) return rows.since_reversal_s;
  std::vector<double> speeds = rows.velocity_m_per_s;
  for (double& v : speeds) v = std::abs(v);
  return speeds;
}

std::vector<double> points_for(const std::vector<double>& x, Where axis) {
  const auto [low, high] = std::ranges::minmax(x);
  if (axis == Where::reversal) return {0.0, 0.004, 0.008, 0.016, 0.03, 0.06, 0.12, 0.25, 0.5};
  const int count = axis == Where::position ? 40 : 16;
  std::vector<double> points;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    points.push_back(low + (high - low) * (axis == Where::velocity ? share * share : share));
  }
  return points;
}

/// Weights of the two points about x, constant beyond the ends.
std::pair<std::size_t, double> between(const std::vector<double>& points, double x) {
  const auto above = std::ranges::upper_bound(points, x);
  if (above == points.begin()) return {0, 0.0};
  if (above == points.end()) return {points.size() - 2, 1.0};
  const auto i = static_cast<std::size_t>(above - points.begin()) - 1;
  return {i, (x - points[i]) / (points[i + 1] - points[i])};
}

double read(const Learned& table, double x, double v) {
  const auto& force = v > 0.0 ? table.force_pos_N : table.force_neg_N;
  const auto [i, share] = between(table.points, x);
  return (1.0 - share) * force[i] + share * force[i + 1];
}

Learned learn(const Rows& rows, Where axis) {
  Learned table;
  table.axis = axis;
  const auto x = arguments(rows, axis);
  table.points = points_for(x, axis);
  const auto n = static_cast<Index>(table.points.size());
  for (const bool forth : {true, false}) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) * 20.0;  // as if twenty rows had said zero
    Vector right = Vector::Zero(n);
    for (std::size_t k = 0; k < x.size(); ++k) {
      if ((rows.velocity_m_per_s[k] > 0.0) != forth) continue;
      const auto [at, share] = between(table.points, x[k]);
      const auto i = static_cast<Index>(at);
      normal(i, i) += (1.0 - share) * (1.0 - share);
      normal(i + 1, i + 1) += share * share;
      normal(i, i + 1) += share * (1.0 - share);
      normal(i + 1, i) += share * (1.0 - share);
      right[i] += (1.0 - share) * rows.remainder_N[k];
      right[i + 1] += share * rows.remainder_N[k];
    }
    const Vector force = normal.ldlt().solve(right);
    (forth ? table.force_pos_N : table.force_neg_N).assign(force.data(), force.data() + n);
  }
  return table;
}

void judge(Learned& table, const Rows& rows) {
  const auto x = arguments(rows, table.axis);
  double before = 0.0, after = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double r = rows.remainder_N[k];
    before += r * r;
    after += std::pow(r - read(table, x[k], rows.velocity_m_per_s[k]), 2);
  }
  table.share_held_out = before > 0.0 ? 1.0 - after / before : 0.0;
  table.remainder_N = std::sqrt(before / static_cast<double>(std::max<std::size_t>(1, x.size())));
  double largest = 0.0;
  for (std::size_t i = 0; i < table.points.size(); ++i)
    largest = std::max({largest, std::abs(table.force_pos_N[i]), std::abs(table.force_neg_N[i])});
  table.low = table.points.back();
  table.high = table.points.front();
  for (std::size_t i = 0; i < table.points.size(); ++i)
    if (std::max(std::abs(table.force_pos_N[i]), std::abs(table.force_neg_N[i])) > 0.5 * largest) {
      table.low = std::min(table.low, table.points[i]);
      table.high = std::max(table.high, table.points[i]);
    }
}

}  // namespace

Learned learn_remainder(const InverseModel& model, const Candidate& at, const InverseModel& others,
                        const Candidate& of_others) {
  Rows rows = force_rows(model, at), unseen = force_rows(others, of_others);
  Learned best;
  best.share_held_out = -1.0;
  if (rows.remainder_N.size() < 200 || unseen.remainder_N.size() < 50) return best;
  take_off_numbers(rows, unseen);
  for (const Where axis : {Where::position, Where::velocity, Where::reversal}) {
    Learned table = learn(rows, axis);
    judge(table, unseen);
    if (table.share_held_out > best.share_held_out) best = std::move(table);
  }
  return best;
}

void extend(plant::AxisParameters& axis, const Learned& learned) {
  const auto* entry = plant::find_effect("learned_residual");
  if (entry == nullptr) return;
  auto setting = plant::preset_of(*entry);
  const std::string_view over = learned.axis == Where::position   ? "position_m"
                                : learned.axis == Where::velocity ? "velocity_m_per_s"
                                                                  : "since_reversal_s";
  std::size_t list = 0;
  for (const auto& parameter : entry->parameters) {
    if (!parameter.list) continue;
    auto& values = setting.lists.at(list++);
    if (parameter.name == over) values = learned.points;
    if (parameter.name == "force_pos_N") values = learned.force_pos_N;
    if (parameter.name == "force_neg_N") values = learned.force_neg_N;
  }
  axis.effects.push_back(std::move(setting));
}

}  // namespace feedtwin::tools::diagnosis
