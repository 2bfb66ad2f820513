#include "tools/diagnose/reading_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "tools/diagnose/moments.h"
#include "tools/diagnose/taken_up.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::array before_s{0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
constexpr std::size_t all_before = before_s.size() + 1;  // beside them all that was read, a leaking charge's
using Earlier = std::array<double, all_before>;

struct ReadingPart {
  Follows follows;
  Index width;
};
constexpr std::array reading_parts{ReadingPart{Follows::reading, 20}, ReadingPart{Follows::reading_before, all_before},
                                   ReadingPart{Follows::place, 40},   ReadingPart{Follows::speed, 20},
                                   ReadingPart{Follows::motion, 44},  ReadingPart{Follows::use, 2 * fading_s.size()},
                                   ReadingPart{Follows::drive, 24}};

/// m' = (y - m) / T of what should be read, by time constant; last the sum of what was read in fact. A row a row.
std::vector<Earlier> lately(const Vector& should, const Vector& read, Index samples_a_row, double row_s) {
  std::vector<Earlier> all(static_cast<std::size_t>(should.size()));
  all.front().fill(should[0]), all.front().back() = 0.0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    const auto row = static_cast<Index>(k);
    for (std::size_t i = 0; i < before_s.size(); ++i)
      all[k][i] = all[k - 1][i] + (should[row] - all[k - 1][i]) * row_s / (before_s[i] + row_s);
    all[k].back() = all[k - 1].back() + read.segment((row - 1) * samples_a_row, samples_a_row).sum();
  }
  return all;
}

/// Of each quantity, the largest that there is.
struct ReadingRanges {
  double low_m = 1e300, high_m = -1e300, fastest = 1e-9, hardest = 1e-9, strongest_N = 1e-9, most_W = 1e-9, least = 1e300,
         most = -1e300;
  void take(const Moment& m, double reading) {
    low_m = std::min(low_m, m.position_m), high_m = std::max(high_m, m.position_m);
    fastest = std::max(fastest, std::abs(m.velocity_m_per_s));
    hardest = std::max(hardest, std::abs(m.acceleration_m_per_s2));
    strongest_N = std::max(strongest_N, std::abs(m.command_N));
    most_W = std::max(most_W, std::abs(m.command_N * m.velocity_m_per_s));
    least = std::min(least, reading), most = std::max(most, reading);
  }
};

Vector column_of_reading(const Moment& m, double reading, const Earlier& before, const ReadingRanges& all) {
  Index width = 0;
  for (const auto& part : reading_parts) width += part.width;
  Vector row = Vector::Zero(width);
  const bool forth = m.velocity_m_per_s > 0.0;
  Index from = 0;
  add_hats(reading, all.least, all.most, reading_parts[0].width, 1.0, row, from);
  from += reading_parts[0].width;
  for (const double y : before) row[from++] = y;
  for (const auto& [share, low, high, width_both] :
       {std::tuple{m.position_m, all.low_m, all.high_m, reading_parts[2].width},
        {std::sqrt(std::abs(m.velocity_m_per_s) / all.fastest), 0.0, 1.0, reading_parts[3].width}}) {
    add_hats(share, low, high, width_both / 2, 1.0, row, from + (forth ? 0 : width_both / 2));
    from += width_both;
  }
  const Index pulls = (reading_parts[4].width - past_steps) / 2;
  add_hats(std::cbrt(m.acceleration_m_per_s2 / all.hardest), -1.0, 1.0, pulls, 1.0, row, from + (forth ? 0 : pulls));
  from += 2 * pulls;
  for (const double a : m.past) row[from++] = a / all.hardest;
  for (const auto* lately : {&m.load, &m.use})
    for (const double y : *lately) row[from++] = y;
  const Index each = reading_parts[6].width / 2;
  add_hats(m.command_N / all.strongest_N, -1.0, 1.0, each, 1.0, row, from);
  add_hats(std::cbrt(m.command_N * m.velocity_m_per_s / all.most_W), -1.0, 1.0, each, 1.0, row, from + each);
  return row;
}

