#include "tools/diagnose/samples_later.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedtwin::tools::diagnosis {

Vector samples_later(std::span<const double> reading, double samples) {
  const auto last = static_cast<Index>(reading.size()) - 1;
  Vector out(last + 1);
  const auto whole = static_cast<Index>(std::floor(samples));
  const double t = samples - static_cast<double>(whole);
  const std::array<double, 4> weights{-t * (t - 1.0) * (t - 2.0) / 6.0, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
                                      -(t + 1.0) * t * (t - 2.0) / 2.0, (t + 1.0) * t * (t - 1.0) / 6.0};
  for (Index k = 0; k <= last; ++k) {
    out[k] = 0.0;
    for (Index j = 0; j < 4; ++j)
      out[k] += weights[static_cast<std::size_t>(j)] *
                reading[static_cast<std::size_t>(std::clamp<Index>(k + whole + j - 1, 0, last))];
  }
  return out;
}

}  // namespace feedtwin::tools::diagnosis
