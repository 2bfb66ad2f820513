#include "tools/diagnose/taken_up.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools::diagnosis {

double slow_acceleration_m_per_s2(const Track& track, Index sample) {
  constexpr double over_s = 0.012;
  const Index half = std::max<Index>(1, std::lround(over_s / track.sample_s)) / 2;
  const Index a = std::clamp<Index>(sample - half, 0, track.size - 1),
              b = std::clamp<Index>(sample + half, 0, track.size - 1);
  return b > a ? (track.centred_m_per_s[b] - track.centred_m_per_s[a]) / (static_cast<double>(b - a) * track.sample_s) : 0.0;
}

Eigen::MatrixXd columns_of_numbers(std::span<const double> acceleration_m_per_s2, std::span<const double> velocity_m_per_s) {
  constexpr double slow_m_per_s = 2e-3;
  Eigen::MatrixXd rows(static_cast<Index>(velocity_m_per_s.size()), 7);
  for (std::size_t k = 0; k < velocity_m_per_s.size(); ++k) {
    const double v = velocity_m_per_s[k], forth = v > 0.0 ? 1.0 : 0.0, back = 1.0 - forth;
    const double slow = std::exp(-std::abs(v) / slow_m_per_s);
    rows.row(static_cast<Index>(k)) << acceleration_m_per_s2[k], forth * v, back * v, forth, back, forth * slow, back * slow;
  }
  return rows;
}

}  // namespace feedtwin::tools::diagnosis
