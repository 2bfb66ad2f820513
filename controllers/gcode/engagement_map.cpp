#include "controllers/gcode/engagement_map.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers::gcode {
namespace {

/// Steps of the path: a twentieth of the radius on a line, and short enough on an arc that its chord is one with it.
constexpr double step_to_radius = 0.05;

}  // namespace

EngagementMap::EngagementMap(const Trajectory& trajectory, const plant::BlockParameters& block, double tool_radius_m) {
  plant::Workpiece workpiece(block, tool_radius_m);
  for (const Segment& segment : trajectory.segments()) {
    const double length_m = segment.length_m();
    const auto count = static_cast<std::size_t>(std::ceil(length_m / (step_to_radius * tool_radius_m)));
    const Stretch stretch{engagements_.size(), count, length_m / static_cast<double>(count)};
    Point from = segment.from_m();
    for (std::size_t i = 0; i < count; ++i) {
      const CurvePoint middle = segment.at((static_cast<double>(i) + 0.5) * stretch.step_m);
      const Point to = segment.at(static_cast<double>(i + 1) * stretch.step_m).at_m;
      const double planar = std::hypot(middle.first.x, middle.first.y);
      plant::Engagement engagement;
      if (planar > 1e-6) {  // a plunge has no feed direction in the plane, and cuts with its tip, which is not modelled
        engagement =
            workpiece.engagement(middle.at_m.x, middle.at_m.y, middle.at_m.z, std::atan2(middle.first.y, middle.first.x));
      }
      double section_m2 = 0.0;
      for (int k = 0; k < engagement.count; ++k) {
        const auto& immersion = engagement.immersions[static_cast<std::size_t>(k)];
        section_m2 += immersion.depth_m * tool_radius_m * (std::cos(immersion.entry_rad) - std::cos(immersion.exit_rad));
      }
      volume_m3_ += section_m2 * planar * stretch.step_m;
      if (engagement.cutting() && segment.feed_m_per_s > 0.0) cutting_time_s_ += stretch.step_m / segment.feed_m_per_s;
      engagements_.push_back(engagement);
      workpiece.clear(from.x, from.y, to.x, to.y, std::max(from.z, to.z));
      from = to;
    }
    stretches_.push_back(stretch);
  }
}

const plant::Engagement& EngagementMap::at(std::size_t segment, double along_m) const noexcept FEEDTWIN_REALTIME {
  if (segment >= stretches_.size() || stretches_[segment].count == 0) return none_;
  const Stretch& stretch = stretches_[segment];
  const double step = std::clamp(along_m / stretch.step_m, 0.0, static_cast<double>(stretch.count - 1));
  return engagements_[stretch.first + static_cast<std::size_t>(step)];
}

}  // namespace feedtwin::controllers::gcode
