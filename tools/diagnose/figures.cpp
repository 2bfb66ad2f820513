#include "tools/diagnose/figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/identify/inverse_model.h"
#include "tools/identify/zero_phase_filter.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// The sum of some equations, which a channel shows.
using Channel = Equation;

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
    for (Index k = 0; k < track.size; k += model.samples_a_row()) all.push_back(track.table_position_m[k]);
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

double spread(const Vector& y) {
  return y.size() > 0 ? std::sqrt((y.array() - y.mean()).square().mean()) : 0.0;
}

/// Rows against the spread of what is recorded, by channel.
Nrmse relative(const InverseModel& model, const Vector& rows) {
  Nrmse found;
  for (const auto& channel : channels_of(model)) {
    const Vector r = summed(model, rows, channel);
    const double scale = spread(recorded_of(model, channel));
    if (r.size() > 0 && scale > 0.0)
      found[channel.name] = std::sqrt(r.squaredNorm() / static_cast<double>(r.size())) / scale;
  }
  return found;
}

}  // namespace

Followed followed(const InverseModel& runs, const Candidate& model) {
  return {runs, model.axis, runs.prepared(model.axis, model.effects, runs.contacts(model.axis, model.effects))};
}

Nrmse nrmse(const Followed& at) {
  return relative(at.runs, at.runs.residual(at.axis, at.model, InverseModel::Rows::as_they_are));
}

Nrmse made_by_effects(const Followed& at) {
  const Candidate numbers{at.axis, {}};
  const Followed without = followed(at.runs, numbers);
  return relative(at.runs, at.runs.residual(at.axis, at.model, InverseModel::Rows::as_they_are) -
                               at.runs.residual(at.axis, without.model, InverseModel::Rows::as_they_are));
}

Nrmse noise_floor(const Followed& at) {
  const InverseModel& model = at.runs;
  const auto& noise = model.noise();
  Nrmse found;
  for (const auto& channel : channels_of(model)) {
    const double mass = moved_kg(channel, at.axis);
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

double relative_force_error(const Followed& at) {
  const auto residuals = at.runs.force_residuals_N(at.axis, at.model);
  double off = 0.0, all = 0.0;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    const Track& track = at.runs.tracks()[run];
    const Index settled = track.size - 2 * InverseModel::margin;
    if (settled <= 0) continue;
    const int factor = decimation_keeping(InverseModelSettings{}.band_Hz, track.sample_s);
    const auto square = [&](const Vector& force_N) {
      const auto inner = force_N.segment(InverseModel::margin, settled);
      const auto rows = decimated({inner.data(), static_cast<std::size_t>(inner.size())}, factor);
      return std::inner_product(rows.begin(), rows.end(), rows.begin(), 0.0);
    };
    off += square(residuals[run]);
    all += square(track.command_N);
  }
  return all > 0.0 ? std::sqrt(off / all) : 0.0;
}

Energy energy(const Followed& at) {
  Energy sum;
  for (std::size_t run = 0; run < at.runs.tracks().size(); ++run) {
    const Track& track = at.runs.tracks()[run];
    const auto& base = at.model.base[run];
    const auto& extra = at.model.extra[run];
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
