#pragma once

namespace feedtwin::tools {

inline constexpr double normal_90 = 1.6448536269514722;  ///< half-width of a 90 % interval in deviations

}  // namespace feedtwin::tools
