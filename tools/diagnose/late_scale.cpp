#include "tools/diagnose/late_scale.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/diagnose/samples_later.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index apart = 4;  // samples to either side that a speed is taken over
constexpr int columns = 4;  // speed; acceleration, direction, place: a screw's, a gap's, a lead's

struct SlipRows {
  Eigen::MatrixXd by;
  Eigen::VectorXd slip_m;
};

/// Every fourth sample of all runs, less each run's mean.
SlipRows slip_rows(const std::vector<Recording>& runs, double shift_s) {
  std::vector<std::array<double, columns + 1>> rows;
  for (const auto& run : runs) {
    const auto x = run.at(channel::position_m), recorded = run.at(channel::scale_position_m);
    const Vector scale = samples_later(recorded, shift_s / run.sample_s);
    const auto whole = static_cast<std::size_t>(apart), margin = whole + static_cast<std::size_t>(0.06 / run.sample_s);
    const std::size_t first = rows.size();
    const double span_s = static_cast<double>(apart) * run.sample_s;
    for (std::size_t k = whole; k + margin < x.size(); k += whole) {
      const double v = (x[k + whole] - x[k - whole]) / (2.0 * span_s);
      const double a = (x[k + whole] - 2.0 * x[k] + x[k - whole]) / (span_s * span_s);
      rows.push_back({v, a, v > 0.0 ? 1.0 : -1.0, x[k], scale[static_cast<Index>(k)] - x[k]});
    }
    std::array<double, columns + 1> mean{};
    for (std::size_t i = first; i < rows.size(); ++i)
      for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += rows[i][c] / static_cast<double>(rows.size() - first);
    for (std::size_t i = first; i < rows.size(); ++i)
      for (std::size_t c = 0; c < mean.size(); ++c) rows[i][c] -= mean[c];
  }
  SlipRows all{Eigen::MatrixXd(static_cast<Index>(rows.size()), columns), Eigen::VectorXd(static_cast<Index>(rows.size()))};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (Index c = 0; c < columns; ++c) all.by(static_cast<Index>(i), c) = rows[i][static_cast<std::size_t>(c)];
    all.slip_m[static_cast<Index>(i)] = rows[i].back();
  }
  return all;
}

}  // namespace

std::optional<LateScale> late_scale(const std::vector<Recording>& runs) {
  constexpr double most_samples = 50.0, least_share = 0.5;
  constexpr double beyond_sampling = 1.1;  // samples: below it is how scales are read
  constexpr std::size_t fewest = 100;
  if (runs.empty() || !runs.front().has(channel::scale_position_m)) return std::nullopt;
  const double sample_s = runs.front().sample_s;
  const SlipRows rows = slip_rows(runs, 0.0);
  if (rows.slip_m.size() < static_cast<Index>(fewest)) return std::nullopt;
  const Eigen::VectorXd found = least_squares(rows.by, rows.slip_m);
  const Eigen::MatrixXd others = rows.by.rightCols(columns - 1);
  const double without = (rows.slip_m - others * least_squares(others, rows.slip_m)).squaredNorm();
  const double with = (rows.slip_m - rows.by * found).squaredNorm();
  const double delay_s = -found[0];
  if (with > (1.0 - least_share) * without || delay_s < beyond_sampling * sample_s || delay_s > most_samples * sample_s)
    return std::nullopt;
  // once more about what was found, where the curve of the motion is no matter
  const SlipRows left = slip_rows(runs, delay_s);
  const Eigen::VectorXd rest = least_squares(left.by, left.slip_m);
  const double noise = (left.slip_m - left.by * rest).squaredNorm() / static_cast<double>(left.slip_m.size());
  return LateScale{delay_s - rest[0], std::sqrt(noise * inverse_of(left.by.transpose() * left.by)(0, 0))};
}

void bring_forward(Recording& run, const LateScale& late) {
  const auto found = run.channels.find(channel::scale_position_m);
  if (found == run.channels.end()) return;
  auto& scale = found->second;
  const auto x = run.at(channel::position_m);
  const double samples = late.delay_s / run.sample_s;
  const Vector shifted = samples_later(scale, samples);
  std::vector<double> later(shifted.begin(), shifted.end());
  const auto shown = scale.size() - std::min(scale.size(), static_cast<std::size_t>(samples) + 2);
  for (std::size_t k = std::max<std::size_t>(1, shown); k < later.size() && k < x.size(); ++k)
    later[k] = later[k - 1] + x[k] - x[k - 1];  // what it would have shown is not recorded
  scale = std::move(later);
}

}  // namespace feedtwin::tools::diagnosis
