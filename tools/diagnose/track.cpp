#include "tools/diagnose/track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "tools/identify/whitening.h"
#include "tools/recording/power_meter.h"

namespace feedtwin::tools::diagnosis {
namespace {

Vector as_vector(std::span<const double> values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

Vector convolved(const Vector& values, std::span<const double> kernel) {
  const auto half = static_cast<Index>(kernel.size() / 2);
  const Index last = values.size() - 1;
  Vector out = Vector::Zero(values.size());
  for (Index k = 0; k < values.size(); ++k)
    for (Index j = -half; j <= half; ++j)
      out[k] += kernel[static_cast<std::size_t>(j + half)] * values[std::clamp<Index>(k + j, 0, last)];
  return out;
}

/// Hamming-windowed low pass at a fifth of the sample rate: takes the encoder's grid off the velocity.
Vector smoothed(const Vector& position_m) {
  std::array<double, 9> kernel{};
  double sum = 0.0;
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double t = static_cast<double>(i) - 4.0;
    const double argument = std::numbers::pi * 0.4 * t;
    const double window = 0.54 + 0.46 * std::cos(std::numbers::pi * t / 4.0);
    kernel[i] = window * (t == 0.0 ? 1.0 : std::sin(argument) / argument);
    sum += kernel[i];
  }
  for (double& weight : kernel) weight /= sum;
  return convolved(position_m, kernel);
}

/// Without what a grid makes of an axis at rest (two counts within 20 ms): counts of one sample, by a median, and the
/// flicker between two neighbouring counts, by play as wide as the grid. Led to and fro by a count a hundred times, a
/// bristle would have let go of what it holds.
/// @param count_m the encoder's; no ruler is coarser
Vector without_flicker(const Vector& x, double count_m) {
  constexpr Index reach = 3, at_rest = 10;
  double grid_m = count_m;
  for (Index k = 1; k < x.size(); ++k)
    if (x[k] != x[k - 1]) grid_m = std::min(grid_m, std::abs(x[k] - x[k - 1]));
  const double play_m = 0.51 * grid_m;  // a little more than half: the recording's own digits
  Vector out = x;
  for (Index k = at_rest; k + at_rest < x.size(); ++k) {
    const auto around = x.segment(k - at_rest, 2 * at_rest + 1);
    if (around.maxCoeff() - around.minCoeff() > 2.1 * grid_m) continue;
    std::array<double, 2 * reach + 1> near{};
    std::copy_n(x.data() + k - reach, near.size(), near.begin());
    std::ranges::nth_element(near, near.begin() + reach);
    out[k] = std::clamp(out[k - 1], near[reach] - play_m, near[reach] + play_m);
  }
  return out;
}

/// Mean velocities of the sub-steps along the cubic through samples and their central differences.
Vector path_velocities(const Vector& x, double h) {
  const Index n = x.size();
  Vector path = Vector::Zero(n * path_substeps);
  for (Index k = 0; k + 1 < n; ++k) {
    const double slope_0 = k > 0 ? 0.5 * (x[k + 1] - x[k - 1]) : x[k + 1] - x[k];
    const double slope_1 = k + 2 < n ? 0.5 * (x[k + 2] - x[k]) : x[k + 1] - x[k];
    double before = x[k];
    for (int j = 1; j <= path_substeps; ++j) {
      const double s = static_cast<double>(j) / path_substeps, s2 = s * s, s3 = s2 * s;
      const double at =
          (2 * s3 - 3 * s2 + 1) * x[k] + (s3 - 2 * s2 + s) * slope_0 + (3 * s2 - 2 * s3) * x[k + 1] + (s3 - s2) * slope_1;
      path[k * path_substeps + j - 1] = (at - before) / (h / path_substeps);
      before = at;
    }
  }
  return path;
}

/// The triangular mean of the acceleration about each sample, exact.
Vector second_difference(const Vector& x, double h) {
  const Index n = x.size();
  Vector out = Vector::Zero(n);
  out.segment(1, n - 2) = (x.tail(n - 2) - 2.0 * x.segment(1, n - 2) + x.head(n - 2)) / (h * h);
  return out;
}

void follow_reversals(Track& track) {
  double since = 1e3, dwelt = 0.0, resting = 0.0, direction = 0.0;
  track.since_reversal_s.resize(track.size);
  track.dwell_s.resize(track.size);
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.centred_m_per_s[k];
    if (std::abs(v) < standstill_m_per_s) {
      resting += track.sample_s;
    } else {
      if (resting > 0.0) dwelt = resting;
      resting = 0.0;
      const double now = v > 0.0 ? 1.0 : -1.0;
      if (now != direction) since = 0.0;
      direction = now;
    }
    since += track.sample_s;
    track.since_reversal_s[k] = since;
    track.dwell_s[k] = dwelt;
  }
}

/// A meter that holds its reading shows, from the end of a window on, the mean over that window.
MeterWindows meter_windows(const Vector& power_W, double sample_s, const MeterHabit& habit) {
  const auto delay = static_cast<Index>(habit.delay);
  std::vector<Index> changes;
  for (Index k = 1; k < power_W.size(); ++k)
    if (power_W[k] != power_W[k - 1]) changes.push_back(k);
  MeterWindows meter;
  std::map<Index, int> lengths;
  for (std::size_t i = 1; i < changes.size(); ++i) ++lengths[changes[i] - changes[i - 1]];
  int most = 0;
  for (const auto& [length, count] : lengths)
    if (count > most) most = count, meter.length = length;
  if (meter.length < 2) {  // sampled with the rest: means of 25 ms
    meter.length = std::max<Index>(1, std::lround(0.025 / sample_s));
    for (Index k = 0; k + meter.length <= power_W.size(); k += meter.length) {
      meter.starts.push_back(k);
      meter.power_W.push_back(power_W.segment(k, meter.length).mean());
    }
    return meter;
  }
  meter.held = true;
  const Index phase = changes.empty() ? 0 : changes.front() % meter.length;
  const Index every = meter.length;
  meter.length = static_cast<Index>(ticks_of_window(static_cast<std::size_t>(every), habit.readings_a_window));
  for (Index k = phase; k + every < power_W.size(); k += every) {
    const Index start = k + 1 - delay + every - meter.length;
    if (start < 0) continue;
    meter.starts.push_back(start);
    meter.power_W.push_back(power_W[k + every]);
  }
  return meter;
}

/// A scale's noise is the table's motion to whoever believes it: 1 um of it is 2 m/s^2 and more at 1 kHz. What the table
/// does beside the motor is then taken over as many samples (Hann) as bring its acceleration down to what the encoder's grid
/// has.
Vector as_quiet_as(const Vector& slip_m, double count_m) {
  constexpr std::size_t longest = 41;
  const double noise_m = white_sigma({slip_m.data(), static_cast<std::size_t>(slip_m.size())});
  const double grid_m = count_m / std::sqrt(12.0), of_grid = std::sqrt(6.0);  // that a second difference leaves of it
  for (std::size_t taps = 1;; taps += 2) {
    Vector kernel(static_cast<Index>(taps));
    for (Index i = 0; i < kernel.size(); ++i)
      kernel[i] = std::pow(std::sin(std::numbers::pi * static_cast<double>(i + 1) / static_cast<double>(taps + 1)), 2);
    kernel /= kernel.sum();
    Vector padded = Vector::Zero(kernel.size() + 4);
    padded.segment(2, kernel.size()) = kernel;
    const Vector twice =
        padded.tail(kernel.size() + 2) - 2.0 * padded.segment(1, kernel.size() + 2) + padded.head(kernel.size() + 2);
    if (taps < longest && noise_m * twice.norm() > of_grid * grid_m) continue;
    return taps == 1 ? slip_m : convolved(slip_m, {kernel.data(), taps});
  }
}

}  // namespace

