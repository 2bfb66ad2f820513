#include "tools/recording/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "plant/axis_model.h"
#include "tools/config/input_error.h"
#include "tools/median.h"

namespace feedtwin::tools {
namespace {

[[noreturn]] void fail(const std::string& place, const std::string& problem) {
  throw InputError(place + ": " + problem);
}

void check_order(const Recording& recording, std::span<const double> time_s) {
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const std::string_view what =
        time_s[i] == time_s[i - 1] ? "is there twice" : "comes after a later time: rows must be sorted";
    if (!(time_s[i] > time_s[i - 1])) fail(recording.place(channel::time_s, i), fmt::format("{} s {}", time_s[i], what));
  }
}

void check_rate(const Recording& recording, std::span<const double> time_s, double sample_rate_Hz) {
  std::vector<double> steps(time_s.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = time_s[i + 1] - time_s[i];
  const double found_s = median_of(std::move(steps));
  const double ratio = found_s * sample_rate_Hz;
  if (ratio > 300.0 && ratio < 3000.0) {
    fail(recording.file,
         fmt::format("time_s: steps of {:g} s where {:g} Hz is stated: is the time in ms?", found_s, sample_rate_Hz));
  }
  if (std::abs(ratio - 1.0) > 0.01) {
    fail(recording.file, fmt::format("time_s: steps of {:g} s, but {:g} Hz is stated", found_s, sample_rate_Hz));
  }
}

void check_gaps(const Recording& recording, std::span<const double> time_s, double sample_rate_Hz) {
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step_s = time_s[i] - time_s[i - 1];
    if (std::abs(step_s * sample_rate_Hz - 1.0) <= 0.5) continue;
    fail(recording.place(channel::time_s, i),
         fmt::format("a step of {:g} ms after {} s; expected {:g} ms (samples missing, or jitter beyond half a sample)",
                     1e3 * step_s, time_s[i - 1], 1e3 / sample_rate_Hz));
  }
}

double rms(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// rms about the first value: travel
double travel_rms(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += (value - values.front()) * (value - values.front());
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

bool thousandfold(double ratio) {
  return ratio > 100.0 || ratio < 0.01;
}

void check_ratio(const Recording& recording, std::string_view name, double found, double expected,
                 std::string_view against) {
  if (!(found > 0.0) || !(expected > 0.0) || !thousandfold(found / expected)) return;
  fail(recording.file, fmt::format("{}: about {:.1g} times what {} says; expected {} (units?)", name, found / expected,
                                   against, std::ranges::find(channel_kinds(), name, &ChannelKind::name)->unit));
}

/// How the commanded force splits into the axis file's friction (sign of v) and motion (M a + B v) terms: 1 and 1 where all
/// units are right, and the square that the second one explains over what neither does. And all of it over both together: a
/// wrong lead, or friction that is not as the file has it, may leave a share of a hundredth to friction, but not of all.
struct ForceSplit {
  double friction = 1.0, motion = 1.0, motion_over_rest = 0.0, whole = 1.0;
};

ForceSplit split_force(std::span<const double> torque_Nm, std::span<const double> position_m, double sample_s,
                       const plant::AxisParameters& axis) {
  const auto model = plant::make_axis_model(axis);
  const auto& pos = model.contacts.both.pos;
  const double coulomb_N = model.coulomb_pos_N + pos.coulomb_N[0] + pos.coulomb_N[1];
  const double viscous = model.damping_pos_Ns_per_m + pos.viscous_Ns_per_m[0] + pos.viscous_Ns_per_m[1];
  const auto w = static_cast<std::size_t>(std::max(1.0, std::round(0.01 / sample_s)));
  const double span_s = static_cast<double>(w) * sample_s;
  double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0, yy = 0.0;
  for (std::size_t i = w; i + w < position_m.size(); ++i) {
    const double v = (position_m[i + w] - position_m[i - w]) / (2.0 * span_s);
    const double acceleration = (position_m[i + w] - 2.0 * position_m[i] + position_m[i - w]) / (span_s * span_s);
    const double a = coulomb_N * (v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0), b = model.mass_kg * acceleration + viscous * v;
    double y = 0.0;  // smoothed as the motion is
    for (std::size_t j = i - w; j <= i + w; ++j) y += torque_Nm[j];
    y *= model.transmission_rad_per_m / static_cast<double>(2 * w + 1);
    aa += a * a, ab += a * b, bb += b * b, ay += a * y, by += b * y, yy += y * y;
  }
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-9 * aa * bb)) return {};
  ForceSplit split{(ay * bb - by * ab) / determinant, (by * aa - ay * ab) / determinant, 0.0,
                   std::sqrt(yy / (aa + 2.0 * ab + bb))};
  const double rest = std::max(yy - split.friction * ay - split.motion * by, 1e-12 * yy);
  split.motion_over_rest = rest > 0.0 ? split.motion * split.motion * (bb - ab * ab / aa) / rest : 0.0;
  return split;
}

/// What moves the table by the axis file: M_L a + F_C + mu |v|, rms.
double guide_force_rms_N(std::span<const double> position_m, double sample_s, const plant::AxisParameters& axis) {
  const auto w = static_cast<std::size_t>(std::max(1.0, std::round(0.01 / sample_s)));
  const double span_s = static_cast<double>(w) * sample_s;
  std::vector<double> force_N;
  for (std::size_t i = w; i + w < position_m.size(); ++i) {
    const double v = (position_m[i + w] - position_m[i - w]) / (2.0 * span_s);
    const double acceleration = (position_m[i + w] - 2.0 * position_m[i] + position_m[i - w]) / (span_s * span_s);
    force_N.push_back(axis.guide_mass_kg * std::abs(acceleration) + axis.guide.coulomb_N.pos +
                      axis.guide.viscous_Ns_per_m.pos * std::abs(v));
  }
  return rms(force_N);
}

}  // namespace

