#pragma once
// A job run off line from start to end of its program.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "controllers/gcode/program_controller.h"
#include "plant/machine/machine.h"
#include "rt/machine_plant.h"
#include "tools/machine/job.h"

namespace feedtwin::tools {

using plant::ComponentPower;

/// One row of a run's figures, and of its recording; powers are means since the last one.
struct MachineSample : rt::MachineRecord {
  double x_reference_m = 0.0, y_reference_m = 0.0, contour_error_m = 0.0;
};

/// What a run comes to.
struct MachineTotals {
  plant::MachineEnergy energy;
  double time_s = 0.0, cutting_time_s = 0.0;
  double contour_peak_m = 0.0, contour_rms_m = 0.0;
  double tracking_peak_m = 0.0, tracking_rms_m = 0.0;  ///< of the worse axis at each instant
  double peak_cutting_torque_Nm = 0.0, peak_force_N = 0.0;
  ComponentPower before_cutting, cutting, after_cutting;
  std::int64_t clipped_inputs = 0, stalled_ticks = 0;
  std::uint64_t ticks = 0;
  double wall_s = 0.0;

  [[nodiscard]] double removal_rate_m3_per_s() const noexcept {
    return cutting_time_s > 0.0 ? energy.removed_m3 / cutting_time_s : 0.0;
  }
  /// Energy of the whole program for the volume removed; 0 where nothing was.
  [[nodiscard]] double specific_energy_J_per_m3() const noexcept {
    return energy.removed_m3 > 0.0 ? energy.total_J() / energy.removed_m3 : 0.0;
  }
};

struct MachineResult : MachineTotals {
  std::vector<MachineSample> samples;
};

/// The program interpreted, planned and matched with the workpiece. Throws InputError naming the program's line and column.
[[nodiscard]] controllers::gcode::ProgramController prepare_program(const MachineJob& job);

/// @param sample_every_ticks 0: no samples
[[nodiscard]] MachineResult run_machine(const MachineJob& job, int sample_every_ticks = 0);

/// Every component's energy by its name in the JSON, J; they add up to the input.
[[nodiscard]] std::vector<std::pair<std::string, double>> energy_by_component(const plant::MachineEnergy& energy);

}  // namespace feedtwin::tools