/// What was before, each as large as a row of one: a little of it may be of much use.
void scale_what_was_before(Eigen::MatrixXd& columns) {
  for (Index i = 0; i < reading_parts[1].width; ++i) {
    auto before = columns.row(reading_parts[0].width + i);
    before *= std::sqrt(static_cast<double>(before.size())) / std::max(before.norm(), 1e-300);
  }
}

void tell_ways(ReadingRows& rows) {
  Index from = 0;
  AdditiveModel::Columns all;
  for (const auto& [follows, width] : reading_parts) {
    AdditiveModel::Columns columns;
    for (Index c = 0; c < width; ++c) columns.push_back(from + c), all.push_back(from + c);
    rows.ways.push_back(std::move(columns)), rows.follows.push_back(follows);
    from += width;
  }
  rows.ways.push_back(std::move(all)), rows.follows.push_back(Follows::several);
}

void keep_ways(ReadingRows& rows, std::initializer_list<Follows> kept) {
  for (std::size_t i = rows.ways.size(); i-- > 0;)
    if (std::ranges::find(kept, rows.follows[i]) == kept.end())
      rows.ways.erase(rows.ways.begin() + static_cast<Index>(i)),
          rows.follows.erase(rows.follows.begin() + static_cast<Index>(i));
}

/// A row a moment: what the numbers do, the reading itself, the place, and what each run starts with.
Eigen::MatrixXd numbers_of(const std::vector<Moment>& moments, const ReadingRows& rows, std::size_t runs) {
  std::vector<double> accelerations, velocities;
  for (const auto& m : moments) accelerations.push_back(m.acceleration_m_per_s2), velocities.push_back(m.velocity_m_per_s);
  const Eigen::MatrixXd own = columns_of_numbers(accelerations, velocities);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(own.rows(), own.cols() + 2 + static_cast<Index>(runs));
  all.leftCols(own.cols()) = own;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const auto row = static_cast<Index>(k);
    all(row, own.cols()) = rows.reading[k];
    if (rows.channel == channel::scale_position_m) all(row, own.cols() + 1) = moments[k].position_m;
    all(row, own.cols() + 2 + static_cast<Index>(moments[k].run)) = 1.0;
  }
  return all;
}

/// Any force equation's: that of the slip is not asked where the axis has settled.
const Segment& force_rows_of(const InverseModel& model, std::size_t run) {
  return *std::ranges::find_if(model.segments(), [&](const Segment& s) {
    return s.run == run && !model.equations()[s.equation].slip && !model.equations()[s.equation].power;
  });
}

/// A sensor or the command: its own record, the equation behind it and the one before, and from which equation on what is
/// needed of the axis is what it reads.
struct Sensor {
  std::string_view channel;
  double per_unit;
  const Vector Track::* record;
  std::size_t after;
  std::optional<std::size_t> before;
  std::size_t carries_from;
};

/// What the rows of a run should read: less what they show more than the model. With that, noise would follow itself: a
/// force that disturbs the axis is in the command too, and on an axis with nothing hidden 0.29 of it followed "steps" of the
/// command; a sensor's coloured noise follows what was read a moment before, 0.34 of it on another.
Vector should_read(const InverseModel& model, const Sensor& sensor, std::size_t run, const Vector& recorded,
                   const Vector& residual) {
  Vector read = Vector::Zero(force_rows_of(model, run).size);
  for (const auto& s : model.segments()) {
    const auto& e = model.equations()[s.equation];
    if (s.run != run || e.slip || e.power) continue;
    if (s.equation >= sensor.carries_from) read += recorded.segment(s.start, s.size);
    if (s.equation == sensor.after) read -= residual.segment(s.start, s.size);
  }
  return read;
}