void check_time_and_life(const Recording& recording, double sample_rate_Hz) {
  const auto time_s = recording.at(channel::time_s);
  const double needed = std::max(20.0, shortest_run_s * sample_rate_Hz);
  if (static_cast<double>(time_s.size()) < needed) {
    fail(recording.file, fmt::format("holds {} samples; at least {:.0f} are needed ({:g} s)", time_s.size(), needed,
                                     needed / sample_rate_Hz));
  }
  check_order(recording, time_s);
  check_rate(recording, time_s, sample_rate_Hz);
  check_gaps(recording, time_s, sample_rate_Hz);
  for (const auto& [name, values] : recording.channels) {
    if (name == channel::temperature_C || name == channel::reference_m) continue;
    const auto [low, high] = std::ranges::minmax(values);
    if (low == high)
      fail(recording.file, fmt::format("{}: constant at {} over {} samples: not connected?", name, low, values.size()));
  }
}

void check_units(const Recording& recording, const plant::AxisParameters& axis) {
  const auto torque_Nm = recording.at(channel::torque_cmd_Nm), position_m = recording.at(channel::position_m);
  const auto [low, high] = std::ranges::minmax(position_m);
  if (high - low > 3.0 * axis.axis.stroke_m) {
    fail(recording.file, fmt::format("position_m: travels {:g} m on an axis with {:g} m of stroke; expected m (units?)",
                                     high - low, axis.axis.stroke_m));
  }
  const double transmission = plant::make_axis_model(axis).transmission_rad_per_m;
  check_ratio(recording, channel::scale_position_m, travel_rms(recording.at(channel::scale_position_m)),
              travel_rms(position_m), "position_m");
  if (rms(position_m) > 1e-4) {
    check_ratio(recording, channel::reference_m, rms(recording.at(channel::reference_m)), rms(position_m), "position_m");
  }
  const ForceSplit split = split_force(torque_Nm, position_m, recording.sample_s, axis);
  const bool command_off = thousandfold(std::abs(split.friction)) && (split.whole > 10.0 || split.whole < 0.1);
  if (command_off)
    check_ratio(recording, channel::torque_cmd_Nm, std::abs(split.friction), 1.0, "the friction in the axis file");
  if (split.motion_over_rest > 0.1) {
    check_ratio(recording, channel::position_m, 1.0, std::abs(split.motion),
                "the axis file's mass and viscous friction under this command");
  }
  const double torque_rms = rms(torque_Nm);
  check_ratio(recording, channel::torque_sensor_Nm, rms(recording.at(channel::torque_sensor_Nm)), torque_rms,
              "torque_cmd_Nm");
  check_ratio(recording, channel::force_sensor_N, rms(recording.at(channel::force_sensor_N)),
              guide_force_rms_N(position_m, recording.sample_s, axis), "the guide's friction and the table's mass");
  double work_J = 0.0;
  for (std::size_t i = 1; i < position_m.size(); ++i)
    work_J += torque_Nm[i - 1] * transmission * (position_m[i] - position_m[i - 1]);
  double energy_J = 0.0;
  for (const double power : recording.at(channel::power_W)) energy_J += power * recording.sample_s;
  const double expected_J = work_J + axis.motor.electrical_idle_W * recording.duration_s();
  check_ratio(recording, channel::power_W, energy_J, expected_J, "the mechanical work");
}

