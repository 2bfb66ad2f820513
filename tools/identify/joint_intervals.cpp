#include "tools/identify/joint_intervals.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace feedtwin::tools {
namespace {

/// Half-width of a normal's interval that it misses with this probability: it falls, so halving finds it.
double normal_half_width(double missed) {
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::numbers::sqrt2) > missed ? low : high) = middle;
  }
  return low;
}

}  // namespace

double joint_90(std::size_t count, double degrees_of_freedom) {
  const double x = normal_half_width(-std::expm1(std::log(0.9) / static_cast<double>(count))), x2 = x * x;
  const double per = 1.0 / degrees_of_freedom;
  const double g1 = x * (x2 + 1.0) / 4.0;
  const double g2 = x * ((5.0 * x2 + 16.0) * x2 + 3.0) / 96.0;
  const double g3 = x * (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) / 384.0;
  const double g4 = x * ((((79.0 * x2 + 776.0) * x2 + 1482.0) * x2 - 1920.0) * x2 - 945.0) / 92160.0;
  return x + per * (g1 + per * (g2 + per * (g3 + per * g4)));
}

double degrees_of_freedom(double variance, double part, int draws) {
  if (part <= 0.0) return std::numeric_limits<double>::infinity();
  return draws * (variance / part) * (variance / part);
}

}  // namespace feedtwin::tools
