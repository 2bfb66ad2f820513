#include "controllers/recorded.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers {
namespace {

double between(double a, double b, double share) noexcept {
  return a + share * (b - a);
}

class Recorded final : public Motion {
 public:
  explicit Recorded(const MotionSettings& s) : path_(s.path), centre_m_(s.centre_m) {}

  [[nodiscard]] Reference at(double time_s) const noexcept override {
    if (!path_ || path_->points.empty()) return {.position_m = centre_m_};
    const auto& points = path_->points;
    const double place = std::max(0.0, time_s / path_->step_s);
    const double whole = std::floor(place + 1e-9);
    if (whole >= static_cast<double>(points.size() - 1)) return {.position_m = points.back().position_m};
    const auto& before = points[static_cast<std::size_t>(whole)];
    const auto& after = points[static_cast<std::size_t>(whole) + 1];
    const double share = std::max(0.0, place - whole);
    return {between(before.position_m, after.position_m, share),
            between(before.velocity_m_per_s, after.velocity_m_per_s, share),
            between(before.acceleration_m_per_s2, after.acceleration_m_per_s2, share),
            between(before.force_N, after.force_N, share)};
  }

 private:
  std::shared_ptr<const RecordedPath> path_;
  double centre_m_;
};

}  // namespace

std::unique_ptr<Motion> make_recorded(const MotionSettings& settings) {
  return std::make_unique<Recorded>(settings);
}

}  // namespace feedtwin::controllers
