#include "tools/identify/stages/inverse_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace feedtwin::tools {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Point = InverseProjection::Point;

constexpr int most_passes = 60;
constexpr double longest_step = 2.0;  // of each of the three logarithms

/// Half of the fall that a step promises.
double promise(const Matrix3d& b, const Point& here, const Vector3d& step) {
  return -step.dot(here.gradient + 0.5 * b * step);
}

/// The step of the greatest promise within reach. Each unknown goes free, or as far down or up as it may: of the 27 ways the
/// best is it. None held and within reach ends the search, and mostly it does.
Vector3d bounded_step(const Matrix3d& b, const Point& here, const ShapeBounds& bounds, double reach) {
  enum Held : int { free, down, up, ways };
  const Vector3d least = (bounds.lowest - here.at).cwiseMax(-reach * longest_step);
  const Vector3d most = (bounds.highest - here.at).cwiseMin(reach * longest_step);
  Vector3d best = Vector3d::Zero();
  for (int way = 0; way < ways * ways * ways; ++way) {
    const std::array held{way % ways, way / ways % ways, way / (ways * ways)};
    Matrix3d a = b;
    Vector3d right = -here.gradient;
    for (Index i = 0; i < 3; ++i) {
      if (held.at(std::size_t(i)) == free) continue;
      const double end = held.at(std::size_t(i)) == down ? least[i] : most[i];
      right -= a.col(i) * end;
      a.row(i).setZero();
      a.col(i).setZero();
      a(i, i) = 1.0;
      right[i] = end;
    }
    const Vector3d step = a.ldlt().solve(right);
    if ((step.array() < least.array()).any() || (step.array() > most.array()).any()) continue;
    if (way == 0) return step;
    if (promise(b, here, step) > promise(b, here, best)) best = step;
  }
  return best;
}

/// J' J, with so little more that an unknown without any slope can be solved for.
Matrix3d gauss_newton(const Point& here) {
  Matrix3d b = here.curvature;
  b.diagonal() += 1e-9 * here.curvature.diagonal() + Vector3d::Constant(1e-12 * here.cost);
  return b;
}

}  // namespace

InverseSearch search_shape(const InverseProjection& projection, const ShapeBounds& bounds, const Vector3d& start,
                           double tolerance) {
  InverseSearch search{projection.project(start.cwiseMax(bounds.lowest).cwiseMin(bounds.highest)), 1};
  Point& here = search.end;
  double reach = 1.0;  // half the box, in longest steps
  while (search.passes < most_passes && std::isfinite(here.cost)) {
    const Matrix3d b = gauss_newton(here);
    const Vector3d longest = bounded_step(b, here, bounds, 1.0);
    if (!(promise(b, here, longest) > tolerance * here.cost)) break;
    const Vector3d step = reach < 1.0 ? bounded_step(b, here, bounds, reach) : longest;
    const Point there = projection.project(here.at + step);
    ++search.passes;
    const double share = (here.cost - there.cost) / (2.0 * promise(b, here, step));  // of what was promised
    const double length = step.cwiseAbs().maxCoeff() / longest_step;
    if (share > 0.0) {
      here = there;
      if (share > 0.5) reach = std::min(1.0, std::max(reach, 3.0 * length));
      if (share < 0.1) reach = 0.5 * length;
    } else {
      const double slope = here.gradient.dot(step), there_slope = there.gradient.dot(step);
      const double lowest = there_slope > 0.0 ? slope / (slope - there_slope) : 0.25;
      reach = std::clamp(lowest, 0.1, 0.5) * length;
      if (reach < 1e-6) break;
    }
  }
  return search;
}

}  // namespace feedtwin::tools
