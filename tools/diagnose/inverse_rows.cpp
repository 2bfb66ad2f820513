// The inverse model's rows: one low pass and decimation for all, where they have settled, and how noisy they are.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/axis_model.h"
#include "tools/diagnose/inverse_model.h"
#include "tools/identify/sliding.h"
#include "tools/identify/whitening.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index taps = 17;

}  // namespace

Vector low_pass_to(Index samples_a_row) {
  const double band = 0.8 / static_cast<double>(samples_a_row);
  Vector made(taps);
  for (Index i = 0; i < taps; ++i) {
    const double t = static_cast<double>(i) - (taps - 1) / 2.0, argument = std::numbers::pi * band * t;
    made[i] =
        (0.54 + 0.46 * std::cos(2.0 * std::numbers::pi * t / (taps - 1))) * (t == 0.0 ? 1.0 : std::sin(argument) / argument);
  }
  return made / made.sum();
}

bool tables_own(const Equation& equation) {
  return equation.guide && !equation.screw && !equation.motor;
}

double moved_kg(const Equation& equation, const plant::AxisParameters& axis) {
  const auto model = plant::make_axis_model(axis);
  return equation.motor * model.motor_mass_kg + equation.screw * model.screw_mass_kg + equation.guide * model.table_mass_kg;
}

void InverseModel::find_settled() {
  constexpr double filter_s = 0.01;
  settled_.assign(static_cast<std::size_t>(rows_), true);
  for (const auto& segment : segments_) {
    const auto& equation = equations_[segment.equation];
    if (equation.slip || equation.power) continue;
    const Track& track = tracks_[segment.run];
    const auto& velocity = track.centred_m_per_s;
    const auto slides = rows_of_sliding({velocity.data(), static_cast<std::size_t>(track.size)}, track.sample_s);
    const Index ahead = std::lround(filter_s / track.sample_s);
    for (Index i = 0; i < segment.size; ++i) {
      const Index k = sample_of(segment, i);
      settled_[static_cast<std::size_t>(segment.start + i)] =
          slides[static_cast<std::size_t>(k)] && slides[static_cast<std::size_t>(std::min(k + ahead, track.size - 1))];
    }
  }
}

void InverseModel::weigh_noise() {
  const auto sigma = [](const Vector& x) { return white_sigma({x.data(), static_cast<std::size_t>(x.size())}); };
  double flat = 0.0, twice = 0.0;  // what the low pass leaves of white noise, and of its second difference
  for (Index i = 0; i < taps + 2; ++i) {
    const auto tap = [&](Index j) { return j < taps ? low_pass_[j] : 0.0; };
    const double second = tap(i) - 2.0 * (i > 0 ? tap(i - 1) : 0.0) + (i > 1 ? tap(i - 2) : 0.0);
    flat += tap(i) * tap(i);
    twice += second * second;
  }
  const Track& track = tracks_.front();
  const double grid_m = nominal_.axis.lead_m / nominal_.axis.encoder_counts_per_rev;
  noise_.acceleration = twice * grid_m * grid_m / 12.0 / std::pow(track.sample_s, 4);
  noise_.torque_sensor = flat * std::pow(sigma(track.torque_sensor_N), 2);
  noise_.force_sensor = flat * std::pow(sigma(track.force_sensor_N), 2);
  noise_.slip = flat * std::pow(sigma(track.slip_m), 2);
  const double acceleration = noise_.acceleration, torque = noise_.torque_sensor, force = noise_.force_sensor;
  for (const auto& equation : equations_) {
    const double mass = moved_kg(equation, nominal_);
    const double moved = acceleration * mass * mass;
    const double sensed = (equation.motor != equation.screw) * torque + (equation.screw != equation.guide) * force;
    acceleration_share_.push_back(moved / (moved + sensed + 1e-300));
  }
}

Index InverseModel::sample_of(const Segment& segment, Index row) const {
  const auto& meter = tracks_[segment.run].meter;
  if (equations_[segment.equation].power) return meter.starts[static_cast<std::size_t>(row)] + meter.length / 2;
  return margin + row * samples_a_row();
}

void InverseModel::gather(const Segment& segment, const Vector& raw, Vector& rows) const {
  const auto& meter = tracks_[segment.run].meter;
  const auto& equation = equations_[segment.equation];
  auto part = rows.segment(segment.start, segment.size);
  for (Index i = 0; i < segment.size; ++i)
    part[i] = equation.power ? raw.segment(meter.starts[static_cast<std::size_t>(i)], meter.length).mean()
                             : low_pass_.dot(raw.segment(margin + i * samples_a_row() - taps / 2, taps));
  if (equation.slip) part.array() -= part.mean();  // where either ruler has its zero tells nothing
}

void InverseModel::store(const Segment& segment, const Vector& raw, Vector& rows) const {
  gather(segment, raw, rows);
  if (!equations_[segment.equation].power) return;
  auto part = rows.segment(segment.start, segment.size);
  part = Eigen::Map<const Vector>(tracks_[segment.run].meter.power_W.data(), segment.size) - part;
}

}  // namespace feedtwin::tools::diagnosis
