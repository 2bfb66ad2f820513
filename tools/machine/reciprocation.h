#pragma once
// Table 4: energy of one axis in reciprocal motion. The source gives neither speed nor duration; those that come closest to
// its estimates are looked for.

#include <array>
#include <string_view>

namespace feedtwin::tools {

struct Reciprocation {
  double speed_m_per_s = 0.0, duration_s = 0.0;
  std::array<double, 4> energy_J{};  ///< motor electrical, motor mechanical, ball screw, guide
};

/// @param motion "triangle" or "sine" (controllers/motion.h); @param wanted_J the source's four rows
[[nodiscard]] Reciprocation closest_reciprocation(std::string_view motion, const std::array<double, 4>& wanted_J);

}  // namespace feedtwin::tools
