#pragma once
// A job: a machine, its controller, a program and a workpiece. Everything that a machine file or --set can change.

#include <string>

#include "controllers/cascade_law.h"
#include "controllers/gcode/interpreter.h"
#include "controllers/gcode/segment.h"
#include "plant/machine/machine.h"
#include "plant/machine/workpiece.h"

namespace feedtwin::tools {

/// Loop gains of an axis' cascade. Its feed-forward is the axis' own nominal mass and friction, as a commissioning sets it.
struct LoopGains {
  double position_per_s = 150.0;
  double velocity_Ns_per_m = 40000.0;
  double velocity_integral_N_per_m = 4.0e6;
  double current_loop_time_constant_s = 0.0;
};

struct MachineJob {
  std::string name;  ///< what the user called it, in messages and tables
  plant::MachineParameters machine;
  LoopGains x_loop, y_loop;
  controllers::gcode::AxisLimits limits;
  double tick_s = 1e-3;
  double blend_tolerance_m = 5e-6;
  std::string program_name, program_text;
  controllers::gcode::InterpreterSettings interpreter;
  plant::BlockParameters block;
  double feed_override = 1.0, spindle_override = 1.0;
  double removal_rate_mm3_per_s = 0.0;  ///< 0: as programmed; else feed and speed are scaled to it at constant chip load
};

/// The cascade of an axis with these gains.
[[nodiscard]] controllers::CascadeGains cascade_of(const LoopGains& loop, const plant::AxisParameters& axis);

/// The source's machine, its case A, as far as the source tells; every free choice is listed in reproduction.cpp.
[[nodiscard]] MachineJob source_machine();

}  // namespace feedtwin::tools
