#include "plant/machine/workpiece.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedtwin::plant {
namespace {

constexpr int probes = 64;             // around the leading half
constexpr int bisections = 12;         // of a boundary between two probes: to 1e-5 rad
constexpr double touching_m = 1e-9;    // a circumference along a wall is not in the material
constexpr double same_depth_m = 1e-7;  // heights closer than this are one

double distance_squared(double x, double y, double from_x, double from_y, double to_x, double to_y) noexcept {
  const double dx = to_x - from_x, dy = to_y - from_y;
  const double along = dx * dx + dy * dy;
  const double t = along > 0.0 ? std::clamp(((x - from_x) * dx + (y - from_y) * dy) / along, 0.0, 1.0) : 0.0;
  const double ex = x - from_x - t * dx, ey = y - from_y - t * dy;
  return ex * ex + ey * ey;
}

}  // namespace

Workpiece::Workpiece(const BlockParameters& block, double tool_radius_m) : block_(block), radius_m_(tool_radius_m) {}

void Workpiece::clear(double from_x_m, double from_y_m, double to_x_m, double to_y_m, double tip_m) {
  if (tip_m >= block_.top_m) return;
  if (!capsules_.empty()) {
    Capsule& last = capsules_.back();
    const bool follows = last.to_x_m == from_x_m && last.to_y_m == from_y_m && last.tip_m == tip_m;
    const double ax = last.to_x_m - last.from_x_m, ay = last.to_y_m - last.from_y_m;
    const double bx = to_x_m - from_x_m, by = to_y_m - from_y_m;
    const double scale = std::hypot(ax, ay) * std::hypot(bx, by);
    if (follows && ax * bx + ay * by >= 0.0 && std::abs(ax * by - ay * bx) <= 1e-9 * scale) {
      last.to_x_m = to_x_m;
      last.to_y_m = to_y_m;
      return;
    }
  }
  capsules_.push_back({from_x_m, from_y_m, to_x_m, to_y_m, tip_m});
}

double Workpiece::height_above_m(double x_m, double y_m, double tip_m) const noexcept {
  const bool in_block = x_m > block_.x_low_m + touching_m && x_m < block_.x_high_m - touching_m &&
                        y_m > block_.y_low_m + touching_m && y_m < block_.y_high_m - touching_m;
  if (!in_block) return 0.0;
  double height = block_.top_m - tip_m;
  const double inside = (radius_m_ - touching_m) * (radius_m_ - touching_m);
  for (const std::size_t i : near_) {
    const Capsule& c = capsules_[i];
    if (c.tip_m - tip_m >= height) continue;
    if (distance_squared(x_m, y_m, c.from_x_m, c.from_y_m, c.to_x_m, c.to_y_m) < inside) height = c.tip_m - tip_m;
  }
  return std::max(0.0, height);
}

Engagement Workpiece::engagement(double x_m, double y_m, double tip_m, double heading_rad) {
  Engagement result;
  result.heading_rad = heading_rad;
  if (tip_m >= block_.top_m) return result;
  near_.clear();
  const double reach = 4.0 * radius_m_ * radius_m_;
  for (std::size_t i = 0; i < capsules_.size(); ++i) {
    const Capsule& c = capsules_[i];
    if (distance_squared(x_m, y_m, c.from_x_m, c.from_y_m, c.to_x_m, c.to_y_m) < reach) near_.push_back(i);
  }
  const auto depth = [&](double phi) {  // phi = pi / 2 straight ahead, 0 to the left
    const double angle = heading_rad + 0.5 * std::numbers::pi - phi;
    return height_above_m(x_m + radius_m_ * std::cos(angle), y_m + radius_m_ * std::sin(angle), tip_m);
  };
  const auto boundary = [&](double low, double high, double low_depth) {
    for (int i = 0; i < bisections; ++i) {
      const double middle = 0.5 * (low + high);
      (std::abs(depth(middle) - low_depth) < same_depth_m ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  const double step = std::numbers::pi / probes;
  double start = 0.0, here = depth(0.5 * step);
  const auto close = [&](double end) {
    if (here > same_depth_m) {
      if (result.count < Engagement::most) {
        result.immersions[static_cast<std::size_t>(result.count++)] = {start, end, here};
      } else {
        result.immersions[Engagement::most - 1].exit_rad = end;
      }
    }
    start = end;
  };
  for (int i = 1; i < probes; ++i) {
    const double phi = (i + 0.5) * step;
    const double next = depth(phi);
    if (std::abs(next - here) >= same_depth_m) {
      close(boundary(phi - step, phi, here));
      here = next;
    }
  }
  close(std::numbers::pi);
  return result;
}

}  // namespace feedtwin::plant