Travel travel_of(const std::vector<Track>& runs, Vector Track::* position) {
  Travel travel;
  for (const auto& run : runs) {
    travel.low_m = std::min(travel.low_m, (run.*position).minCoeff());
    travel.high_m = std::max(travel.high_m, (run.*position).maxCoeff());
  }
  return travel;
}

Vector about_sample(const Vector& after) {
  Vector out = after;
  const Index n = after.size();
  out.tail(n - 1) = 0.5 * (after.tail(n - 1) + after.head(n - 1));
  return out;
}

Track make_track(const Recording& recording, const plant::AxisParameters& axis) {
  Track track;
  track.name = recording.file.substr(recording.file.find_last_of('/') + 1);
  const double h = track.sample_s = recording.sample_s;
  const Vector x = as_vector(recording.at(channel::position_m));
  const Index n = track.size = x.size();
  const double per_lead = 2.0 * std::numbers::pi / axis.axis.lead_m;
  const double count_m = axis.axis.lead_m / axis.axis.encoder_counts_per_rev;

  track.held_N = per_lead * as_vector(recording.at(channel::torque_cmd_Nm));
  track.command_N = about_sample(track.held_N);
  track.shown_m = x;
  track.position_m = smoothed(x);
  track.velocity_m_per_s = Vector::Zero(n);
  track.velocity_m_per_s.head(n - 1) = (track.position_m.tail(n - 1) - track.position_m.head(n - 1)) / h;
  track.centred_m_per_s = about_sample(track.velocity_m_per_s);
  track.motor_direction = (track.velocity_m_per_s.array() / standstill_m_per_s).tanh();
  track.acceleration_m_per_s2 = second_difference(x, h);
  const Vector steady = smoothed(without_flicker(x, count_m));
  track.steady_m_per_s = Vector::Zero(n);
  track.steady_m_per_s.head(n - 1) = (steady.tail(n - 1) - steady.head(n - 1)) / h;
  track.path_m_per_s = path_velocities(steady, h);
  track.table_position_m = track.position_m;
  track.table_velocity_m_per_s = track.velocity_m_per_s;
  track.table_acceleration_m_per_s2 = track.acceleration_m_per_s2;
  track.table_path_m_per_s = track.path_m_per_s;
  if (recording.has(channel::scale_position_m)) {
    track.slip_m = as_vector(recording.at(channel::scale_position_m)) - x;
    const Vector table = x + as_quiet_as(track.slip_m, count_m);
    track.table_position_m = smoothed(table);
    track.table_velocity_m_per_s.head(n - 1) = (track.table_position_m.tail(n - 1) - track.table_position_m.head(n - 1)) / h;
    track.table_acceleration_m_per_s2 = second_difference(table, h);
    track.table_path_m_per_s = path_velocities(smoothed(without_flicker(table, count_m)), h);
  }
  follow_reversals(track);
  track.setpoints = setpoints_of(recording, count_m);

  // A sensor reads at its instant and the balance is the triangular mean about it.
  const std::array<double, 3> triangle{1.0 / 12.0, 10.0 / 12.0, 1.0 / 12.0};
  if (recording.has(channel::torque_sensor_Nm))
    track.torque_sensor_N = convolved(per_lead * as_vector(recording.at(channel::torque_sensor_Nm)), triangle);
  if (recording.has(channel::force_sensor_N))
    track.force_sensor_N = convolved(as_vector(recording.at(channel::force_sensor_N)), triangle);
  track.half_step_N = convolved(track.held_N, triangle) - track.command_N;
  if (recording.has(channel::power_W)) {
    track.meter = meter_windows(as_vector(recording.at(channel::power_W)), h, recording.meter);
    track.meter.of_command = recording.meter.of_command;
  }
  track.metered_m_per_s = Vector::Zero(n);
  track.metered_m_per_s.head(n - 1) = (x.tail(n - 1) - x.head(n - 1)) / h;
  track.metered_at_m = recording.meter.instants ? x : Vector(x + 0.5 * h * track.metered_m_per_s);
  if (recording.meter.instants) track.metered_m_per_s = about_sample(track.metered_m_per_s);
  return track;
}

std::vector<Track> make_tracks(const std::vector<Recording>& recordings, const plant::AxisParameters& axis,
                               const TrackSettings& settings) {
  std::vector<Track> tracks;
  for (const auto& recording : recordings) {
    tracks.push_back(make_track(recording, axis));
    tracks.back().run = tracks.size() - 1;
    tracks.back().jump_shares = settings.jump_shares;
    tracks.back().samples_a_row = settings.samples_a_row;
  }
  return tracks;
}

}  // namespace feedtwin::tools::diagnosis
