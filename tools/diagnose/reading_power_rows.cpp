// The power meter's rows: a window each.

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/diagnose/reading_rows.h"
#include "tools/identify/sliding.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double stretch_of_windows_s = 0.73;  // no motion repeats in step with it
constexpr std::size_t power_folds = 4;
constexpr Index window_readings = 8, window_places = 16, window_speeds = 12, window_commands = 8, window_rests = 8;

/// What the drive's power is made of, sample by sample.
Eigen::MatrixXd powers_of(const Track& track) {
  Eigen::MatrixXd all(track.size, std::tuple_size_v<DrivePowers>);
  for (Index k = 0; k < track.size; ++k) {
    const auto now = drive_powers(track.held_N[k], track.metered_m_per_s[k]);
    all.row(k) = Eigen::Map<const Eigen::RowVectorXd>(now.data(), all.cols());
  }
  return all;
}

struct WindowRanges {
  Travel travel;
  double fastest = 1e-9, strongest_N = 1e-9, least_W = 1e300, most_W = -1e300;
  explicit WindowRanges(const std::vector<Track>& tracks) : travel(travel_of(tracks, &Track::position_m)) {
    for (const auto& t : tracks) {
      fastest = std::max(fastest, t.steady_m_per_s.cwiseAbs().maxCoeff());
      strongest_N = std::max(strongest_N, t.held_N.cwiseAbs().maxCoeff());
      for (const double p : t.meter.power_W) least_W = std::min(least_W, p), most_W = std::max(most_W, p);
    }
  }
};

/// How long the axis has stood, s, sample by sample: a drive goes to sleep, a brake's coil is let go.
Vector stood_s(const Track& track) {
  Vector stood = Vector::Zero(track.size);
  for (Index k = 1; k < track.size; ++k)
    stood[k] = std::abs(track.steady_m_per_s[k]) < standstill_m_per_s ? stood[k - 1] + track.sample_s : 0.0;
  return stood;
}

/// Means over a window, and what is read over it.
Vector column_of_window(const Track& track, const Vector& stood, std::size_t window, double reading_W,
                        const WindowRanges& all) {
  constexpr double soon_s = 0.03, late_s = 3.0;
  Vector row = Vector::Zero(window_readings + window_places + window_speeds + window_commands + window_rests);
  add_hats(reading_W, all.least_W, all.most_W, window_readings, 1.0, row, 0);
  const double each = 1.0 / static_cast<double>(track.meter.length);
  for (Index k = track.meter.starts[window]; k < track.meter.starts[window] + track.meter.length; ++k) {
    const double v = track.steady_m_per_s[k];
    add_hats(track.position_m[k], all.travel.low_m, all.travel.high_m, window_places, each, row, window_readings);
    add_hats(std::sqrt(std::abs(v) / all.fastest), 0.0, 1.0, window_speeds / 2, each, row,
             window_readings + window_places + (v > 0.0 ? 0 : window_speeds / 2));
    add_hats(track.held_N[k] / all.strongest_N, -1.0, 1.0, window_commands, each, row,
             window_readings + window_places + window_speeds);
    add_hats(std::log(std::clamp(stood[k], soon_s, late_s)), std::log(soon_s), std::log(late_s), window_rests, each, row,
             window_readings + window_places + window_speeds + window_commands);
  }
  return row;
}

/// What the power's numbers do in a window. What the drive draws at rest, the first of them, is each run's own: a run's mean
/// is no time that it keeps.
Eigen::RowVectorXd numbers_of_window(const Eigen::Ref<const Eigen::MatrixXd>& powers, std::size_t run, std::size_t runs) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(powers.cols() - 1 + static_cast<Index>(runs));
  row.head(powers.cols() - 1) = powers.rightCols(powers.cols() - 1).colwise().mean();
  row[powers.cols() - 1 + static_cast<Index>(run)] = 1.0;
  return row;
}

}  // namespace

std::vector<ReadingRows> rows_of_power(const InverseModel& model, const Vector& residual) {
  ReadingRows rows;
  rows.channel = channel::power_W, rows.rows_of_zero = 2.0;
  const WindowRanges ranges(model.tracks());
  const std::size_t runs = model.tracks().size();
  std::vector<Vector> columns;
  std::vector<Eigen::RowVectorXd> numbers;
  for (const auto& s : model.segments()) {
    if (!model.equations()[s.equation].power) continue;
    const Track& track = model.tracks()[s.run];
    const Eigen::MatrixXd powers = powers_of(track);
    const Vector stood = stood_s(track);
    for (Index i = 0; i < s.size; ++i) {
      const auto window = static_cast<std::size_t>(i);
      const double t = static_cast<double>(model.sample_of(s, i)) * track.sample_s;
      rows.after.push_back(s.start + i);
      rows.reading.push_back(track.meter.power_W[window] - residual[s.start + i]);
      rows.time_s.push_back(t), rows.run.push_back(s.run);
      rows.position_m.push_back(track.position_m.segment(track.meter.starts[window], track.meter.length).mean());
      rows.velocity_m_per_s.push_back(track.steady_m_per_s.segment(track.meter.starts[window], track.meter.length).mean());
      rows.fold.push_back((static_cast<std::size_t>(t / stretch_of_windows_s) + s.run) % power_folds);
      columns.push_back(column_of_window(track, stood, window, rows.reading.back(), ranges));
      numbers.push_back(numbers_of_window(powers.middleRows(track.meter.starts[window], track.meter.length), s.run, runs));
    }
  }
  if (columns.empty()) return {};
  rows.columns.resize(columns.front().size(), static_cast<Index>(columns.size()));
  rows.numbers.resize(rows.columns.cols(), numbers.front().size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    rows.columns.col(static_cast<Index>(k)) = columns[k], rows.numbers.row(static_cast<Index>(k)) = numbers[k];
  for (Index c = 0; c < rows.numbers.cols(); ++c) rows.numbers.col(c) /= std::max(rows.numbers.col(c).norm(), 1e-300);
  Index from = 0;
  for (const auto& [follows, width] : {std::pair{Follows::reading, window_readings},
                                       {Follows::place, window_places},
                                       {Follows::speed, window_speeds},
                                       {Follows::motion, window_commands},
                                       {Follows::rest, window_rests}}) {
    AdditiveModel::Columns part;
    for (Index c = 0; c < width; ++c) part.push_back(from + c);
    rows.ways.push_back(std::move(part)), rows.follows.push_back(follows);
    from += width;
  }
  return {std::move(rows)};
}

}  // namespace feedtwin::tools::diagnosis
