#include "controllers/gcode/arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::controllers::gcode {
namespace {

constexpr double full_turn_rad = 2.0 * std::numbers::pi;

/// From the start's angle to the end's, the way round that is asked for; equal angles make a whole turn.
double sweep_rad(PlanarPoint from, PlanarPoint to, PlanarPoint centre, bool clockwise, int turns) {
  const double start = std::atan2(from.second - centre.second, from.first - centre.first);
  const double end = std::atan2(to.second - centre.second, to.first - centre.first);
  double sweep = clockwise ? start - end : end - start;
  if (sweep <= 0.0) sweep += full_turn_rad;
  sweep += full_turn_rad * (turns - 1);
  return clockwise ? -sweep : sweep;
}

}  // namespace

ArcResult arc_from_centre(PlanarPoint from, PlanarPoint to, PlanarPoint offset, bool clockwise, int turns,
                          const ArcTolerance& tolerance) {
  const PlanarPoint centre{from.first + offset.first, from.second + offset.second};
  const double radius = std::hypot(offset.first, offset.second);
  const double end_radius = std::hypot(to.first - centre.first, to.second - centre.second);
  if (radius < tolerance.radius_m || end_radius < tolerance.radius_m) return {{}, "the arc's radius is zero"};
  const double difference = std::abs(radius - end_radius);
  const bool spiral =
      difference > tolerance.spiral_m && difference > tolerance.spiral_relative * std::max(radius, end_radius);
  if (spiral || difference > 100.0 * tolerance.spiral_m) {
    return {{}, "the arc's radius at the start and at the end differ by " + std::to_string(difference * 1e3) + " mm"};
  }
  return {{centre, sweep_rad(from, to, centre, clockwise, turns)}, ""};
}

ArcResult arc_from_radius(PlanarPoint from, PlanarPoint to, double radius_m, bool clockwise, int turns,
                          const ArcTolerance& tolerance) {
  const PlanarPoint chord{to.first - from.first, to.second - from.second};
  const double half = 0.5 * std::hypot(chord.first, chord.second);
  double radius = std::abs(radius_m);
  if (half == 0.0) return {{}, "an arc with R ends where it starts; a whole circle needs I, J or K"};
  if (half - radius > tolerance.radius_m) {
    return {{}, "the arc's radius is too small to reach the end, which is " + std::to_string(2e3 * half) + " mm away"};
  }
  radius = std::max(radius, half);
  // the centre is on the chord's perpendicular bisector; its side follows from the turn and the sign of R
  const double height = std::sqrt(radius * radius - half * half);
  const double side = (clockwise ? -1.0 : 1.0) * (radius_m < 0.0 ? -1.0 : 1.0);
  const double along = side * height / (2.0 * half);
  const PlanarPoint centre{0.5 * (from.first + to.first) - along * chord.second,
                           0.5 * (from.second + to.second) + along * chord.first};
  return {{centre, sweep_rad(from, to, centre, clockwise, turns)}, ""};
}

}  // namespace feedtwin::controllers::gcode
