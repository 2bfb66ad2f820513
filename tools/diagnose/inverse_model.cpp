#include "tools/diagnose/inverse_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/axis_model.h"
#include "tools/diagnose/motor_friction.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

std::vector<Equation> equations_for(const Track& track) {
  const bool torque = track.torque_sensor_N.size() > 0, force = track.force_sensor_N.size() > 0;
  std::vector<Equation> found;
  Equation open{.name = "motor", .motor = true};
  const auto close = [&](bool sensor, const std::string& next) {
    if (sensor) {
      found.push_back(open);
      open = {.name = next};
    } else {
      open.name += "+" + next;
    }
  };
  close(torque, "screw");
  open.screw = true;
  close(force, "guide");
  open.guide = true;
  found.push_back(open);
  if (track.slip_m.size() > 0) found.push_back({.name = "slip", .slip = true});
  if (!track.meter.starts.empty()) found.push_back({.name = "power", .power = true});
  return found;
}

Contribution contribution_of(const std::vector<Active>& effects, const View& view) {
  Contribution sum;
  for (const auto& effect : effects)
    if (gives_forces(*effect.hypothesis)) effect.hypothesis->apply(view, effect.q, sum);
  return sum;
}

/// By sample: does the axis stand, or did it a sample before, or will it a sample later?
std::vector<char> stands_about(const Track& track) {
  const auto slow = [&track](Index at) {
    const Index i = std::clamp<Index>(at, 0, track.size - 1);
    return std::abs(track.centred_m_per_s[i]) < standstill_m_per_s;
  };
  std::vector<char> stands;
  for (Index i = 0; i < track.size; ++i) stands.push_back(slow(i) || slow(i - 1) || slow(i + 1) ? 1 : 0);
  return stands;
}

/// The triangular mean over a sample to either side of what is known at the samples.
Vector meant(const Vector& at) {
  Vector out = at;
  const Index n = at.size();
  if (n > 2) out.segment(1, n - 2) += (at.head(n - 2) - 2.0 * at.segment(1, n - 2) + at.tail(n - 2)) / 12.0;
  return out;
}

}  // namespace

InverseModel::InverseModel(std::vector<Track> tracks, const plant::AxisParameters& nominal)
    : tracks_(std::move(tracks)),
      nominal_(nominal),
      equations_(equations_for(tracks_.front())),
      low_pass_(low_pass_to(samples_a_row())) {
  for (std::size_t e = 0; e < equations_.size(); ++e)
    for (std::size_t r = 0; r < tracks_.size(); ++r) {
      const Track& track = tracks_[r];
      const Index size = equations_[e].power ? static_cast<Index>(track.meter.starts.size())
                                             : std::max<Index>(0, (track.size - 2 * margin) / samples_a_row());
      segments_.push_back({e, r, rows_, size});
      rows_ += size;
      power_ = power_ || equations_[e].power;
    }
  for (const Track& track : tracks_) at_rest_.push_back(stands_about(track));
  weigh_noise();
  find_settled();
}

Baseline InverseModel::baseline(const plant::AxisParameters& axis, const ContactForces& contacts, std::size_t run) const {
  const Track& track = tracks_[run];
  const auto model = plant::make_axis_model(axis);
  Baseline base;
  Vector motor = motor_coulomb_N(track, axis), power(track.size);
  const auto& electrical = axis.motor;
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.velocity_m_per_s[k];
    const bool forward = v > 0.0;
    motor[k] += (forward ? model.damping_pos_Ns_per_m : model.damping_neg_Ns_per_m) * v;
    const auto& linear = electrical.electrical_linear_Ws_per_m;
    const auto& quadratic = electrical.electrical_quadratic_Ws2_per_m2;
    const double now = track.metered_m_per_s[k];
    const bool on = now > 0.0;
    power[k] = electrical.electrical_idle_W + (on ? linear.pos : linear.neg) * std::abs(now) +
               (on ? quadratic.pos : quadratic.neg) * now * now + track.held_N[k] * now;
  }
  base.motor_N = about_sample(motor);
  base.screw_N = about_sample(contacts.screw_N);
  base.guide_N = about_sample(contacts.guide_N);
  base.power_W = std::move(power);
  return base;
}

