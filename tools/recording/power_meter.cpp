#include "tools/recording/power_meter.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "tools/linear_systems.h"
#include "tools/median.h"

namespace feedtwin::tools {
namespace {

// what a drive's power is made of, at last the work given back; and work by what torque was, nearly a row's delay
constexpr int drive_laws = std::tuple_size_v<DrivePowers>, linear_forth = 1, linear_back = 2, work = drive_laws - 2,
              own_laws = drive_laws - 1, laws = drive_laws + 1;
using Laws = Eigen::Array<double, laws, 1>;

/// What a tick's power may be made of, with the work of a torque that lags its command.
Laws laws_of(double torque_Nm, double torque_before_Nm, double v, double rad_per_m) {
  const auto drive = drive_powers(torque_Nm * rad_per_m, v);
  Laws all;
  std::ranges::copy(drive, all.begin());
  all[laws - 1] = (torque_Nm - torque_before_Nm) * rad_per_m * v;
  return all;
}

/// A meter's error is partly of its reading, and then the large ones hide what the small ones tell; or it is not.
enum class Errors { of_readings, alike };

/// Readings of every row, taken together.
MeteredPower in_blocks(std::size_t rows) {
  MeteredPower meter{.rows = {}, .window = 25, .delay = 0};
  for (std::size_t row = 2 * meter.window; row < rows; row += meter.window) meter.rows.push_back(row);
  return meter;
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rms_of(std::span<const double> values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

/// Sums of squares of the readings, each by its own error, and of what laws leave over of them; how large each law is.
struct Explained {
  double squares = 0.0, left = 0.0;
  double readings = 0.0, log_errors = 0.0;  ///< how many; the sum of their errors' logarithms
  Eigen::Matrix<double, laws, 1> size = Eigen::Matrix<double, laws, 1>::Zero();
};

/// By the first `asked` laws, however large each is, of a drive that gives no more than `limit_Nm`; too few readings:
/// nothing.
Explained explained(std::span<const Recording> recordings, MeterHabit habit, int asked, Errors errors,
                    const plant::AxisParameters& axis, double limit_Nm = std::numeric_limits<double>::infinity()) {
  const double rad_per_m = 2.0 * std::numbers::pi / axis.axis.lead_m;
  Eigen::Matrix<double, laws, laws> normal = Eigen::Matrix<double, laws, laws>::Zero();
  Eigen::Matrix<double, laws, 1> right = Eigen::Matrix<double, laws, 1>::Zero();
  double squares = 0.0, log_errors = 0.0;
  int readings = 0;
  for (const Recording& recording : recordings) {
    const auto command = recording.at(channel::torque_cmd_Nm), position = recording.at(channel::position_m);
    const auto power_W = recording.at(channel::power_W);
    if (position.empty()) continue;
    MeteredPower meter = metered_rows(recording, axis);
    const bool held = meter.window > 1;
    if (!held) meter = in_blocks(power_W.size());
    const double rms_W = rms_of(power_W);
    meter.delay = held ? habit.delay : 0;
    if (held) meter.window = ticks_of_window(meter.window, habit.readings_a_window);
    const auto velocity = [&](std::size_t k) {
      const std::size_t from = habit.instants ? k - 1 : k;
      return (position[k + 1] - position[from]) / (static_cast<double>(k + 1 - from) * recording.sample_s);
    };
    const auto given = [limit_Nm](double torque_Nm) { return std::clamp(torque_Nm, -limit_Nm, limit_Nm); };
    for (const std::size_t row : meter.rows) {
      if (row < meter.window + meter.delay || row + 1 >= position.size()) continue;
      Laws sum = Laws::Zero();
      for (std::size_t k = meter.first_tick(row); k < meter.first_tick(row) + meter.window; ++k)
        sum += laws_of(given(command[k]), given(command[k - 1]), velocity(k), rad_per_m);
      sum.tail(laws - asked).setZero();
      const double reading_W = held ? power_W[row] : mean_of(power_W.subspan(row + 1 - meter.window, meter.window));
      const double error_W = error_scale_W(reading_W, rms_W, errors == Errors::alike);
      const auto mean = sum.matrix() / (error_W * static_cast<double>(meter.window));
      normal += mean * mean.transpose();
      right += mean * (reading_W / error_W);
      squares += reading_W * reading_W / (error_W * error_W);
      log_errors += std::log(error_W);
      ++readings;
    }
  }
  if (readings < 3 * laws) return {};
  const Eigen::Matrix<double, laws, 1> size = normal.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::Matrix<double, laws, laws> scaled =
      size.cwiseInverse().asDiagonal() * normal * size.cwiseInverse().asDiagonal();
  const Eigen::Matrix<double, laws, 1> found = least_squares(scaled, right.cwiseQuotient(size)).cwiseQuotient(size);
  const double left = std::max(0.0, squares - 2.0 * found.dot(right) + found.dot(normal * found));
  return {squares, left, static_cast<double>(readings), log_errors, found};
}

double unexplained(std::span<const Recording> recordings, MeterHabit habit, int asked, Errors errors,
                   const plant::AxisParameters& axis) {
  return explained(recordings, habit, asked, errors, axis).left;
}

/// Nats that the readings are unlikely by, with errors of this kind.
double unlikely(std::span<const Recording> recordings, MeterHabit habit, int asked, Errors errors,
                const plant::AxisParameters& axis) {
  const Explained by = explained(recordings, habit, asked, errors, axis);
  if (by.readings == 0.0) return std::numeric_limits<double>::infinity();
  return 0.5 * by.readings * std::log(by.left + 1e-300) + by.log_errors;
}

/// With errors of the likelier kind.
double unlikely(std::span<const Recording> recordings, MeterHabit habit, int asked, const plant::AxisParameters& axis) {
  return std::min(unlikely(recordings, habit, asked, Errors::of_readings, axis),
                  unlikely(recordings, habit, asked, Errors::alike, axis));
}

/// Do its readings err by as much however large they are, as by the noise of its input?
bool errs_alike(std::span<const Recording> recordings, MeterHabit habit, const plant::AxisParameters& axis) {
  constexpr double clearly_nats = 10.0;
  return unlikely(recordings, habit, laws, Errors::alike, axis) + clearly_nats <
         unlikely(recordings, habit, laws, Errors::of_readings, axis);
}

/// The torque beyond which the readings show least of what was commanded: a drive may give no more.
double likely_limit_Nm(std::span<const Recording> recordings, const plant::AxisParameters& axis) {
  double most_Nm = 0.0;
  for (const Recording& recording : recordings)
    for (const double command_Nm : recording.at(channel::torque_cmd_Nm)) most_Nm = std::max(most_Nm, std::abs(command_Nm));
  std::pair best{std::numeric_limits<double>::infinity(), most_Nm};
  constexpr int steps = 45;  // of a twentieth each, down to a tenth
  double limit_Nm = most_Nm;
  for (int step = 0; step < steps; ++step, limit_Nm *= 0.95)
    best = std::min(best, {explained(recordings, {}, laws, Errors::alike, axis, limit_Nm).left, limit_Nm});
  return best.second;
}

/// A meter may average for longer than from one reading to the next: not told where a window of one reading leaves less than
/// a thousandth over. Or for the last part of that: of 129 made cases no other part was ahead by more than 1.1 nats, of
/// 241 with nothing hidden one, by a twentieth that is left out: that is not asked.
double readings_a_window(std::span<const Recording> recordings, const plant::AxisParameters& axis) {
  constexpr double clearly = 0.5, hardly_any = 1e-6;  // of the squares
  constexpr double clearly_nats = 10.0;
  double limit_Nm = std::numeric_limits<double>::infinity();
  const auto by = [&](double readings) {
    return explained(recordings, {.readings_a_window = readings}, laws, Errors::alike, axis, limit_Nm);
  };
  Explained alone = by(1.0);
  if (alone.readings == 0.0) return 1.0;
  const auto least_of = [&](std::pair<double, double> best, std::initializer_list<double> asked) {
    for (const double readings : asked)
      if (const Explained now = by(readings); now.readings > 0.0) best = std::min(best, {now.left, readings});
    return best.second;
  };
  const double whole = alone.left > hardly_any * alone.squares
                           ? least_of({clearly * alone.left, 1.0}, {2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0})
                           : 1.0;
  if (whole > 1.0) return whole;
  // torque that was commanded and not given looks like a part of the window: 0.85 of one was told of such a drive
  limit_Nm = likely_limit_Nm(recordings, axis);
  alone = by(1.0);
  return least_of({std::exp(-2.0 * clearly_nats / alone.readings) * alone.left, 1.0},
                  {0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9});
}

MeterHabit habit_in_time(std::span<const Recording> recordings, const plant::AxisParameters& axis) {
  constexpr double clearly = 0.6;  // of the squares; a lagging current loop alone makes 0.66 (practice case p08)
  // with a lag among the laws the practice cases, which are of instants, have 0.98 and more; where a ripple that is no law
  // yet hides the difference, means over time had 0.87
  constexpr double likely = 0.9;
  const double readings = readings_a_window(recordings, axis);
  const MeterHabit instants{.readings_a_window = readings},
      all_time{.delay = 0, .instants = false, .readings_a_window = readings},
      late{.delay = 1, .instants = false, .readings_a_window = readings};
  for (const Errors errors : {Errors::of_readings, Errors::alike})
    for (const int asked : {own_laws, own_laws + 1}) {
      const auto left = [&](const MeterHabit& habit) { return unexplained(recordings, habit, asked, errors, axis); };
      const double when_late = left(late);
      if (when_late < clearly * left(all_time) && when_late < left(instants)) return late;
    }
  // a noisy meter leaves no habit clearly less: then the likelier one, if a lag among the laws does not say otherwise. Late
  // meters that were taken for ones of instants told two false torque constants; late was ahead by 10 to 51 nats there, on
  // the practice cases behind by 493 and more
  constexpr double likelier_nats = 4.0;
  const auto ahead_when_late = [&](int asked) {
    return std::min(unlikely(recordings, instants, asked, axis), unlikely(recordings, all_time, asked, axis)) -
           unlikely(recordings, late, asked, axis);
  };
  if (ahead_when_late(own_laws) > likelier_nats && ahead_when_late(laws) > 0.0) return late;
  const double over_time = unexplained(recordings, all_time, laws, Errors::alike, axis);
  return over_time < likely * unexplained(recordings, instants, laws, Errors::alike, axis) ? all_time : instants;
}

/// A drive may report what it computes from its command: that is nobody's measurement, and no effect between command and
/// shaft shows in it. So it is where the recorded command and motion make the readings to a thousandth, by numbers that are
/// the nominal ones: what a true meter would have shown of a constant torque, or of one that opposes the motion, those
/// numbers would have to hold.
bool computed_from_command(std::span<const Recording> recordings, MeterHabit habit, const plant::AxisParameters& axis) {
  constexpr double most_left = 1e-3, most_off_work = 5e-3, most_off_nominal = 0.25;
  const Explained by_laws = explained(recordings, habit, drive_laws, Errors::alike, axis);
  if (!(by_laws.squares > 0.0) || by_laws.left > most_left * most_left * by_laws.squares) return false;
  const auto is_near = [](double found, double nominal, double share) {
    return std::abs(found - nominal) <= share * std::abs(nominal);
  };
  const auto& linear = axis.motor.electrical_linear_Ws_per_m;
  return is_near(by_laws.size[work], 1.0, most_off_work) &&
         is_near(by_laws.size[linear_forth], linear.pos, most_off_nominal) &&
         is_near(by_laws.size[linear_back], linear.neg, most_off_nominal);
}

}  // namespace

DrivePowers drive_powers(double force_N, double velocity_m_per_s) {
  const double v = velocity_m_per_s, forth = v > 0.0 ? 1.0 : 0.0, back = 1.0 - forth, work_W = force_N * v;
  return {1.0, forth * v, -back * v, forth * v * v, back * v * v, force_N * force_N, work_W, std::max(0.0, -work_W)};
}

std::size_t ticks_of_window(std::size_t ticks_between, double readings) {
  return static_cast<std::size_t>(std::max(1L, std::lround(static_cast<double>(ticks_between) * readings)));
}

MeteredPower metered_rows(std::span<const double> power_W, std::size_t expected_window) {
  MeteredPower meter;
  for (std::size_t i = 1; i < power_W.size(); ++i) {
    if (power_W[i] != power_W[i - 1]) meter.rows.push_back(i);
  }
  std::vector<std::size_t> spacing;
  for (std::size_t i = 1; i < meter.rows.size(); ++i) spacing.push_back(meter.rows[i] - meter.rows[i - 1]);
  if (spacing.size() >= 3) {
    meter.window = median_of(std::move(spacing));
  } else {  // the meter showed the same all along, as over an axis at rest: its window is known from elsewhere
    meter.window = std::max<std::size_t>(expected_window, 1);
    const std::size_t first = meter.rows.empty() ? power_W.size() : meter.rows.front();
    meter.rows.clear();
    for (std::size_t row = first; row < power_W.size(); row += meter.window) meter.rows.push_back(row);
  }
  if (meter.window < 5) {  // not held: every row is a reading of its own
    meter.window = 1;
    meter.rows.resize(power_W.size());
    for (std::size_t i = 0; i < power_W.size(); ++i) meter.rows[i] = i;
  }
  std::erase_if(meter.rows, [&meter](std::size_t row) { return row + 1 < meter.window; });
  return meter;
}

MeteredPower metered_rows(const Recording& recording, const plant::AxisParameters& axis) {
  const auto power_W = recording.at(channel::power_W);
  if (power_W.empty()) return {};
  const double between = std::round(axis.power_meter_window_s / axis.power_meter_readings / recording.sample_s);
  MeteredPower meter = metered_rows(power_W, static_cast<std::size_t>(between));
  if (meter.window > 1)
    meter.delay = recording.meter.delay, meter.window = ticks_of_window(meter.window, recording.meter.readings_a_window);
  std::erase_if(meter.rows, [&meter](std::size_t row) { return row + 1 < meter.window + meter.delay; });
  return meter;
}

MeterHabit meter_habit(std::span<const Recording> recordings, const plant::AxisParameters& axis) {
  MeterHabit habit = habit_in_time(recordings, axis);
  habit.of_command = computed_from_command(recordings, habit, axis);
  habit.errors_alike = errs_alike(recordings, habit, axis);
  return habit;
}

double error_scale_W(double reading_W, double rms_W, bool errors_alike) {
  constexpr double least_reading = 0.2;  // of the rms: a meter's error is partly of its reading
  return errors_alike ? 1.0 : std::hypot(reading_W, least_reading * rms_W) + 1e-300;
}

std::vector<double> as_metered(std::span<const double> power_W, const MeteredPower& meter) {
  std::vector<double> shown(power_W.size());
  double now_W = 0.0;
  auto next = meter.rows.begin();
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (next != meter.rows.end() && *next == i) {
      double sum = 0.0;
      const std::size_t first = meter.first_tick(i);
      for (std::size_t j = first; j < first + meter.window; ++j) sum += power_W[j];
      now_W = sum / static_cast<double>(meter.window);
      ++next;
    }
    shown[i] = now_W;
  }
  return shown;
}

}  // namespace feedtwin::tools
