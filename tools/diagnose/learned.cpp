#include "tools/diagnose/learned.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plant/effects/registry.h"
#include "plant/effects/table.h"
#include "tools/diagnose/remainder.h"
#include "tools/diagnose/size_of_axis.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

using plant::effects::on_line;
using plant::effects::place_in;

constexpr std::size_t fewest_to_learn = 200, fewest_to_judge = 50;

/// A table over one of the axes, with a force at each point or a force and a damping; as if so many rows had said zero.
struct TableKind {
  Where axis;
  bool damped;
  double rows_of_zero;
};
constexpr TableKind kinds[] = {{Where::position, false, 20.0}, {Where::position, true, 20.0}, {Where::velocity, false, 20.0},
                               {Where::reversal, false, 20.0}, {Where::position, false, 2.0}, {Where::position, true, 2.0}};

double argument(const Remainder& rows, Where axis, std::size_t k) {
  if (axis == Where::position) return rows.position_m[k];
  return axis == Where::reversal ? rows.since_reversal_s[k] : std::abs(rows.velocity_m_per_s[k]);
}

std::vector<double> points_for(const Remainder& rows, Where axis) {
  if (axis == Where::reversal) return {0.0, 0.004, 0.008, 0.016, 0.03, 0.06, 0.12, 0.25, 0.5};
  double low = argument(rows, axis, 0), high = low;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    low = std::min(low, argument(rows, axis, k));
    high = std::max(high, argument(rows, axis, k));
  }
  const int count = axis == Where::position ? 40 : 16;
  std::vector<double> points;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    points.push_back(low + (high - low) * (axis == Where::velocity ? share * share : share));
  }
  return points;
}

double read(const Learned& table, double x, double v) {
  const auto place = place_in(table.points, x);
  const bool forth = v > 0.0;
  const auto& damping = forth ? table.damping_pos_Ns_per_m : table.damping_neg_Ns_per_m;
  const double force_N = on_line(forth ? table.force_pos_N : table.force_neg_N, place);
  return damping.empty() ? force_N : force_N + on_line(damping, place) * std::abs(v);
}

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

Learned learn(const Remainder& rows, const TableKind& kind) {
  Learned table;
  table.axis = kind.axis;
  table.points = points_for(rows, kind.axis);
  const auto n = static_cast<Index>(table.points.size()), unknowns = kind.damped ? 2 * n : n;
  const double usual_m_per_s = rms(rows.velocity_m_per_s);
  for (const bool forth : {true, false}) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(unknowns, unknowns) * kind.rows_of_zero;
    Vector right = Vector::Zero(unknowns);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double v = rows.velocity_m_per_s[k];
      if ((v > 0.0) != forth) continue;
      const auto [below, above, share] = place_in(table.points, argument(rows, kind.axis, k));
      const auto i = static_cast<Index>(below), j = static_cast<Index>(above);
      const double speeds = std::abs(v) / usual_m_per_s;
      const std::pair<Index, double> row[] = {
          {i, 1.0 - share}, {j, share}, {n + i, (1.0 - share) * speeds}, {n + j, share * speeds}};
      for (int a = 0; a < (kind.damped ? 4 : 2); ++a) {
        for (int b = 0; b < (kind.damped ? 4 : 2); ++b) normal(row[a].first, row[b].first) += row[a].second * row[b].second;
        right[row[a].first] += row[a].second * rows.force_N[k];
      }
    }
    const Vector found = solved(normal, right);
    (forth ? table.force_pos_N : table.force_neg_N).assign(found.data(), found.data() + n);
    if (!kind.damped) continue;
    auto& damping = forth ? table.damping_pos_Ns_per_m : table.damping_neg_Ns_per_m;
    for (Index i = n; i < unknowns; ++i) damping.push_back(found[i] / usual_m_per_s);
  }
  return table;
}

/// Rows to learn from and others to judge by, both without what the numbers could do.
struct Fold {
  Remainder seen, unseen;
};

std::vector<Fold> folds_of(const Remainder& all) {
  std::vector<Fold> folds;
  for (std::size_t f = 0; f < all.folds; ++f) {
    Fold fold{all.part(f, false), all.part(f, true)};
    if (fold.seen.size() < fewest_to_learn || fold.unseen.size() < fewest_to_judge) continue;
    take_off_numbers(fold.seen, &fold.unseen);
    folds.push_back(std::move(fold));
  }
  return folds;
}

