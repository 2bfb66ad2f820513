#pragma once
// The feed in force: G93 (moves a minute), G94 (length a minute), G95 (length a revolution), and F.

#include "controllers/gcode/line_codes.h"

namespace feedtwin::controllers::gcode {

class Feed {
 public:
  /// What a line says of it. Throws GcodeError. @param unit_m the length unit in force
  void read(const Block& block, const Codes& codes, double unit_m);
  /// Of a move of this length. Throws GcodeError where there is none. @param spindle_rad_per_s as commanded
  [[nodiscard]] double m_per_s(const Block& block, double length_m, double spindle_rad_per_s) const;

 private:
  enum class Mode { per_minute, inverse_time, per_revolution };
  Mode mode_ = Mode::per_minute;
  double value_ = 0.0;  // m/min, m/rev or moves a minute
};

}  // namespace feedtwin::controllers::gcode
