#pragma once
// The machine's controller inside the program, running G-code through the same port as a real one: it gets the encoders'
// counts with a tick's report and has torques, spindle speed and M-codes ready for the next tick.

#include "controllers/gcode/program_controller.h"
#include "io/port.h"
#include "plant/encoder.h"
#include "tools/machine/job.h"

namespace feedtwin::tools {

class ProgramPort final : public io::Port {
 public:
  /// Throws InputError naming the program's line and column.
  explicit ProgramPort(const MachineJob& job);

  [[nodiscard]] std::string_view name() const noexcept override { return "program"; }
  void open() override {}
  void close() noexcept override {}
  std::uint64_t receive(std::span<io::AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  bool receive_machine(io::MachineRequest& newest) noexcept FEEDTWIN_REALTIME override;
  void send(const io::TickReport& tick, std::span<const io::AxisReport> axes) noexcept FEEDTWIN_REALTIME override;

  /// Ticks from the program's start to its end.
  [[nodiscard]] std::uint64_t ticks() const noexcept;
  /// Where an axis should be at the start of a tick. From one thread, beside the tick's.
  [[nodiscard]] double reference_m(std::size_t axis, std::uint64_t tick) noexcept;
  /// Largest distance of the measured position from the programmed path so far.
  [[nodiscard]] double contour_peak_m() const noexcept { return contour_peak_m_; }

 private:
  controllers::gcode::ProgramController controller_;
  plant::Encoder x_, y_;
  double tick_s_;
  controllers::gcode::Trajectory::Cursor reader_;  ///< of reference_m()
  plant::MachineCommand command_;
  std::uint32_t sequence_ = 0;
  std::int64_t now_ns_ = 0;
  bool enable_ = true, pending_ = false, machine_pending_ = false;
  double contour_peak_m_ = 0.0;
};

}  // namespace feedtwin::tools
