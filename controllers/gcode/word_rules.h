#pragma once
// Which words may stand on one line: I, J, K, R, P, Q by what they belong to, axis words by a motion.

#include "controllers/gcode/line_codes.h"

namespace feedtwin::controllers::gcode {

inline constexpr int no_motion = 80;  ///< G80

[[nodiscard]] inline bool is(const std::optional<Code>& code, int tenths) {
  return code && code->tenths == tenths;
}
[[nodiscard]] inline bool has_axis(const Block& block) {
  return block.word('x') || block.word('y') || block.word('z');
}

/// Throws GcodeError. @param motion_in_force 0 to 3, or no_motion: where the line names none
void check_words(const Block& block, const Codes& codes, int motion_in_force);

}  // namespace feedtwin::controllers::gcode
