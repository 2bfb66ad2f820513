#pragma once
// The interpreter: the text of a program in, canonical commands out. Pure: no file, no clock, nothing kept between calls.
//
// RS-274 as in NISTIR 6556 and LinuxCNC's documentation, of it: G0-G3 (centre or radius, P turns), G4, G17-G19, G20, G21,
// G28, G40, G53, G54-G59.3, G61, G61.1, G64, G80, G90, G91, G93-G95, F, S, T, M0-M9, M30, N, comments, block delete,
// parameters and expressions. Everything else is an error with its line and column, and so is a program without an end.

#include <string_view>

#include "controllers/gcode/canonical.h"
#include "controllers/gcode/gcode_error.h"
#include "controllers/gcode/parameters.h"

namespace feedtwin::controllers::gcode {

struct InterpreterSettings {
  Parameters parameters;      ///< workpiece offsets (#5221 ...) and home (#5161 ...) in mm
  bool block_delete = false;  ///< skip lines that start with '/'
  Point start_m;              ///< where the machine is, machine coordinates
};

/// Throws GcodeError at the first line that is wrong. Time and memory are linear in the length of the text.
[[nodiscard]] Program interpret(std::string_view text, const InterpreterSettings& settings = {});

}  // namespace feedtwin::controllers::gcode
