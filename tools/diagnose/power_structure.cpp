#include "tools/diagnose/power_structure.h"

#include <algorithm>

#include "tools/linear_systems.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t power_folds = 4;
constexpr double stretch_s = 0.73;  // no motion repeats in step with it
constexpr Index least_rows_a_column = 5;

/// What the drive's power is made of, row by row.
Eigen::MatrixXd powers(const Track& track) {
  Eigen::MatrixXd all(track.size, std::tuple_size_v<DrivePowers>);
  for (Index k = 0; k < track.size; ++k) {
    const auto now = drive_powers(track.held_N[k], track.metered_m_per_s[k]);
    all.row(k) = Eigen::Map<const Eigen::RowVectorXd>(now.data(), all.cols());
  }
  return all;
}

}  // namespace

PowerStructure::PowerStructure(const InverseModel& model) {
  std::vector<Eigen::RowVectorXd> means;
  for (const auto& segment : model.segments()) {
    if (!model.equations()[segment.equation].power) continue;
    const Track& track = model.tracks()[segment.run];
    const Eigen::MatrixXd all = powers(track);
    for (Index i = 0; i < segment.size; ++i) {
      rows_.push_back(segment.start + i);
      means.push_back(all.middleRows(track.meter.starts[static_cast<std::size_t>(i)], track.meter.length).colwise().mean());
      const double t = static_cast<double>(model.sample_of(segment, i)) * track.sample_s;
      folds_.push_back((static_cast<std::size_t>(t / stretch_s) + segment.run) % power_folds);
    }
  }
  if (means.empty() || static_cast<Index>(means.size()) < least_rows_a_column * means.front().size()) {
    rows_.clear();
    return;
  }
  columns_.resize(static_cast<Index>(means.size()), means.front().size());
  for (std::size_t i = 0; i < means.size(); ++i) columns_.row(static_cast<Index>(i)) = means[i];
  for (Index c = 0; c < columns_.cols(); ++c) columns_.col(c) /= std::max(columns_.col(c).norm(), 1e-300);
}

Vector PowerStructure::part_of(const Vector& residual) const {
  Vector part = Vector::Zero(residual.size());
  if (rows_.empty()) return part;
  const Vector y = residual(rows_);
  Vector predicted(y.size());
  for (std::size_t f = 0; f < power_folds; ++f) {
    std::vector<Index> own, others;
    for (std::size_t i = 0; i < folds_.size(); ++i) (folds_[i] == f ? own : others).push_back(static_cast<Index>(i));
    const Eigen::MatrixXd seen = columns_(others, Eigen::all);
    Eigen::MatrixXd normal = seen.transpose() * seen;
    normal.diagonal().array() += 1e-9;
    predicted(own) = columns_(own, Eigen::all) * solved(normal, seen.transpose() * y(others));
  }
  if ((y - predicted).squaredNorm() < y.squaredNorm()) part(rows_) = predicted;
  return part;
}

}  // namespace feedtwin::tools::diagnosis