Vector InverseModel::recorded_side(const Equation& equation, std::size_t run) const {
  const Track& track = tracks_[run];
  if (equation.slip) return track.slip_m;
  Vector y = equation.motor ? track.command_N : (equation.screw ? track.torque_sensor_N : track.force_sensor_N);
  if (equation.motor && !equation.screw) y -= track.torque_sensor_N;
  if (equation.screw && !equation.guide) y -= track.force_sensor_N;
  return y;
}

Vector InverseModel::added(const Equation& equation, std::size_t run, const Contribution& extra) const {
  const Track& track = tracks_[run];
  Vector sum;
  const auto adds = [&sum](double sign, const Vector& more) {
    if (more.size() == 0) return;
    if (sum.size() == 0)
      sum = sign * more;
    else
      sum += sign * more;
  };
  if (equation.slip) {
    adds(-1.0, extra.slip_m);
    return sum;
  }
  if (equation.power) {
    adds(1.0, extra.power_W);
    for (const Vector* torque_N : {&extra.drive_N, &extra.metered_drive_N})
      if (torque_N->size() > 0 && !track.meter.of_command) adds(1.0, torque_N->cwiseProduct(track.metered_m_per_s));
    return sum;
  }
  if (equation.screw) adds(-1.0, meant(extra.screw_N));
  if (equation.guide) adds(-1.0, meant(extra.guide_N));
  if (equation.motor) {
    adds(-1.0, meant(extra.motor_N));
    adds(1.0, extra.drive_N);
  }
  if (equation.motor != equation.screw) adds(equation.motor ? 1.0 : -1.0, extra.torque_sensor_N);
  if (equation.screw != equation.guide) adds(equation.screw ? 1.0 : -1.0, extra.force_sensor_N);
  return sum;
}

Vector InverseModel::balance_N(const Equation& equation, std::size_t run, const plant::AxisParameters& axis,
                               const Contribution& extra, const Baseline& base) const {
  const Track& track = tracks_[run];
  Vector r = recorded_side(equation, run);
  const double k = 2.0 * std::numbers::pi / axis.axis.lead_m;
  const double motor_kg = axis.motor.inertia_kgm2 * k * k, screw_kg = axis.ball_screw_inertia_kgm2 * k * k;
  const double table_kg = axis.guide_mass_kg + extra.table_mass_kg;
  const double per_mass = 1.0 / (motor_kg + screw_kg + table_kg);
  if (equation.motor != equation.screw || equation.screw != equation.guide) {
    Vector step_N = track.half_step_N;
    if (extra.drive_step_N.size() > 0 && step_N.size() > 0) step_N += extra.drive_step_N;
    if (equation.motor != equation.screw)
      r += (equation.motor ? 1.0 : -1.0) * track.jump_shares.torque * (screw_kg + table_kg) * per_mass * step_N;
    if (equation.screw != equation.guide)
      r += (equation.screw ? 1.0 : -1.0) * track.jump_shares.force * table_kg * per_mass * step_N;
  }
  if (equation.screw) r -= screw_kg * track.acceleration_m_per_s2 + base.screw_N;
  // in one equation with the motor both masses must see the same noise, or the quieter ruler draws the mass to itself
  const bool one = equation.screw || equation.motor;
  if (equation.guide) r -= table_kg * (one ? track.acceleration_m_per_s2 : track.table_acceleration_m_per_s2) + base.guide_N;
  if (equation.motor) r -= motor_kg * track.acceleration_m_per_s2;
  if (const Vector more = added(equation, run, extra); more.size() > 0) r += more;
  return r;
}

