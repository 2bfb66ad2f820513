#pragma once
// Distance of the tool from the programmed path in the xy plane.

#include <cstddef>
#include <vector>

#include "controllers/gcode/segment.h"
#include "plant/realtime.h"

namespace feedtwin::controllers::gcode {

/// From one move; an arc out of the xy plane counts as the straight line between its ends. Wait-free.
[[nodiscard]] double planar_distance_m(const Segment& segment, double x_m, double y_m) noexcept FEEDTWIN_REALTIME;

/// From the move the program is at and its two neighbours, whichever is nearest: behind a corner the tool lags on the move
/// before. Wait-free.
[[nodiscard]] double contour_error_m(const std::vector<Segment>& segments, std::size_t current, double x_m,
                                     double y_m) noexcept FEEDTWIN_REALTIME;

}  // namespace feedtwin::controllers::gcode
