#include "tools/machine/machine_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "controllers/gcode/planner.h"
#include "tools/config/input_error.h"
#include "tools/run/axis_components.h"

namespace feedtwin::tools {
namespace {

namespace gcode = controllers::gcode;

/// Adds up windows of one kind that are not adjoining.
struct Window {
  double pump_J = 0.0, controller_J = 0.0, spindle_J = 0.0, feed_J = 0.0, time_s = 0.0;
  void add(const plant::MachineEnergy& from, const plant::MachineEnergy& to) {
    pump_J += to.pump_J - from.pump_J;
    controller_J += to.controller_J - from.controller_J;
    spindle_J += to.spindle_J() - from.spindle_J();
    feed_J += to.feed_J() - from.feed_J();
    time_s += to.time_s - from.time_s;
  }
  [[nodiscard]] ComponentPower mean() const {
    if (time_s <= 0.0) return {};
    return {pump_J / time_s, controller_J / time_s, spindle_J / time_s, feed_J / time_s};
  }
};

class Run {
 public:
  Run(const MachineJob& job, int sample_every)
      : job_(job), controller_(prepare_program(job)), machine_(job.machine), every_(sample_every) {}

  MachineResult go() {
    const auto began = std::chrono::steady_clock::now();
    double square = 0.0, tracking_square = 0.0;
    while (!controller_.finished()) {
      const auto& signals = step();
      const double contour = controller_.contour_error_m(signals.x.position_m, signals.y.position_m);
      const auto& at = controller_.setpoint().at_m;
      const double tracking = std::max(std::abs(at.x - before_x_m_), std::abs(at.y - before_y_m_));
      square += contour * contour;
      tracking_square += tracking * tracking;
      result_.contour_peak_m = std::max(result_.contour_peak_m, contour);
      result_.tracking_peak_m = std::max(result_.tracking_peak_m, tracking);
      result_.peak_cutting_torque_Nm = std::max(result_.peak_cutting_torque_Nm, signals.cut.torque_Nm);
      result_.peak_force_N = std::max(result_.peak_force_N, std::hypot(signals.cut.force_x_N, signals.cut.force_y_N));
      ++result_.ticks;
      if (every_ > 0 && result_.ticks % static_cast<std::uint64_t>(every_) == 0) sample(signals, contour);
    }
    close_window();
    const double ticks = std::max(1.0, static_cast<double>(result_.ticks));
    result_.contour_rms_m = std::sqrt(square / ticks);
    result_.tracking_rms_m = std::sqrt(tracking_square / ticks);
    finish(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    return std::move(result_);
  }

 private:
  enum class Phase { starting, before, cutting, after };

  const plant::MachineSignals& step() {
    const auto& signals = machine_.signals();
    before_x_m_ = signals.x.position_m;
    before_y_m_ = signals.y.position_m;
    const auto& command = controller_.step(machine_.x().encoder().position_m(signals.x.encoder_counts),
                                           machine_.y().encoder().position_m(signals.y.encoder_counts), job_.tick_s);
    const Phase phase = phase_of(command);
    if (phase != phase_) {
      close_window();
      phase_ = phase;
    }
    if (phase == Phase::cutting) result_.cutting_time_s += job_.tick_s;
    return machine_.step(command, job_.tick_s);
  }

  /// "Before the machining": the spindle holds its speed, the table stands and the tool has not met material yet.
  Phase phase_of(const plant::MachineCommand& command) const {
    if (command.engagement.cutting()) return Phase::cutting;
    if (phase_ == Phase::cutting || phase_ == Phase::after) return Phase::after;
    const double wanted = command.spindle_speed_rad_per_s, speed = machine_.signals().spindle_speed_rad_per_s;
    const bool ready = wanted != 0.0 && std::abs(speed - wanted) < 1e-3 * std::abs(wanted) && !controller_.setpoint().moving;
    return ready ? Phase::before : Phase::starting;
  }

  void close_window() {
    const plant::MachineEnergy now = machine_.energy();
    if (phase_ == Phase::before) before_.add(window_from_, now);
    if (phase_ == Phase::cutting) cutting_.add(window_from_, now);
    if (phase_ == Phase::after) after_.add(window_from_, now);
    window_from_ = now;
  }

  void sample(const plant::MachineSignals& s, double contour) {
    const plant::MachineEnergy now = machine_.energy();
    MachineSample row{rt::record_of(s, last_sample_, now, phase_ == Phase::cutting)};
    const auto& at = controller_.setpoint().at_m;
    row.x_reference_m = at.x;
    row.y_reference_m = at.y;
    row.contour_error_m = contour;
    result_.samples.push_back(row);
    last_sample_ = now;
  }

  void finish(double wall_s) {
    result_.energy = machine_.energy();
    result_.time_s = result_.energy.time_s;
    result_.before_cutting = before_.mean();
    result_.cutting = cutting_.mean();
    result_.after_cutting = after_.mean();
    result_.clipped_inputs = machine_.clipped_inputs();
    result_.stalled_ticks = machine_.stalled_ticks();
    result_.wall_s = wall_s;
  }

  const MachineJob& job_;
  gcode::ProgramController controller_;
  plant::Machine machine_;
  int every_;
  MachineResult result_;
  Phase phase_ = Phase::starting;
  plant::MachineEnergy window_from_, last_sample_;
  Window before_, cutting_, after_;
  double before_x_m_ = 0.0, before_y_m_ = 0.0;
};

}  // namespace

gcode::ProgramController prepare_program(const MachineJob& job) {
  try {
    const auto program = gcode::interpret(job.program_text, job.interpreter);
    gcode::PlannerSettings planner;
    planner.start_m = job.interpreter.start_m;
    planner.limits = job.limits;
    planner.blend_tolerance_m = job.blend_tolerance_m;
    planner.feed_override = job.feed_override;
    double speed_override = job.spindle_override;
    const double radius_m = 0.5 * job.machine.tool.diameter_m;
    auto trajectory = gcode::plan(program, planner);
    gcode::EngagementMap engagement(trajectory, job.block, radius_m);
    if (job.removal_rate_mm3_per_s > 0.0) {
      if (engagement.removal_rate_m3_per_s() <= 0.0) {
        throw InputError(job.program_name, 0, "process.mrr_mm3_per_s",
                         "the program cuts nothing, so no removal rate can be set");
      }
      const double scale = job.removal_rate_mm3_per_s * 1e-9 / engagement.removal_rate_m3_per_s();
      planner.feed_override *= scale;
      speed_override *= scale;
      trajectory = gcode::plan(program, planner);
      engagement = gcode::EngagementMap(trajectory, job.block, radius_m);
    }
    return {std::move(trajectory), std::move(engagement), cascade_of(job.x_loop, job.machine.x),
            cascade_of(job.y_loop, job.machine.y), speed_override};
  } catch (const gcode::GcodeError& error) {
    throw InputError(fmt::format("{}:{}:{}: {}", job.program_name, error.line(), error.column(), error.what()));
  }
}

MachineResult run_machine(const MachineJob& job, int sample_every_ticks) {
  return Run(job, sample_every_ticks).go();
}

std::vector<std::pair<std::string, double>> energy_by_component(const plant::MachineEnergy& e) {
  std::vector<std::pair<std::string, double>> all{
      {"pump", e.pump_J},
      {"controller", e.controller_J},
      {"spindle_electrical", e.spindle.electrical_J},
      {"spindle_mechanical", e.spindle.friction_J + e.spindle.kinetic_J},
      {"spindle_cutting", e.spindle.cutting_J},
  };
  const auto add_axis = [&](const std::string& letter, const plant::AxisEnergy& a) {
    for (const auto& component : axis_components) all.emplace_back(letter + "_" + component.name, a.*component.joules);
    all.emplace_back(letter + "_cutting", a.cutting_J);
    all.emplace_back(letter + "_end_stop", a.end_stop_J);
  };
  add_axis("x", e.x);
  add_axis("y", e.y);
  return all;
}

}  // namespace feedtwin::tools
