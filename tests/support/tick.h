#pragma once

namespace feedtwin::test {

inline constexpr double tick_s = 1e-3;              ///< the loop's period
inline constexpr double count_m = 0.005 / 65536.0;  ///< the source's axis: one count of its encoder

}  // namespace feedtwin::test
