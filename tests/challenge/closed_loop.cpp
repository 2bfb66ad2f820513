#include "tests/challenge/closed_loop.h"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <random>

#include "tests/challenge/drive.h"

namespace feedtwin::challenge {
namespace {

namespace odeint = boost::numeric::odeint;
constexpr double tick_s = 1e-3;

/// Dormand-Prince with step control; steps end where the motor comes to a stop, and there it may stick.
class Integrator {
 public:
  Integrator(Drive& drive, State y) : drive_(drive), y_(std::move(y)) {}

  void advance(double from, double to) {
    const auto system = [this](const State& y, State& dy, double t) { drive_(y, dy, t); };
    double t = from;
    controlled_.reset();
    while (to - t > 1e-12) {
      if (drive_.mode() == 0) {
        drive_.set_mode(drive_.mode_from_rest(y_, t));
        if (drive_.mode() != 0) controlled_.reset();
      }
      step_s_ = std::clamp(step_s_, 1e-10, 2e-4);
      double h = std::min(step_s_, to - t);
      const bool cut = h < step_s_;
      before_ = y_;
      const double start = t;
      if (controlled_.try_step(system, y_, t, h) != odeint::success) {
        step_s_ = h;
        continue;
      }
      if (!cut || h < step_s_) step_s_ = h;
      if (drive_.mode() * drive_.motor_m_per_s(y_) < 0.0) t = end_at_stop(system, start, t);
      drive_.remember(y_, t);
    }
  }

  [[nodiscard]] const State& state() const { return y_; }

 private:
  template <class System>
  double end_at_stop(const System& system, double start, double end) {
    const double v0 = drive_.motor_m_per_s(before_);
    double h = end - start;
    y_ = before_;
    if (v0 != 0.0) {
      double v = 0.0;
      double low = 0.0, high = h;
      for (int i = 0; i < 30; ++i) {  // bisection is sure, and stops are rare
        const double middle = 0.5 * (low + high);
        plain_.do_step(system, before_, start, y_, middle);
        v = drive_.motor_m_per_s(y_);
        (drive_.mode() * v > 0.0 ? low : high) = middle;
        h = middle;
        if (std::abs(v) < 1e-10) break;
      }
    } else {
      h = 0.0;
    }
    drive_.stop_motor(y_);
    drive_.set_mode(0);
    if (v0 != 0.0) drive_.set_mode(drive_.mode_from_rest(y_, start + h));
    if (h == 0.0) h = 1e-7;  // out of rest and straight back: stay for a moment
    controlled_.reset();
    return start + h;
  }

  using Stepper = odeint::runge_kutta_dopri5<State>;
  Drive& drive_;
  State y_, before_;
  double step_s_ = 1e-6;
  odeint::controlled_runge_kutta<Stepper> controlled_ = odeint::make_controlled(1e-9, 1e-7, Stepper());
  odeint::runge_kutta_dopri5<State> plain_;
};

/// Coloured noise of unit rms, in bursts if wanted.
class Hiss {
 public:
  Hiss(double colour, double burst_share, std::uint64_t seed) : random_(seed), colour_(colour), burst_share_(burst_share) {}
  double next() {
    state_ = colour_ * state_ + std::sqrt(1.0 - colour_ * colour_) * normal_(random_);
    if (burst_share_ > 0.0 && --left_ < 0) {
      loud_ = std::uniform_real_distribution<double>(0.0, 1.0)(random_) < burst_share_;
      left_ = std::uniform_int_distribution<int>(50, 250)(random_);
    }
    return loud_ ? 5.0 * state_ : state_;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double colour_, burst_share_, state_ = 0.0;
  bool loud_ = false;
  int left_ = 0;
};

double counted(double position_m, double count_m) {
  return std::floor(position_m / count_m) * count_m;
}

/// A channel that comes late: the line between the two samples around t - delay.
double delayed(const std::vector<double>& past, double delay_s) {
  const double ticks = delay_s / tick_s;
  const auto whole = static_cast<std::size_t>(ticks);
  const auto ago = [&past](std::size_t n) { return n < past.size() ? past[past.size() - 1 - n] : past.front(); };
  const double part = ticks - static_cast<double>(whole);
  return (1.0 - part) * ago(whole) + part * ago(whole + 1);
}

/// What the motor encoder shows of the shaft.
class MotorEncoder {
 public:
  MotorEncoder(const Axis& axis, const Effects& e, const Noise& noise, std::uint64_t seed)
      : axis_(axis), e_(e), noise_(noise), hiss_(0.0, 0.0, seed), count_m_(axis.lead_m / axis.counts_per_rev) {}
  /// As table travel with the lead that the user believes in.
  double shown_m(double shaft_m) {
    const double angle = 6.283185307179586 * shaft_m / axis_.lead_m;
    const double wobble_m = e_.encoder_eccentricity.amplitude *
                            std::sin(e_.encoder_eccentricity.cycles_per_rev * angle + e_.encoder_eccentricity.phase_rad);
    const double turns = std::floor((angle - e_.count_angle_rad) / 6.283185307179586) + 1.0;
    const double lost_m = turns * e_.count_loss * count_m_;
    const double noise_m = noise_.encoder_counts * count_m_ * hiss_.next(), phase_m = noise_.grid_phase_counts * count_m_;
    const double read_m = counted(shaft_m + wobble_m + noise_m + phase_m, count_m_) - phase_m - lost_m;
    return read_m / e_.lead_factor;
  }

