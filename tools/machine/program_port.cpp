#include "tools/machine/program_port.h"

#include <algorithm>
#include <cmath>

#include "plant/machine/machine.h"
#include "tools/machine/machine_run.h"

namespace feedtwin::tools {

ProgramPort::ProgramPort(const MachineJob& job)
    : controller_(prepare_program(job)),
      x_(plant::FeedAxis(job.machine.x).encoder()),
      y_(plant::FeedAxis(job.machine.y).encoder()),
      tick_s_(job.tick_s) {}

std::uint64_t ProgramPort::ticks() const noexcept {
  return static_cast<std::uint64_t>(std::ceil(controller_.trajectory().duration_s() / tick_s_));
}

double ProgramPort::reference_m(std::size_t axis, std::uint64_t tick) noexcept {
  return controller_.trajectory().at(static_cast<double>(tick) * tick_s_, reader_).at_m[static_cast<int>(axis)];
}

void ProgramPort::send(const io::TickReport& tick, std::span<const io::AxisReport> axes) noexcept {
  const double x_m = x_.position_m(axes[0].encoder_counts), y_m = y_.position_m(axes[1].encoder_counts);
  if (sequence_ > 0) contour_peak_m_ = std::max(contour_peak_m_, controller_.contour_error_m(x_m, y_m));
  command_ = controller_.step(x_m, y_m, tick_s_);
  // a controller that came back after a stall clears the watchdog's fault by giving the enable anew
  enable_ = axes[0].state != io::DriveState::fault && axes[1].state != io::DriveState::fault;
  now_ns_ = tick.start_ns;
  ++sequence_;
  pending_ = machine_pending_ = true;
}

std::uint64_t ProgramPort::receive(std::span<io::AxisRequest> newest) noexcept {
  if (!pending_) return 0;
  pending_ = false;
  for (std::size_t i = 0; i < 2; ++i) {
    newest[i].torque_Nm = i == 0 ? command_.torque_x_Nm : command_.torque_y_Nm;
    newest[i].sequence = sequence_;
    newest[i].arrival_ns = now_ns_;
    newest[i].enable = enable_;
  }
  return 0b11;
}

bool ProgramPort::receive_machine(io::MachineRequest& newest) noexcept {
  if (!machine_pending_) return false;
  machine_pending_ = false;
  newest.spindle_speed_rad_per_s = command_.spindle_speed_rad_per_s;
  newest.pump = command_.pump;
  newest.path_engagement = true;
  newest.engagement = command_.engagement;
  return true;
}

}  // namespace feedtwin::tools