ChannelQuality channel_quality(std::span<const double> values) {
  ChannelQuality quality;
  if (values.empty()) return quality;
  const auto [low, high] = std::ranges::minmax(values);
  quality.lowest = low;
  quality.highest = high;
  std::vector<double> steps;
  std::size_t extreme = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && values[i] != values[i - 1]) steps.push_back(std::abs(values[i] - values[i - 1]));
    if (values[i] == low || values[i] == high) ++extreme;
  }
  quality.saturated_share = static_cast<double>(extreme) / static_cast<double>(values.size());
  if (steps.empty()) return quality;
  std::ranges::sort(steps);
  // a grid shows as many steps of nearly its own length; 1 % of them spares the rounding of printed digits
  const double step = steps[steps.size() / 100];
  const auto on_grid = std::ranges::count_if(
      steps, [step](double s) { return std::abs(s / step - std::round(s / step)) < 0.05 && s < 20.0 * step; });
  // and none between rounding and that: an axis at one speed has steps of one length too, and others as it turns
  const auto between = std::ranges::count_if(steps, [step](double s) { return s > 0.1 * step && s < 0.9 * step; });
  const auto all = static_cast<double>(steps.size());
  if (static_cast<double>(on_grid) > 0.2 * all && static_cast<double>(between) < 0.002 * all) quality.resolution = step;
  return quality;
}

std::vector<std::string> recording_remarks(const Recording& recording, const plant::AxisParameters& axis) {
  std::vector<std::string> remarks;
  const auto remark = [&](const std::string& text) { remarks.push_back(recording.file + ": " + text); };
  const auto time_s = recording.at(channel::time_s);
  double jitter_s = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    jitter_s = std::max(jitter_s, std::abs(time_s[i] - time_s.front() - static_cast<double>(i) * recording.sample_s));
  }
  if (jitter_s > 0.01 * recording.sample_s)
    remark(fmt::format("samples lie up to {:.3g} ms off an even grid", 1e3 * jitter_s));
  const auto command = channel_quality(recording.at(channel::torque_cmd_Nm));
  if (command.saturated_share > 0.01)
    remark(
        fmt::format("the command is at its extreme in {:.1f} % of the samples: saturated", 100.0 * command.saturated_share));
  const auto position = channel_quality(recording.at(channel::position_m));
  const double pitch_m = axis.axis.lead_m / axis.axis.encoder_counts_per_rev;
  if (position.resolution > 1.5 * pitch_m) {
    remark(fmt::format("position_m has a grid of {:.4g} nm, the axis file's encoder one of {:.4g} nm",
                       1e9 * position.resolution, 1e9 * pitch_m));
  }
  if (position.highest - position.lowest > axis.axis.stroke_m) {
    remark(fmt::format("travels {:g} m, beyond the stroke of {:g} m: end stops are left out",
                       position.highest - position.lowest, axis.axis.stroke_m));
  }
  for (const auto& column : recording.unused_columns) remark(fmt::format("column '{}' is not used", column));
  return remarks;
}

}  // namespace feedtwin::tools
