#include "controllers/gcode/contour_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::controllers::gcode {

double planar_distance_m(const Segment& segment, double x_m, double y_m) noexcept FEEDTWIN_REALTIME {
  const Point &a = segment.from_m(), &b = segment.to_m();
  if (segment.is_arc() && segment.axis() == 2) {
    const double x = x_m - segment.centre_m().x, y = y_m - segment.centre_m().y;
    const double sweep = segment.sweep_rad();
    double angle = (sweep > 0.0 ? 1.0 : -1.0) * (std::atan2(y, x) - segment.start_angle_rad());
    angle -= 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi));  // how far round, 0 .. 2 pi
    if (angle <= std::abs(sweep)) {
      const Point on = segment.at(angle / std::abs(sweep) * segment.length_m()).at_m;
      return std::hypot(x_m - on.x, y_m - on.y);
    }
    return std::min(std::hypot(x_m - a.x, y_m - a.y), std::hypot(x_m - b.x, y_m - b.y));
  }
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0.0 ? std::clamp(((x_m - a.x) * dx + (y_m - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x_m - a.x - t * dx, y_m - a.y - t * dy);
}

double contour_error_m(const std::vector<Segment>& segments, std::size_t current, double x_m,
                       double y_m) noexcept FEEDTWIN_REALTIME {
  if (current >= segments.size()) return 0.0;
  double nearest = planar_distance_m(segments[current], x_m, y_m);
  if (current > 0) nearest = std::min(nearest, planar_distance_m(segments[current - 1], x_m, y_m));
  if (current + 1 < segments.size()) nearest = std::min(nearest, planar_distance_m(segments[current + 1], x_m, y_m));
  return nearest;
}

}  // namespace feedtwin::controllers::gcode
