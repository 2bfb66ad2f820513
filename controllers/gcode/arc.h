#pragma once
// The circle of a G2 or G3 in its plane, from its centre or its radius.

#include <optional>
#include <string>

namespace feedtwin::controllers::gcode {

/// In the plane's own axes: first and second are x y (G17), z x (G18), y z (G19), so that positive is counter-clockwise.
struct PlanarPoint {
  double first = 0.0, second = 0.0;
};

struct PlanarArc {
  PlanarPoint centre;
  double sweep_rad = 0.0;  ///< positive counter-clockwise, whole turns included
};

/// How far an arc may be off, as in LinuxCNC's documentation of G2 and G3.
struct ArcTolerance {
  double radius_m;         ///< least radius, and what an R may lack to reach the end
  double spiral_m;         ///< difference of the radii at the start and at the end
  double spiral_relative;  ///< the same to the radius; a hundred times spiral_m is refused in any case
};
inline constexpr ArcTolerance metric_arc_tolerance{1.27e-6, 2.828427e-5, 1e-3};
inline constexpr ArcTolerance inch_arc_tolerance{1.27e-6, 7.184205e-5, 1e-3};

struct ArcResult {
  PlanarArc arc;
  std::string problem;  ///< empty: the arc is sound
};

/// I, J, K: centre as an offset from the start. The same start and end make whole circles.
[[nodiscard]] ArcResult arc_from_centre(PlanarPoint from, PlanarPoint to, PlanarPoint offset, bool clockwise, int turns,
                                        const ArcTolerance& tolerance);

/// R: the shorter way round for a positive radius, the longer for a negative one.
[[nodiscard]] ArcResult arc_from_radius(PlanarPoint from, PlanarPoint to, double radius_m, bool clockwise, int turns,
                                        const ArcTolerance& tolerance);

}  // namespace feedtwin::controllers::gcode
