#pragma once
// A rectangular block and what a flat-end mill has cleared of it: where the tool meets material, in closed geometry.
//
// The cleared region is a union of capsules, each the tool's disc swept along a straight piece of path at one height (an arc
// is several pieces). A point of the tool's circumference meets material where it is in the block and in no capsule that is
// as deep; its axial depth is what stands there above the tool's tip.

#include <cstddef>
#include <vector>

#include "plant/machine/engagement.h"

namespace feedtwin::plant {

struct BlockParameters {
  double x_low_m = 0.0, x_high_m = 0.0, y_low_m = 0.0, y_high_m = 0.0;
  double top_m = 0.0;
};

class Workpiece {
 public:
  Workpiece(const BlockParameters& block, double tool_radius_m);

  /// The tool has moved straight from one point to another with its tip at `tip_m`. A piece that goes on in the same
  /// direction extends the last one.
  void clear(double from_x_m, double from_y_m, double to_x_m, double to_y_m, double tip_m);

  /// Engagement of a tool at this place that moves towards `heading_rad`. Immersions beyond Engagement::most, which only
  /// scraps of material make, are merged into their neighbour.
  [[nodiscard]] Engagement engagement(double x_m, double y_m, double tip_m, double heading_rad);

 private:
  struct Capsule {
    double from_x_m, from_y_m, to_x_m, to_y_m, tip_m;
  };
  [[nodiscard]] double height_above_m(double x_m, double y_m, double tip_m) const noexcept;

  BlockParameters block_;
  double radius_m_;
  std::vector<Capsule> capsules_;
  std::vector<std::size_t> near_;  // capsules within reach of the tool, for the query at hand
};

}  // namespace feedtwin::plant
