#pragma once
// Canonical machining commands: what a program asks of the machine once modes, units and offsets are resolved. The set and
// the names follow the NIST RS274/NGC interpreter (NISTIR 6556, section 4); everything is in machine coordinates and SI.

#include <cstddef>
#include <variant>
#include <vector>

#include "controllers/gcode/point.h"

namespace feedtwin::controllers::gcode {

/// Rapid straight move.
struct StraightTraverse {
  Point to_m;
};

/// Straight move at a feed rate.
struct StraightFeed {
  Point to_m;
  double feed_m_per_s = 0.0;  ///< along the path
};

/// Circular or helical move about an axis parallel to x, y or z.
struct ArcFeed {
  Point to_m;
  Point centre_m;          ///< its component along the arc's axis is without meaning
  int axis = 2;            ///< 0, 1, 2: normal of the plane (G19, G18, G17)
  double sweep_rad = 0.0;  ///< right-handed about the axis; beyond 2 pi with P turns
  double feed_m_per_s = 0.0;
};

struct Dwell {
  double duration_s = 0.0;
};

enum class SpindleTurn { off, clockwise, counterclockwise };

/// Spindle direction and speed; sent whenever either changes.
struct SetSpindle {
  SpindleTurn turn = SpindleTurn::off;
  double speed_rad_per_s = 0.0;  ///< as programmed by S, also while off
};

/// Lubricant pump: M7 mist, M8 flood.
struct SetCoolant {
  bool mist = false, flood = false;
};

struct SelectTool {
  int tool = 0;
};
struct ChangeTool {
  int tool = 0;
};

enum class PathMode { exact_path, exact_stop, continuous };

/// G61, G61.1, G64.
struct SetPathMode {
  PathMode mode = PathMode::continuous;
  double tolerance_m = 0.0;  ///< G64 P; 0: none given
};

/// M0, M1.
struct ProgramStop {
  bool optional = false;
};
/// M2, M30 or the closing %.
struct ProgramEnd {};

using Action = std::variant<StraightTraverse, StraightFeed, ArcFeed, Dwell, SetSpindle, SetCoolant, SelectTool, ChangeTool,
                            SetPathMode, ProgramStop, ProgramEnd>;

struct Command {
  std::size_t line = 0;  ///< of the program, from 1
  Action action;
};

using Program = std::vector<Command>;

}  // namespace feedtwin::controllers::gcode
