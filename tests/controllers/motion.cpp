#include "controllers/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace feedtwin::controllers {
namespace {

double logarithmic(std::mt19937_64& random, double low, double high) {
  return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
}

MotionSettings draw(std::mt19937_64& random) {
  return {.centre_m = std::uniform_real_distribution<double>(-0.05, 0.05)(random),
          .amplitude_m = logarithmic(random, 1e-5, 0.07),
          .speed_m_per_s = logarithmic(random, 1e-4, 1.0),
          .acceleration_m_per_s2 = logarithmic(random, 0.05, 20.0),
          .jerk_m_per_s3 = logarithmic(random, 1.0, 2000.0),
          .dwell_s = std::uniform_real_distribution<double>(0.0, 0.5)(random),
          .slowest_m_per_s = logarithmic(random, 1e-4, 1.0),
          .steps = std::uniform_int_distribution<int>(2, 12)(random),
          .hold_s = std::uniform_real_distribution<double>(0.0, 0.5)(random)};
}

std::string text(const MotionKind& kind, const MotionSettings& s) {
  return std::string(kind.name) + " centre " + std::to_string(s.centre_m) + " amplitude " + std::to_string(s.amplitude_m) +
         " speed " + std::to_string(s.speed_m_per_s) + " acceleration " + std::to_string(s.acceleration_m_per_s2) +
         " jerk " + std::to_string(s.jerk_m_per_s3) + " dwell " + std::to_string(s.dwell_s);
}

/// What `at` gives must hang together: velocity is the slope of position and acceleration bounds that of velocity.
TEST(Motion, ContinuousAndWithinItsLimits) {
  std::mt19937_64 random(51);
  for (int round = 0; round < 300; ++round) {
    for (const auto& kind : motion_kinds()) {
      if (kind.of_recording) continue;  // what was recorded has limits of its own
      const MotionSettings s = draw(random);
      const auto motion = kind.make(s);
      SCOPED_TRACE(text(kind, s));
      const Reference start = motion->at(0.0);
      ASSERT_NEAR(start.position_m, s.centre_m, 1e-12);
      ASSERT_NEAR(start.velocity_m_per_s, 0.0, 1e-12) << "starts at rest";
      // the sine's ramp-in overshoots its speed a little: e' sin + e w cos
      const bool sine = kind.name == "sine";
      const double fastest = s.speed_m_per_s * (sine ? 1.5 : 1.0 + 1e-9);
      const double hardest = sine ? 4.0 * s.speed_m_per_s * s.speed_m_per_s / s.amplitude_m : s.acceleration_m_per_s2;
      const double period_s =
          4.0 * s.amplitude_m / s.speed_m_per_s + 4.0 * s.speed_m_per_s / s.acceleration_m_per_s2 + 2.0 * s.dwell_s;
      const double dt = period_s / 3000.0;
      Reference last = start;
      for (int i = 1; i < 9000; ++i) {
        const Reference r = motion->at(i * dt);
        ASSERT_LE(std::abs(r.position_m - s.centre_m), s.amplitude_m * (1.0 + 1e-9)) << "t " << i * dt;
        ASSERT_LE(std::abs(r.velocity_m_per_s), fastest) << "t " << i * dt;
        ASSERT_LE(std::abs(r.acceleration_m_per_s2), hardest * (1.0 + 1e-9)) << "t " << i * dt;
        const double mean = 0.5 * (r.velocity_m_per_s + last.velocity_m_per_s);
        ASSERT_NEAR(r.position_m - last.position_m, mean * dt, 0.51 * hardest * dt * dt + 1e-13) << "t " << i * dt;
        ASSERT_LE(std::abs(r.velocity_m_per_s - last.velocity_m_per_s), hardest * dt * (1.0 + 1e-6) + 1e-13)
            << "t " << i * dt;
        last = r;
      }
    }
  }
}

TEST(Motion, SCurveKeepsItsJerk) {
  std::mt19937_64 random(52);
  const auto kind = std::ranges::find(motion_kinds(), "s_curve", &MotionKind::name);
  ASSERT_NE(kind, motion_kinds().end());
  for (int round = 0; round < 300; ++round) {
    const MotionSettings s = draw(random);
    const auto motion = kind->make(s);
    const double dt = 1e-4;
    Reference last = motion->at(0.0);
    for (int i = 1; i < 20000; ++i) {
      const Reference r = motion->at(i * dt);
      ASSERT_LE(std::abs(r.acceleration_m_per_s2 - last.acceleration_m_per_s2), s.jerk_m_per_s3 * dt * (1.0 + 1e-6) + 1e-9)
          << text(*kind, s) << " t " << i * dt;
      last = r;
    }
  }
}

}  // namespace
}  // namespace feedtwin::controllers