ReadingRows rows_of_sensor(const InverseModel& model, const Sensor& sensor, const Vector& residual) {
  ReadingRows rows;
  rows.channel = sensor.channel, rows.per_unit = sensor.per_unit;
  rows.of_force = !model.equations()[sensor.after].slip;
  const Vector recorded = model.recorded();
  std::vector<Moment> moments;
  std::vector<Earlier> earlier;
  ReadingRanges ranges;
  for (const auto& s : model.segments()) {
    if (s.equation != sensor.after) continue;
    const Track& track = model.tracks()[s.run];
    const Vector should = should_read(model, sensor, s.run, recorded, residual);
    const Segment& force_rows = force_rows_of(model, s.run);
    const Index first = model.sample_of(force_rows, 0), step = model.sample_of(force_rows, 1) - first;
    const auto all_earlier =
        lately(should, (track.*(sensor.record)).tail(track.size - first), step, static_cast<double>(step) * track.sample_s);
    const auto of_run = moments_of(model, force_rows);
    for (std::size_t i = 0; i < of_run.rows.size(); ++i) {
      const auto& m = of_run.moments[i];
      rows.after.push_back(s.start + of_run.rows[i]);
      rows.reading.push_back(should[of_run.rows[i]]);
      rows.time_s.push_back(m.time_s), rows.run.push_back(m.run), rows.fold.push_back(m.fold);
      rows.position_m.push_back(m.position_m), rows.velocity_m_per_s.push_back(m.velocity_m_per_s);
      ranges.take(m, rows.reading.back());
      moments.push_back(m), earlier.push_back(all_earlier[static_cast<std::size_t>(of_run.rows[i])]);
    }
    for (const auto& b : model.segments())
      if (sensor.before && b.equation == *sensor.before && b.run == s.run)
        for (const Index i : of_run.rows) rows.before.push_back(b.start + i);
  }
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const Vector column = column_of_reading(moments[k], rows.reading[k], earlier[k], ranges);
    if (k == 0) rows.columns.resize(column.size(), static_cast<Index>(moments.size()));
    rows.columns.col(static_cast<Index>(k)) = column;
  }
  scale_what_was_before(rows.columns);
  tell_ways(rows);
  rows.numbers = numbers_of(moments, rows, model.tracks().size());
  return rows;
}

}  // namespace

std::vector<ReadingRows> rows_of_sensors(const InverseModel& model, double lead_m, const Vector& residual) {
  std::vector<ReadingRows> all;
  const auto& first = model.tracks().front();
  const double Nm_per_N = lead_m / (2.0 * std::numbers::pi);
  const bool torque = first.torque_sensor_N.size() > 0, force = first.force_sensor_N.size() > 0;
  // equations stand in the order of the chain: what is before a sensor, then what is behind it
  const std::size_t last_force = torque + force, behind_torque = 1;
  if (torque)
    all.push_back(rows_of_sensor(
        model, {channel::torque_sensor_Nm, Nm_per_N, &Track::torque_sensor_N, behind_torque, 0, behind_torque}, residual));
  if (force)
    all.push_back(rows_of_sensor(
        model, {channel::force_sensor_N, 1.0, &Track::force_sensor_N, last_force, last_force - 1, last_force}, residual));
  all.push_back(rows_of_sensor(model, {channel::torque_cmd_Nm, Nm_per_N, &Track::command_N, 0, {}, 0}, residual));
  keep_ways(all.back(), {Follows::reading, Follows::reading_before});
  const auto slip = std::ranges::find_if(model.equations(), &Equation::slip);
  const auto carried = force ? &Track::force_sensor_N : torque ? &Track::torque_sensor_N : &Track::command_N;
  if (slip != model.equations().end())
    all.push_back(rows_of_sensor(model,
                                 {channel::scale_position_m,
                                  1.0,
                                  carried,
                                  static_cast<std::size_t>(slip - model.equations().begin()),
                                  {},
                                  last_force},
                                 residual));
  return all;
}

}  // namespace feedtwin::tools::diagnosis
