#include "tools/identify/sliding.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools {
namespace {

constexpr double presliding_m = 5e-5, smeared_s = 0.03;
constexpr double half_base_s = 0.005;  // of a velocity from positions
constexpr std::size_t shortest = 50;   // rows

}  // namespace

std::vector<bool> rows_of_sliding(std::span<const double> velocity_m_per_s, double sample_s) {
  std::vector<bool> slides(velocity_m_per_s.size());
  double travelled_m = 1.0, elapsed_s = 1.0, direction = 0.0;  // before the first row it may have moved for long
  for (std::size_t k = 0; k < slides.size(); ++k) {
    const double v = velocity_m_per_s[k];
    const double now = std::abs(v) < standstill_m_per_s ? 0.0 : (v > 0.0 ? 1.0 : -1.0);
    if (now == 0.0 || now != direction) travelled_m = elapsed_s = 0.0;
    direction = now;
    travelled_m += std::abs(v) * sample_s;
    elapsed_s += sample_s;
    slides[k] = travelled_m > presliding_m && elapsed_s > smeared_s;
  }
  return slides;
}

std::vector<bool> rows_of_surely_sliding(std::span<const double> position_m, double sample_s) {
  const std::size_t rows = position_m.size();
  const auto half = static_cast<std::size_t>(std::max(1L, std::lround(half_base_s / sample_s)));
  std::vector<double> velocity(rows, 0.0);
  for (std::size_t k = 0; k < rows; ++k) {
    const std::size_t from = k - std::min(k, half), to = std::min(k + half, rows - 1);
    velocity[k] =
        (position_m[to] - position_m[from]) / (static_cast<double>(std::max<std::size_t>(to - from, 1)) * sample_s);
  }
  const auto slides = rows_of_sliding(velocity, sample_s);
  std::vector<bool> surely = slides;
  for (std::size_t k = 0; k < rows; ++k) surely[k] = slides[k] && slides[std::min(k + 2 * half, rows - 1)];
  return surely;
}

std::vector<Stretch> stretches_of(const std::vector<bool>& rows) {
  std::vector<Stretch> found;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && rows[end]) ++end;
    if (end - first >= shortest) found.push_back({first, end});
    first = end + 1;
  }
  return found;
}

}  // namespace feedtwin::tools