double InverseModel::beyond_coulomb_N(double balance_N, const plant::AxisParameters& axis) {
  return balance_N - std::clamp(balance_N, -axis.motor.coulomb_N.neg, axis.motor.coulomb_N.pos);
}

Vector InverseModel::raw_residual(const Equation& equation, std::size_t run, const plant::AxisParameters& axis,
                                  const Contribution& extra, const Baseline& base) const {
  if (equation.power || equation.slip) {
    Vector r = equation.power ? base.power_W : recorded_side(equation, run);
    if (const Vector more = added(equation, run, extra); more.size() > 0) r += more;
    return r;
  }
  Vector r = balance_N(equation, run, axis, extra, base);
  if (!equation.motor) return r;
  // the motor's Coulomb friction: as it must be in motion, whatever is needed within its bounds at rest
  for (Index i = 0; i < r.size(); ++i)
    r[i] = at_rest_[run][static_cast<std::size_t>(i)] != 0 ? beyond_coulomb_N(r[i], axis) : r[i] - base.motor_N[i];
  return r;
}

double InverseModel::weight(const Equation& equation, const plant::AxisParameters& axis, const Contribution& extra) const {
  if (equation.power || equation.slip) return 1.0;
  const double share = acceleration_share_[static_cast<std::size_t>(&equation - equations_.data())];
  const double heavier = (moved_kg(equation, axis) + equation.guide * extra.table_mass_kg) / moved_kg(equation, nominal_);
  return 1.0 / std::sqrt(1.0 - share + share * heavier * heavier);
}

InverseModel::Prepared InverseModel::prepared(const plant::AxisParameters& axis, const std::vector<Active>& effects,
                                              const std::vector<ContactForces>& contacts) const {
  Prepared model{std::vector<Baseline>(tracks_.size()), std::vector<Contribution>(tracks_.size())};
  parallel_for(tracks_.size(), [&](std::size_t run) {
    model.base[run] = baseline(axis, contacts[run], run);
    model.extra[run] = contribution_of(effects, {tracks_[run], axis, model.base[run]});
  });
  return model;
}

Vector InverseModel::residual(const plant::AxisParameters& axis, const std::vector<Active>& effects,
                              const std::vector<ContactForces>& contacts) const {
  return residual(axis, prepared(axis, effects, contacts), Rows::weighted);
}

Vector InverseModel::residual(const plant::AxisParameters& axis, const Prepared& model, Rows which) const {
  Vector rows(rows_);
  parallel_for(segments_.size(), [&](std::size_t i) {
    const auto& s = segments_[i];
    if (s.size == 0) return;
    const auto& equation = equations_[s.equation];
    const auto& extra = model.extra[s.run];
    const double by = which == Rows::weighted ? weight(equation, axis, extra) : 1.0;
    store(s, by * raw_residual(equation, s.run, axis, extra, model.base[s.run]), rows);
  });
  return rows;
}

Vector InverseModel::residual(const plant::AxisParameters& axis, const std::vector<Active>& effects) const {
  return residual(axis, effects, contacts(axis, effects));
}

std::vector<Vector> InverseModel::force_residuals_N(const plant::AxisParameters& axis, const Prepared& model) const {
  std::vector<Vector> runs;
  for (std::size_t run = 0; run < tracks_.size(); ++run) {
    Vector sum = Vector::Zero(tracks_[run].size);
    for (const auto& equation : equations_)
      if (!equation.slip && !equation.power) sum += raw_residual(equation, run, axis, model.extra[run], model.base[run]);
    runs.push_back(std::move(sum));
  }
  return runs;
}

Vector InverseModel::recorded() const {
  Vector rows(rows_);
  for (const auto& segment : segments_) {
    if (equations_[segment.equation].power)
      rows.segment(segment.start, segment.size) =
          Eigen::Map<const Vector>(tracks_[segment.run].meter.power_W.data(), segment.size);
    else
      store(segment, recorded_side(equations_[segment.equation], segment.run), rows);
  }
  return rows;
}

}  // namespace feedtwin::tools::diagnosis