 private:
  Axis axis_;
  Effects e_;
  Noise noise_;
  Hiss hiss_;
  double count_m_;
};

double scale_m(const Axis& axis, const Effects& e, double table_m, double t) {
  const double wobble_m = e.cyclic_lead_error.amplitude *
                          std::sin(6.283185307179586 * e.cyclic_lead_error.cycles_per_rev * table_m / axis.lead_m +
                                   e.cyclic_lead_error.phase_rad);
  const double growth = e.screw_growth * (1.0 - std::exp(-t / e.screw_growth_s)) * (table_m - e.screw_fixed_end_m);
  return (table_m * (1.0 + e.lead_error) + wobble_m + growth) * e.scale_gain;
}

}  // namespace

Run record(const Axis& true_axis, const Effects& effects, const Noise& noise, const Gains& gains, const MotionPlan& plan,
           std::uint64_t seed) {
  Axis axis = true_axis;
  axis.lead_m *= effects.lead_factor;
  Drive drive(axis, effects);
  Integrator integrator(drive, drive.at_rest());
  MotorEncoder encoder(axis, effects, noise, seed * 7 + 1);
  Hiss torque_hiss(noise.colour, noise.burst_share, seed * 7 + 2), force_hiss(noise.colour, noise.burst_share, seed * 7 + 3);
  Hiss disturbance(std::exp(-tick_s / noise.disturbance_s), noise.burst_share, seed * 7 + 4);
  const double k = 6.283185307179586 / true_axis.lead_m;

  Run run;
  std::vector<double> commands, torques, forces, scales;
  double last_m = 0.0, integral_N = 0.0, shown_W = 0.0, window_start_J = 0.0, window_start_s = 0.0;
  const int ticks = static_cast<int>(plan.duration_s / tick_s);
  const int delay_ticks = static_cast<int>(effects.input_delay_s / tick_s);
  const double delay_rest_s = effects.input_delay_s - delay_ticks * tick_s;
  for (int i = 0; i < ticks; ++i) {
    const double t = i * tick_s;
    const State& y = integrator.state();
    // controller
    const double measured_m = encoder.shown_m(drive.motor_m(y));
    const double r0 = reference_m(plan, t), r1 = reference_m(plan, t + tick_s), r2 = reference_m(plan, t + 2 * tick_s);
    const double wanted = gains.position_per_s * (r0 - measured_m) + gains.velocity_feedforward * (r1 - r0) / tick_s;
    const double error = wanted - (measured_m - last_m) / tick_s;
    last_m = measured_m;
    integral_N += gains.integral_N_per_m * error * tick_s;
    const double force_N = gains.velocity_Ns_per_m * error + integral_N +
                           gains.acceleration_feedforward_kg * (r2 - 2.0 * r1 + r0) / (tick_s * tick_s);
    const double command = std::round(1e6 * std::clamp(force_N / k, -axis.torque_limit_Nm, axis.torque_limit_Nm)) * 1e-6;
    commands.push_back(command + effects.torque_offset_Nm -
                       (noise.disturbance_N > 0.0 ? noise.disturbance_N / k * disturbance.next() : 0.0));

    // sensors, with the command that acts from here on
    const auto ago = [&commands](int n) {
      return n < static_cast<int>(commands.size()) ? commands[commands.size() - 1 - static_cast<std::size_t>(n)] : 0.0;
    };
    drive.set_torque(delay_rest_s > 0.0 ? ago(delay_ticks + 1) : ago(delay_ticks));
    if (drive.mode() == 0) drive.set_mode(drive.mode_from_rest(y, t));
    const auto sensed = drive.forces(y, t);
    torques.push_back(effects.torque_sensor_sign * effects.torque_sensor_gain * sensed.torque_sensor_Nm);
    forces.push_back(effects.force_sensor_sign * effects.force_sensor_gain * sensed.nut_N);
    scales.push_back(scale_m(axis, effects, drive.table_m(y), t));
    Sample s{};
    s.time_s = t;
    s.torque_cmd_Nm = command;
    s.position_m = measured_m;
    s.scale_position_m = std::round(delayed(scales, effects.scale_delay_s) * 1e8) * 1e-8;
    s.torque_sensor_Nm = delayed(torques, effects.torque_sensor_delay_s) + noise.torque_sensor_Nm * torque_hiss.next();
    s.force_sensor_N = delayed(forces, effects.force_sensor_delay_s) + noise.force_sensor_N * force_hiss.next();
    if (t - window_start_s > effects.meter_window_s - 0.5 * tick_s) {
      shown_W = effects.power_gain * (drive.input_J(y) - window_start_J) / (t - window_start_s);
      window_start_J = drive.input_J(y);
      window_start_s = t;
    }
    s.power_W = shown_W;
    const double before_m_per_s = drive.motor_m_per_s(y);
    run.push_back(s);

    if (delay_rest_s > 0.0) {
      integrator.advance(t, t + delay_rest_s);
      drive.set_torque(ago(delay_ticks));
      integrator.advance(t + delay_rest_s, t + tick_s);
    } else {
      integrator.advance(t, t + tick_s);
    }
    // means over the tick that the command is held in: at its beginning a delayed command has not yet come
    const double after_m_per_s = drive.motor_m_per_s(integrator.state());
    run.back().true_velocity_m_per_s = 0.5 * (before_m_per_s + after_m_per_s);
    run.back().true_acceleration_m_per_s2 = (after_m_per_s - before_m_per_s) / tick_s;
  }
  return run;
}

}  // namespace feedtwin::challenge
