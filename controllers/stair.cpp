#include "controllers/stair.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace feedtwin::controllers {
namespace {

/// Out and back at one constant speed after another, from the slowest to the fastest in equal ratios, each held for
/// `hold_s` or as long as the amplitude lets it; then from the start again. What a Stribeck curve and a loss curve are
/// measured by.
class Stair final : public Motion {
 public:
  explicit Stair(const MotionSettings& s) : centre_m_(s.centre_m), acceleration_(s.acceleration_m_per_s2) {
    const double fastest = std::min(s.speed_m_per_s, std::sqrt(s.amplitude_m * acceleration_));
    const double slowest = std::min(s.slowest_m_per_s > 0.0 ? s.slowest_m_per_s : 0.01 * fastest, fastest);
    const int steps = std::max(s.steps, 2);
    for (int i = 0; i < steps; ++i) {
      const double speed = slowest * std::pow(fastest / slowest, static_cast<double>(i) / (steps - 1));
      const double ramp_s = speed / acceleration_;
      const double hold_s = std::min(s.hold_s, (s.amplitude_m - speed * ramp_s) / speed);
      steps_.push_back({end_s_, speed, ramp_s, std::max(hold_s, 0.0)});
      end_s_ += 2.0 * steps_.back().way_s();
    }
  }

  [[nodiscard]] Reference at(double time_s) const noexcept override {
    if (time_s <= 0.0) return {centre_m_, 0.0, 0.0};
    const double t = std::fmod(time_s, end_s_);
    const auto after = std::ranges::upper_bound(steps_, t, {}, &Step::start_s);
    const Step& step = *(after - 1);
    const double since_s = t - step.start_s, way_s = step.way_s();
    const bool back = since_s > way_s;
    Reference r = step.at(std::min(back ? since_s - way_s : since_s, way_s), acceleration_);
    if (back) r = {step.way_m() - r.position_m, -r.velocity_m_per_s, -r.acceleration_m_per_s2};
    r.position_m += centre_m_;
    return r;
  }

 private:
  struct Step {
    double start_s, speed_m_per_s, ramp_s, hold_s;
    [[nodiscard]] double way_s() const noexcept { return 2.0 * ramp_s + hold_s; }
    [[nodiscard]] double way_m() const noexcept { return speed_m_per_s * (ramp_s + hold_s); }
    /// One way, from rest to rest.
    [[nodiscard]] Reference at(double t, double acceleration) const noexcept {
      if (t < ramp_s) return {0.5 * acceleration * t * t, acceleration * t, acceleration};
      if (t <= ramp_s + hold_s) return {speed_m_per_s * (t - 0.5 * ramp_s), speed_m_per_s, 0.0};
      const double left_s = way_s() - t;
      return {way_m() - 0.5 * acceleration * left_s * left_s, acceleration * left_s, -acceleration};
    }
  };
  double centre_m_, acceleration_;
  std::vector<Step> steps_;
  double end_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Motion> make_stair(const MotionSettings& settings) {
  return std::make_unique<Stair>(settings);
}

}  // namespace feedtwin::controllers