/// Share of the remainder that such a table explains where it was not learned, and that remainder's RMS.
std::pair<double, double> share_unseen(const std::vector<Fold>& folds, const TableKind& kind) {
  double before = 0.0, after = 0.0, count = 0.0;
  for (const auto& [seen, unseen] : folds) {
    const Learned table = learn(seen, kind);
    for (std::size_t k = 0; k < unseen.size(); ++k) {
      const double r = unseen.force_N[k];
      before += r * r;
      after += std::pow(r - read(table, argument(unseen, kind.axis, k), unseen.velocity_m_per_s[k]), 2);
      count += 1.0;
    }
  }
  return {before > 0.0 ? 1.0 - after / before : -1.0, std::sqrt(before / std::max(1.0, count))};
}

/// Where the table's forces are more than half of the largest, up to half of the way to the next point.
void tell_where(Learned& table, double speed_m_per_s) {
  std::vector<double> size;
  for (const double x : table.points)
    size.push_back(std::max(std::abs(read(table, x, speed_m_per_s)), std::abs(read(table, x, -speed_m_per_s))));
  const double largest = *std::ranges::max_element(size);
  table.low = table.points.back();
  table.high = table.points.front();
  for (std::size_t i = 0; i < table.points.size(); ++i)
    if (size[i] > 0.5 * largest) {
      table.low = std::min(table.low, std::midpoint(table.points[i > 0 ? i - 1 : i], table.points[i]));
      table.high = std::max(table.high, std::midpoint(table.points[i], table.points[std::min(i + 1, size.size() - 1)]));
    }
}

Learned learn_from(Remainder rows) {
  Learned best;
  best.share_unseen = -1.0;
  if (rows.size() < fewest_to_learn) return best;
  const auto folds = folds_of(rows);
  const TableKind* chosen = kinds;
  for (const auto& kind : kinds) {
    const auto [share, remainder_N] = share_unseen(folds, kind);
    if (share > best.share_unseen) best.share_unseen = share, best.remainder_N = remainder_N, chosen = &kind;
  }
  take_off_numbers(rows);
  Learned table = learn(rows, *chosen);
  table.share_unseen = best.share_unseen;
  table.remainder_N = best.remainder_N;
  tell_where(table, rms(rows.velocity_m_per_s));
  return table;
}

}  // namespace

Learned learn_remainder(const InverseModel& model, const Candidate& at) {
  Learned sum = learn_from(remainder_of(model, at, Forces::all));
  Learned table = learn_from(remainder_of(model, at, Forces::of_the_table));
  table.on_the_table = true;
  const auto explained = [](const Learned& l) { return l.share_unseen * l.remainder_N * l.remainder_N; };
  Learned& more = table.share_unseen > 0.0 && explained(table) > explained(sum) ? table : sum;
  more.newton = newton_of(model.nominal());
  return more;
}

std::string in_words(const Learned& learned) {
  return fmt::format("a learned table would explain {:.0f} % of the {:.2g} N left over on runs that it was not learned from",
                     100.0 * learned.share_unseen, learned.remainder_N);
}

void extend(plant::AxisParameters& axis, const Learned& learned) {
  const auto* entry = plant::find_effect("learned_residual");
  if (entry == nullptr) return;
  auto setting = plant::preset_of(*entry);
  const std::string_view over = learned.axis == Where::position   ? "position_m"
                                : learned.axis == Where::velocity ? "velocity_m_per_s"
                                                                  : "since_reversal_s";
  const std::pair<std::string_view, const std::vector<double>*> given[] = {
      {over, &learned.points},
      {"force_pos_N", &learned.force_pos_N},
      {"force_neg_N", &learned.force_neg_N},
      {"damping_pos_Ns_per_m", &learned.damping_pos_Ns_per_m},
      {"damping_neg_Ns_per_m", &learned.damping_neg_Ns_per_m}};
  std::size_t list = 0;
  for (const auto& parameter : entry->parameters) {
    if (!parameter.list) continue;
    auto& values = setting.lists.at(list++);
    for (const auto& [name, points] : given)
      if (parameter.name == name) values = *points;
  }
  axis.effects.push_back(std::move(setting));
}

}  // namespace feedtwin::tools::diagnosis
