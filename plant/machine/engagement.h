#pragma once
// Where around its circumference a cutter meets material.
//
// Angles as in Altintas, Manufacturing Automation (2nd ed. 2012), section 2.7.1: the immersion angle phi of a tooth grows
// with clockwise rotation, 0 to the left of the feed direction, pi / 2 straight ahead, pi to the right. Only the leading
// half, 0..pi, can cut while the tool moves ahead.

#include <array>

namespace feedtwin::plant {

struct Immersion {
  double entry_rad = 0.0, exit_rad = 0.0;  ///< within 0..pi, entry < exit, for a cutter that turns clockwise
  double depth_m = 0.0;                    ///< axial depth of cut
};

struct Engagement {
  static constexpr int most = 4;
  std::array<Immersion, most> immersions;
  int count = 0;
  double heading_rad = 0.0;  ///< direction of the feed in the xy plane, from +x towards +y

  [[nodiscard]] bool cutting() const noexcept { return count > 0; }
};

/// Full immersion: a slot as wide as the cutter.
[[nodiscard]] constexpr Engagement slot(double depth_m, double heading_rad = 0.0) noexcept {
  Engagement e;
  e.immersions[0] = {0.0, 3.141592653589793, depth_m};
  e.count = 1;
  e.heading_rad = heading_rad;
  return e;
}

}  // namespace feedtwin::plant
