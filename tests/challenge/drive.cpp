#include "tests/challenge/drive.h"

#include <algorithm>
#include <cmath>

#include "tests/challenge/chance.h"

namespace feedtwin::challenge {
namespace {

constexpr double kN = 1000.0;  ///< element forces are kept in kN, so that one absolute tolerance does for all unknowns

double wave(const Wave& w, double x, double lead_m) {
  return w.amplitude * std::sin(two_pi * w.cycles_per_rev * x / lead_m + w.phase_rad);
}

const Side& side(const Friction& f, double v) {
  return v < 0.0 ? f.neg : f.pos;
}

double steady_N(const Side& s, double speed) {
  return s.coulomb_N + (s.static_N - s.coulomb_N) * std::exp(-speed / s.stribeck_m_per_s);
}

}  // namespace

Drive::Drive(const Axis& axis, const Effects& effects) : axis_(axis), e_(effects), k_(two_pi / axis.lead_m) {
  motor_kg_ = axis.motor_inertia_kgm2 * k_ * k_;
  screw_kg_ = axis.screw_inertia_kgm2 * k_ * k_;
  elements_ = axis.maxwell_slip ? maxwell_elements : 1;
  memory_ = first_element + 2 * elements_;
  size_ = memory_ + (e_.memory_N > 0.0 ? maxwell_elements : 0);
}

double Drive::contact(const Friction& f, std::size_t first, const State& y, State* dy, double v, double film_speed,
                      double sliding, double viscous) const {
  const Side& s = side(f, v);
  const double speed = std::abs(v);
  const double g = steady_N(s, film_speed) * sliding;
  double force = s.viscous_Ns_per_m * viscous * std::copysign(film_speed, v) * std::min(1.0, speed / 1e-5);
  if (!axis_.maxwell_slip) {
    const double bristle_N = kN * y[first];
    const double rate = v - speed * bristle_N / g;
    if (dy != nullptr) (*dy)[first] = f.stiffness_N_per_m * rate / kN;
    return force + bristle_N + f.damping_Ns_per_m * rate;
  }
  force += f.damping_Ns_per_m * v * std::exp(-speed / s.stribeck_m_per_s);
  const double share = g / maxwell_elements;
  const double reference = f.pos.static_N / maxwell_elements;
  for (std::size_t i = 0; i < maxwell_elements; ++i) {
    const double element_N = kN * y[first + i];
    const double load = element_N / share;
    const double slip_m = f.slip_m * (0.25 + 0.75 * static_cast<double>(i) / (maxwell_elements - 1));
    if (dy != nullptr) (*dy)[first + i] = reference / slip_m * (v - speed * load * std::abs(load)) / kN;
    force += element_N;
  }
  return force;
}

double Drive::sliding_factor(const State& y, double t, double v) const {
  double factor = 1.0 + e_.position_friction * y[x1] / (0.5 * axis_.stroke_m);
  factor *= 1.0 + e_.dwell_rise * (1.0 - std::exp(-y[age] / e_.dwell_s));
  factor *= 1.0 + e_.drift_change * (1.0 - std::exp(-t / e_.drift_s));
  if (e_.load_friction > 0.0) {
    // the load on the nut without the guide's own friction, which is there without any load
    const double guide_N = steady_N(side(axis_.guide, y[v2]), std::abs(y[v2])) * (y[v2] < 0.0 ? -1.0 : 1.0);
    const double nut_N = rigid() ? axis_.table_kg * last_acceleration_ + last_table_N_ : coupling_N(y) - guide_N;
    factor *= 1.0 + e_.load_friction * std::abs(nut_N) / side(axis_.screw, v).coulomb_N;
  }
  return std::max(0.01, factor);
}

double Drive::coupling_N(const State& y) const {
  const double d = y[x1] - y[x2];
  const double beyond = std::max(0.0, d - 0.5 * e_.gap_m) + std::min(0.0, d + 0.5 * e_.gap_m);
  if (beyond == 0.0 && e_.gap_m > 0.0) return 0.0;
  const double force = axis_.coupling_N_per_m * beyond + axis_.coupling_damping_Ns_per_m * (y[v1] - y[v2]);
  return e_.gap_m > 0.0 && force * beyond < 0.0 ? 0.0 : force;
}

double Drive::electrical_W(double v, double torque_Nm) const {
  const double speed = std::abs(v);
  return axis_.ke0_W + (v < 0.0 ? axis_.ke1_neg : axis_.ke1_pos) * speed +
         (v < 0.0 ? axis_.ke2_neg : axis_.ke2_pos) * v * v + e_.copper_W_per_Nm2 * torque_Nm * torque_Nm;
}

Drive::Loads Drive::loads(const State& y, State* dy, double t) const {
  const double x = y[x1], v = y[v1];
  const double xt = rigid() ? x : y[x2], vt = rigid() ? v : y[v2];
  Loads l{};
  l.table_kg = axis_.table_kg + e_.payload_kg;
  const double braking = last_acceleration_ * v < 0.0 ? e_.braking_mass_kg : 0.0;

  // torque
  double torque = e_.current_loop_s > 0.0 ? y[current] : command_Nm_;
  torque += e_.hidden_Nm * std::tanh(v / e_.hidden_m_per_s);
  if (e_.dead_zone_Nm > 0.0) torque = std::copysign(std::max(0.0, std::abs(torque) - e_.dead_zone_Nm), torque);
  torque = std::clamp(torque, -e_.saturation_Nm, e_.saturation_Nm) * (1.0 + e_.torque_gain);
  l.motor_Nm = torque * (1.0 + wave(e_.torque_ripple, x, axis_.lead_m));
  l.drive_N = k_ * l.motor_Nm;

  // friction
  const double film_speed = e_.frictional_lag_s > 0.0 ? std::max(0.0, y[film]) : std::abs(v);
  const double film_table = e_.frictional_lag_s > 0.0 ? film_speed : std::abs(vt);
  const double warm = 1.0 - e_.thermal_reduction * (1.0 - std::exp(-std::max(0.0, y[work]) / e_.thermal_J));
  const double drift = 1.0 + e_.drift_change * (1.0 - std::exp(-t / e_.drift_s));
  const double bowl = 1.0 + e_.bowl_viscous * (x / 0.05) * (x / 0.05);
  double screw_N = contact(axis_.screw, first_element, y, dy, v, film_speed, sliding_factor(y, t, v), warm * drift * bowl);
  const double bump = std::exp(-std::pow((xt - e_.local_centre_m) / e_.local_half_width_m, 2.0));
  const double guide_factor = 1.0 + e_.local_height_N * bump / side(axis_.guide, vt).coulomb_N;
  const double guide_N =
      contact(axis_.guide, first_element + elements_, y, dy, vt, film_table, std::max(0.01, guide_factor), 1.0);
  const double mu = side(axis_.screw, v).viscous_Ns_per_m;
  if (e_.sublinear_exponent != 1.0) {
    const double speed = std::sqrt(v * v + 1e-8);
    screw_N += mu * v * (std::pow(speed / e_.sublinear_speed_m_per_s, e_.sublinear_exponent - 1.0) - 1.0);
  }
  if (e_.beat_N > 0.0) screw_N += e_.beat_N * std::sin(two_pi * e_.beat_Hz * t) * std::tanh(v / 1e-3);
  if (e_.washboard_Ns_per_m > 0.0) screw_N += e_.washboard_Ns_per_m * v * std::sin(two_pi * x / 0.017);
  if (e_.memory_N > 0.0) {
    for (std::size_t i = 0; i < maxwell_elements; ++i) {
      const double limit_m = e_.memory_m * (static_cast<double>(i) + 0.5) / maxwell_elements;
      const double deflection_m = 1e-3 * y[memory_ + i];  // kept in mm
      const bool slips = deflection_m * v > 0.0 && std::abs(deflection_m) >= limit_m;
      if (dy != nullptr) (*dy)[memory_ + i] = slips ? 0.0 : 1e3 * v;
      screw_N += 2.0 * e_.memory_N / (maxwell_elements * e_.memory_m) * std::clamp(deflection_m, -limit_m, limit_m);
    }
  }
  l.motor_N = (v < 0.0 ? axis_.motor_damping_neg_Nms : axis_.motor_damping_pos_Nms) * k_ * k_ * v +
              k_ * wave(e_.cogging, x, axis_.lead_m) + (braking > 0.0 ? braking * last_acceleration_ : 0.0);
  l.screw_friction_N = screw_N;
  l.screw_N = screw_N + wave(e_.rev_ripple, x, axis_.lead_m);

  // table
  l.table_N = guide_N + e_.gravity_N + e_.cable_N_per_m * (xt - e_.cable_neutral_m) +
              e_.drag_Ns2_per_m2 * vt * std::abs(vt) + e_.process_mean_N +
              e_.process_N * std::sin(two_pi * e_.process_Hz * t + e_.line_phase_rad) +
              l.table_kg * e_.floor_m_per_s2 * std::sin(two_pi * e_.floor_Hz * t + e_.line_phase_rad);
  const double depth = xt - e_.stop_m;
  if (e_.stop_N_per_m > 0.0 && depth > 0.0) l.table_N += std::max(0.0, e_.stop_N_per_m * depth + e_.stop_Ns_per_m * vt);
  if (e_.slosh_kg > 0.0) {
    const double rate = two_pi * e_.slosh_Hz;
    const double pull = e_.slosh_kg * (rate * rate * (xt - y[slosh_x]) + 0.06 * rate * (vt - y[slosh_v]));
    l.table_N += pull;
    if (dy != nullptr) {
      (*dy)[slosh_x] = y[slosh_v];
      (*dy)[slosh_v] = pull / e_.slosh_kg;
    }
  }
  return l;
}

int Drive::mode_from_rest(const State& y, double t) const {
  const Loads l = loads(y, nullptr, t);
  const double table_N = rigid() ? l.table_N : coupling_N(y);
  const double net_N = l.drive_N - l.motor_N - l.screw_N - table_N;
  if (net_N > axis_.motor_coulomb_pos_N) return 1;
  return net_N < -axis_.motor_coulomb_neg_N ? -1 : 0;
}

Drive::Forces Drive::forces(const State& y, double t) const {
  const Loads l = loads(y, nullptr, t);
  const double coulomb_N = mode_ > 0 ? axis_.motor_coulomb_pos_N : -axis_.motor_coulomb_neg_N;
  const double kg = motor_kg_ + screw_kg_ + (rigid() ? l.table_kg : 0.0);
  const double table_N = rigid() ? l.table_N : coupling_N(y);
  const double a = mode_ == 0 ? 0.0 : (l.drive_N - l.motor_N - coulomb_N - l.screw_N - table_N) / kg;
  const double nut_N = rigid() ? l.table_N + l.table_kg * a : table_N;
  return {(l.screw_N + screw_kg_ * a + nut_N) / k_, nut_N, a};
}

void Drive::remember(const State& y, double t) {
  last_acceleration_ = forces(y, t).acceleration_m_per_s2;
  if (e_.load_friction > 0.0)
    last_table_N_ =
        loads(y, nullptr, t).table_N - steady_N(side(axis_.guide, y[v1]), std::abs(y[v1])) * (y[v1] < 0 ? -1.0 : 1.0);
}

void Drive::operator()(const State& y, State& dy, double t) const {
  std::fill(dy.begin(), dy.end(), 0.0);
  const Loads l = loads(y, &dy, t);
  const double v = y[v1];
  const double table_N = rigid() ? l.table_N : coupling_N(y);
  double coulomb_N = mode_ > 0 ? axis_.motor_coulomb_pos_N : -axis_.motor_coulomb_neg_N;
  if (mode_ != 0) {
    const double kg = motor_kg_ + screw_kg_ + (rigid() ? l.table_kg : 0.0);
    dy[v1] = (l.drive_N - l.motor_N - coulomb_N - l.screw_N - table_N) / kg;
    dy[x1] = v;
  }
  if (rigid()) {
    dy[x2] = dy[x1];
    dy[v2] = dy[v1];
  } else {
    dy[x2] = y[v2];
    dy[v2] = (table_N - l.table_N) / l.table_kg;
  }
  if (e_.current_loop_s > 0.0) dy[current] = (command_Nm_ - y[current]) / e_.current_loop_s;
  if (e_.frictional_lag_s > 0.0) dy[film] = (std::abs(v) - y[film]) / e_.frictional_lag_s;
  if (e_.dwell_rise != 0.0) dy[age] = 1.0 - std::abs(v) * y[age] / e_.dwell_memory_m;
  dy[work] = l.screw_friction_N * v;
  const double power_W = electrical_W(v, l.motor_Nm) + l.drive_N * v;
  dy[input] = power_W < 0.0 ? (1.0 - e_.regeneration_lost) * power_W : power_W;
}

}  // namespace feedtwin::challenge
