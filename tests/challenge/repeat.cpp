#include "tests/challenge/repeat.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace feedtwin::challenge {
namespace {

using Series = std::vector<double>;

Series series_of(const Run& run, double Sample::* member) {
  Series all;
  for (const Sample& s : run) all.push_back(s.*member);
  return all;
}

double square_about(const Series& x, double centre) {
  double sum = 0.0;
  for (const double value : x) sum += (value - centre) * (value - centre);
  return sum;
}

double mean_of(const Series& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return x.empty() ? 0.0 : sum / static_cast<double>(x.size());
}

/// |a - b|, without the mean where a channel has no zero of its own.
double distance(const Series& a, const Series& b, bool zero_is_chance) {
  Series d;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) d.push_back(a[i] - b[i]);
  return std::sqrt(square_about(d, zero_is_chance ? mean_of(d) : 0.0));
}

/// At the rows where the meter of `like` shows something new.
Series readings(const Run& run, const Run& like) {
  Series shown;
  for (std::size_t i = 1; i < std::min(run.size(), like.size()); ++i)
    if (like[i].power_W != like[i - 1].power_W) shown.push_back(run[i].power_W);
  return shown;
}

Series beyond_the_encoder(const Run& run) {
  Series slip;
  for (const Sample& s : run) slip.push_back(s.scale_position_m - s.position_m);
  return slip;
}

}  // namespace

Run record_again(const Axis& axis, const Effects& effects, const Noise& noise, const Gains& gains, const MotionPlan& plan,
                 std::uint64_t seed) {
  std::mt19937_64 random(seed * 0xD1B54A32D192ED03ULL + 5);
  Noise anew = noise;
  anew.grid_phase_counts = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  return record(axis, effects, anew, gains, plan, random());
}

std::vector<ChannelFloor> floors_of(const Run& run, const Run& again, const Run& without, unsigned channels) {
  std::vector<ChannelFloor> floors;
  const auto add = [&](const char* name, const Series& own, const auto& of, bool zero_is_chance) {
    const double signal = std::sqrt(square_about(own, mean_of(own)));
    if (!(signal > 0.0)) return;
    floors.push_back({name, distance(of(run), of(again), zero_is_chance) / std::sqrt(2.0) / signal,
                      distance(of(run), of(without), zero_is_chance) / signal});
  };
  const auto add_plain = [&](const char* name, double Sample::* member) {
    add(name, series_of(run, member), [member](const Run& r) { return series_of(r, member); }, false);
  };
  add_plain("torque_cmd_Nm", &Sample::torque_cmd_Nm);
  if (channels & torque_sensor) add_plain("torque_sensor_Nm", &Sample::torque_sensor_Nm);
  if (channels & force_sensor) add_plain("force_sensor_N", &Sample::force_sensor_N);
  if (channels & power) add("power_W", readings(run, run), [&run](const Run& r) { return readings(r, run); }, false);
  if (channels & scale) add("scale_position_m", series_of(run, &Sample::scale_position_m), beyond_the_encoder, true);
  return floors;
}

}  // namespace feedtwin::challenge
