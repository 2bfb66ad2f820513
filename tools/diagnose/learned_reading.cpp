#include "tools/diagnose/learned_reading.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plant/effects/registry.h"
#include "plant/effects/table.h"
#include "tools/linear_systems.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools::diagnosis {
namespace {

using plant::effects::on_line;
using plant::effects::place_in;

constexpr double least_share_in_plant = 0.1;  // as of a table of force
constexpr double zeros = 5.0;

/// A table over one quantity of the rows.
struct Over {
  Follows what;
  double period;
  std::vector<double> at;  ///< of each row
  std::size_t count;       ///< points
};

std::vector<Over> tables_for(const ReadingRows& rows, const Vector& misfit, double step, double cycle_s) {
  std::vector<Over> all;
  std::vector<double> read = rows.reading;
  if (rows.channel == channel::torque_cmd_Nm)  // what is told is what is needed and the misfit
    for (std::size_t k = 0; k < read.size(); ++k) read[k] += misfit[static_cast<Index>(k)];
  if (rows.channel != channel::scale_position_m) {  // whose plant knows no force of the screw
    all.push_back({Follows::reading, 0.0, read, 40});
    if (step > 0.0) all.push_back({Follows::reading, step, read, 24});
  }
  if (rows.channel == channel::torque_cmd_Nm) return all;
  all.push_back({Follows::place, 0.0, rows.position_m, 40});
  all.push_back({Follows::speed, 0.0, rows.velocity_m_per_s, 32});
  if (cycle_s > 0.0) all.push_back({Follows::time, cycle_s, rows.time_s, 24});
  return all;
}

std::vector<double> points_over(const Over& over) {
  const auto [least, most] = std::ranges::minmax(over.at);
  const double low = over.period > 0.0 ? 0.0 : least, range = over.period > 0.0 ? over.period : most - least;
  const auto gaps = static_cast<double>(over.period > 0.0 ? over.count : over.count - 1);
  std::vector<double> points;
  for (std::size_t i = 0; i < over.count; ++i) points.push_back(low + range * static_cast<double>(i) / gaps);
  return points;
}

/// Of the rows that are chosen. @return what is added at each point
std::vector<double> learn_table(const Over& over, const std::vector<double>& points, const Vector& misfit,
                                const std::vector<bool>& chosen) {
  const auto n = static_cast<Index>(points.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) * zeros;
  Vector right = Vector::Zero(n);
  for (std::size_t k = 0; k < over.at.size(); ++k) {
    if (!chosen[k]) continue;
    const auto p = place_in(points, over.at[k], over.period);
    const std::pair<Index, double> row[] = {{static_cast<Index>(p.below), 1.0 - p.share},
                                            {static_cast<Index>(p.above), p.share}};
    for (const auto& [i, a] : row) {
      for (const auto& [j, b] : row) normal(i, j) += a * b;
      right[i] += a * misfit[static_cast<Index>(k)];
    }
  }
  const Vector found = solved(normal, right);
  return {found.data(), found.data() + n};
}

/// Quarter-seconds in turn; runs for a clock, which each may have met at another time.
const std::vector<std::size_t>& turns_of(const ReadingRows& rows, const Over& over) {
  return over.what == Follows::time && *std::ranges::max_element(rows.run) > 0 ? rows.run : rows.fold;
}

double share_of_others(const Over& over, const std::vector<double>& points, const Vector& misfit,
                       const std::vector<std::size_t>& fold) {
  double left = 0.0;
  for (std::size_t f = 0; f <= *std::ranges::max_element(fold); ++f) {
    std::vector<bool> others;
    for (const std::size_t one : fold) others.push_back(one != f);
    const auto added = learn_table(over, points, misfit, others);
    for (std::size_t k = 0; k < fold.size(); ++k)
      if (fold[k] == f)
        left += std::pow(misfit[static_cast<Index>(k)] - on_line(added, place_in(points, over.at[k], over.period)), 2);
  }
  return 1.0 - left / (misfit.squaredNorm() + 1e-300);
}

std::string_view list_of_points(Follows over) {
  switch (over) {
    case Follows::place:
      return "position_m";
    case Follows::speed:
      return "velocity_m_per_s";
    case Follows::time:
      return "time_s";
    default:
      return "reading";
  }
}

}  // namespace

std::optional<LearnedReading> learn_reading(const ReadingRows& rows, const Vector& misfit, double step, double cycle_s) {
  std::optional<LearnedReading> best;
  const std::vector<bool> all(rows.fold.size(), true);
  for (const auto& over : tables_for(rows, misfit, step, cycle_s)) {
    const auto [least, most] = std::ranges::minmax(over.at);
    if (!(most > least)) continue;  // a quantity that never changes tells nothing
    const auto points = points_over(over);
    const double share = share_of_others(over, points, misfit, turns_of(rows, over));
    if (share < (best ? best->share_unseen : least_share_in_plant)) continue;
    best = {rows.channel, over.what, over.period, points, learn_table(over, points, misfit, all), share};
  }
  if (!best) return best;
  const double told = best->channel == channel::torque_cmd_Nm ? -1.0 : 1.0;  // what is told too much the drive makes less
  for (double& y : best->added) y *= told * rows.per_unit;
  if (best->over == Follows::reading) {
    best->period *= rows.per_unit;
    for (double& x : best->points) x *= rows.per_unit;
  }
  return best;
}

void extend(plant::AxisParameters& axis, const LearnedReading& learned) {
  const bool command = learned.channel == channel::torque_cmd_Nm;
  const auto& entry = *plant::find_effect(command ? "learned_command" : "learned_reading");
  auto setting = plant::preset_of(entry);
  setting.values.front() = learned.period;
  const std::string_view points = command ? "torque_cmd_Nm" : list_of_points(learned.over);
  const std::string_view added = command ? "torque_Nm" : learned.channel;
  std::size_t list = 0;
  for (const auto& parameter : entry.parameters) {
    if (!parameter.list) continue;
    auto& values = setting.lists.at(list++);
    if (parameter.name == points) values = learned.points;
    if (parameter.name == added) values = learned.added;
  }
  axis.effects.push_back(std::move(setting));
}

}  // namespace feedtwin::tools::diagnosis
