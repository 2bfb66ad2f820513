#pragma once
// The motion of a recording, as a list of points at equal times: made outside, followed here.

#include <vector>

#include "controllers/motion.h"

namespace feedtwin::controllers {

/// Where an axis was or should be, from time 0 on; at rest at the last point afterwards.
struct RecordedPath {
  double step_s = 1e-3;
  std::vector<Reference> points;
};

/// Between two points on the line; without a path at rest at the centre.
[[nodiscard]] std::unique_ptr<Motion> make_recorded(const MotionSettings& settings);

}  // namespace feedtwin::controllers
