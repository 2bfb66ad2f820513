#pragma once
// Reference motions of a challenge case, in the kinds that recordings have.

#include <random>
#include <string>
#include <vector>

namespace feedtwin::challenge {

struct MotionPlan {
  std::string kind;  ///< stair, sine, multi, tri, dwell
  double duration_s = 8.0;
  double amplitude_m = 0.02, speed_m_per_s = 0.09;
  std::vector<double> frequency_Hz, share_m, phase_rad;  ///< multi
};

/// A plan of this kind with numbers of its own.
[[nodiscard]] MotionPlan draw_motion(const std::string& kind, std::mt19937_64& random);
[[nodiscard]] double reference_m(const MotionPlan& plan, double time_s);

}  // namespace feedtwin::challenge
