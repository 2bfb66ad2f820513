#include "tools/diagnose/figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plant/axis_model.h"
#include "tools/identify/zero_phase_filter.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// The equations that add up to a channel.
struct Channel {
  std::string name;
  bool motor, screw, guide, slip, power;
};

std::vector<Channel> channels_of(const InverseModel& model) {
  const Track& track = model.tracks().front();
  std::vector<Channel> found{{"torque_cmd_Nm", true, true, true, false, false}};
  if (track.torque_sensor_N.size() > 0) found.push_back({"torque_sensor_Nm", false, true, true, false, false});
  if (track.force_sensor_N.size() > 0) found.push_back({"force_sensor_N", false, false, true, false, false});
  if (track.slip_m.size() > 0) found.push_back({"scale_position_m", false, false, false, true, false});
  if (!track.meter.starts.empty()) found.push_back({"power_W", false, false, false, false, true});
  return found;
}

bool part_of(const Equation& e, const Channel& c) {
  return (e.motor && c.motor) || (e.screw && c.screw && !(e.motor && !c.motor)) ||
         (e.guide && c.guide && !(e.screw && !c.screw)) || (e.slip && c.slip) || (e.power && c.power);
}

/// The rows of the equations that add up to the channel, run after run.
Vector summed(const InverseModel& model, const Vector& rows, const Channel& channel) {
  std::vector<double> all;
  for (std::size_t run = 0; run < model.tracks().size(); ++run) {
    Vector sum;
    for (const auto& s : model.segments())
      if (s.run == run && part_of(model.equations()[s.equation], channel)) add(sum, rows.segment(s.start, s.size));
    all.insert(all.end(), sum.data(), sum.data() + sum.size());
  }
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

Vector recorded_of(const InverseModel& model, const Channel& channel) {
  if (!channel.slip) return summed(model, model.recorded(), channel);
  std::vector<double> all;  // against the whole travel
  for (const auto& track : model.tracks())
    for (Index k = 0; k < track.size; k += InverseModel::decimation) all.push_back(track.table_position_m[k]);
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

double spread(const Vector& y) {
  return y.size() > 0 ? std::sqrt((y.array() - y.mean()).square().mean()) : 0.0;
}

}  // namespace

Nrmse nrmse(const InverseModel& model, const Candidate& at) {
  const Vector residual = model.unweighted_residual(at.axis, at.effects);
  Nrmse found;
  for (const auto& channel : channels_of(model)) {
    const Vector r = summed(model, residual, channel);
    const double scale = spread(recorded_of(model, channel));
    if (r.size() > 0 && scale > 0.0)
      found[channel.name] = std::sqrt(r.squaredNorm() / static_cast<double>(r.size())) / scale;
  }
  return found;
}

Nrmse noise_floor(const InverseModel& model, const Candidate& at) {
  const auto masses = plant::make_axis_model(at.axis);
  const auto& noise = model.noise();
  Nrmse found;
  for (const auto& channel : channels_of(model)) {
    const double mass =
        channel.motor * masses.motor_mass_kg + channel.screw * masses.screw_mass_kg + channel.guide * masses.table_mass_kg;
    double variance = noise.acceleration * mass * mass;
    if (!channel.motor && channel.screw) variance += noise.torque_sensor;
    if (!channel.screw && channel.guide) variance += noise.force_sensor;
    if (channel.slip) variance = noise.slip;
    if (channel.power) variance = noise.power;
    const double scale = spread(recorded_of(model, channel));
    if (scale > 0.0) found[channel.name] = std::sqrt(variance) / scale;
  }
  return found;
}

double relative_force_error(const InverseModel& model, const Candidate& at) {
  constexpr double kept = 0.8, band_Hz = 40.0;  // of the new Nyquist frequency
  const auto residuals = model.force_residuals_N(at.axis, at.effects);
  double off = 0.0, all = 0.0;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    const Track& track = model.tracks()[run];
    const int factor = std::max(1, static_cast<int>(std::round(kept * 0.5 / track.sample_s / band_Hz)));
    const auto square = [&](const Vector& force_N) {
      const auto inner = force_N.segment(InverseModel::margin, track.size - 2 * InverseModel::margin);
      const auto rows = decimated({inner.data(), static_cast<std::size_t>(inner.size())}, factor);
      return std::inner_product(rows.begin(), rows.end(), rows.begin(), 0.0);
    };
    off += square(residuals[run]);
    all += square(track.command_N);
  }
  return all > 0.0 ? std::sqrt(off / all) : 0.0;
}

Energy energy(const InverseModel& model, const Candidate& at) {
  const auto contacts = model.contacts(at.axis, at.effects);
  const auto prepared = model.prepared(at.axis, at.effects, contacts);
  Energy sum;
  for (std::size_t run = 0; run < model.tracks().size(); ++run) {
    const Track& track = model.tracks()[run];
    const auto& base = prepared.base[run];
    const auto& extra = prepared.extra[run];
    const auto work = [&](const Vector& force, const Vector& more) {
      return track.sample_s * (force.dot(track.centred_m_per_s) + (more.size() > 0 ? more.dot(track.centred_m_per_s) : 0.0));
    };
    sum["motor_mechanical"] += work(base.motor_N, extra.motor_N);
    sum["ball_screw"] += work(base.screw_N, extra.screw_N);
    sum["guide"] += work(base.guide_N, extra.guide_N);
    const double input_J = track.sample_s * (base.power_W.sum() + (extra.power_W.size() > 0 ? extra.power_W.sum() : 0.0));
    sum["motor_electrical"] += input_J - track.sample_s * track.held_N.dot(track.centred_m_per_s);
  }
  return sum;
}

}  // namespace feedtwin::tools::diagnosis
