#pragma once
// The lowest point of a function of one variable over a range: a grid finds the valley, parabolas within golden sections its
// ground (Brent 1973, shortened: the valley's bracket only ever shrinks).

#include <cmath>
#include <vector>

namespace feedtwin::tools {

/// @param grid points of the first look, at least 3; further evaluations: at most 40, fewer for a smooth valley
template <class Function>
[[nodiscard]] double lowest_point(const Function& cost, double low, double high, int grid, double tolerance = 1e-7) {
  const double step = (high - low) / (grid - 1);
  int best = 0;
  double best_cost = cost(low);
  for (int i = 1; i < grid; ++i) {
    const double here = cost(low + i * step);
    if (here < best_cost) best = i, best_cost = here;
  }
  double x = low + best * step, a = best > 0 ? x - step : x, b = best + 1 < grid ? x + step : x;
  double w = a, v = b, cost_w = cost(a), cost_v = cost(b), last = b - a, before_last = b - a;
  for (int i = 0; i < 40 && b - a > tolerance; ++i) {
    // the parabola through the three best so far
    const double r = (x - w) * (best_cost - cost_v), q = (x - v) * (best_cost - cost_w);
    const double top = (x - v) * q - (x - w) * r, bottom = 2.0 * (q - r);
    double move = bottom != 0.0 ? -top / bottom : 0.0;
    const bool golden = bottom == 0.0 || !std::isfinite(move) || x + move <= a || x + move >= b ||
                        std::abs(move) > 0.5 * std::abs(before_last);
    if (golden) move = 0.381966 * ((x < 0.5 * (a + b) ? b : a) - x);
    if (std::abs(move) < tolerance) {
      if (!golden) break;
      move = std::copysign(tolerance, move);
    }
    before_last = golden ? (x < 0.5 * (a + b) ? b : a) - x : last;
    last = move;
    const double u = x + move, cost_u = cost(u);
    if (cost_u <= best_cost) {
      (u < x ? b : a) = x;
      v = w, cost_v = cost_w, w = x, cost_w = best_cost, x = u, best_cost = cost_u;
    } else {
      (u < x ? a : b) = u;
      if (cost_u <= cost_w || w == x) {
        v = w, cost_v = cost_w, w = u, cost_w = cost_u;
      } else if (cost_u <= cost_v || v == x || v == w) {
        v = u, cost_v = cost_u;
      }
    }
  }
  return x;
}

}  // namespace feedtwin::tools
