#include "controllers/gcode/corner_blend.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers::gcode {
namespace {

/// A segment gives up at most this share of its length at either end, an arc at most this angle.
constexpr double largest_share = 0.45;
constexpr double largest_cut_rad = 0.5;
constexpr double least_cut_m = 1e-9;

/// Largest magnitude of b + c u + d u^2 over 0..1.
double largest_quadratic(double b, double c, double d) noexcept {
  double most = std::max(std::abs(b), std::abs(b + c + d));
  if (d != 0.0) {
    const double u = -0.5 * c / d;
    if (u > 0.0 && u < 1.0) most = std::max(most, std::abs(b + u * (c + d * u)));
  }
  return most;
}

/// Largest magnitude of a + b u + c u^2 + d u^3 over 0..1.
double largest_cubic(double a, double b, double c, double d) noexcept {
  double most = std::max(std::abs(a), std::abs(a + b + c + d));
  const auto consider = [&](double u) {
    if (u > 0.0 && u < 1.0) most = std::max(most, std::abs(a + u * (b + u * (c + u * d))));
  };
  // where the derivative b + 2 c u + 3 d u^2 vanishes
  const double discriminant = c * c - 3.0 * b * d;
  if (discriminant >= 0.0) {
    const double q = -(c + std::copysign(std::sqrt(discriminant), c));
    if (d != 0.0) consider(q / (3.0 * d));
    if (q != 0.0) consider(b / q);
  }
  return most;
}

/// A bound of the magnitude of the quintic's derivative: its largest Bernstein coefficient.
double derivative_bound(const std::array<double, 6>& c) noexcept {
  // power basis of the derivative: k c_k; Bernstein coefficients b_i = sum_k (i over k) / (4 over k) a_k
  constexpr double binomial[5][5] = {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
  double most = 0.0;
  for (int i = 0; i <= 4; ++i) {
    double b = 0.0;
    for (int k = 0; k <= i; ++k) b += binomial[i][k] / binomial[4][k] * (k + 1) * c[static_cast<std::size_t>(k + 1)];
    most = std::max(most, std::abs(b));
  }
  return most;
}

double largest_cut_m(const Segment& segment) noexcept {
  const double by_length = largest_share * segment.length_m();
  return segment.is_arc() ? std::min(by_length, largest_cut_rad * segment.radius_m()) : by_length;
}

}  // namespace

CornerBlend::CornerBlend(const Segment& before, const Segment& after, double cut_m) noexcept : cut_m_(cut_m) {
  const double L = 2.0 * cut_m;
  const CurvePoint from = before.at(before.length_m() - cut_m), to = after.at(cut_m);
  for (int axis = 0; axis < 3; ++axis) {
    const double p0 = from.at_m[axis], p1 = to.at_m[axis] - p0;
    const double v0 = L * from.first[axis], v1 = L * to.first[axis];
    const double a0 = L * L * from.second_per_m[axis], a1 = L * L * to.second_per_m[axis];
    c_[static_cast<std::size_t>(axis)] = {p0,
                                          v0,
                                          0.5 * a0,
                                          10.0 * p1 - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1,
                                          -15.0 * p1 + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1,
                                          6.0 * p1 - 3.0 * v0 - 3.0 * v1 - 0.5 * a0 + 0.5 * a1};
  }
}

CornerBlend::Sample CornerBlend::at(double u, double speed_m_per_s) const noexcept FEEDTWIN_REALTIME {
  const double rate = speed_m_per_s / (2.0 * cut_m_);
  Sample s;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = c_[static_cast<std::size_t>(axis)];
    s.at_m[axis] = c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5]))));
    s.velocity_m_per_s[axis] = rate * (c[1] + u * (2.0 * c[2] + u * (3.0 * c[3] + u * (4.0 * c[4] + u * 5.0 * c[5]))));
    s.acceleration_m_per_s2[axis] = rate * rate * (2.0 * c[2] + u * (6.0 * c[3] + u * (12.0 * c[4] + u * 20.0 * c[5])));
  }
  return s;
}

double CornerBlend::deviation_m(const Segment& before, const Segment& after) const noexcept {
  constexpr int points = 16;
  double most = 0.0;
  for (int i = 1; i < points; ++i) {
    const double u = static_cast<double>(i) / points;
    const double past_m = cut_m_ * (2.0 * u - 1.0);  // of the corner
    const Point on_path = past_m < 0.0 ? before.at(before.length_m() + past_m).at_m : after.at(past_m).at_m;
    most = std::max(most, length(at(u, 1.0).at_m - on_path));
  }
  return most;
}

double CornerBlend::speed_limit_m_per_s(const AxisLimits& axes) const noexcept {
  const double L = 2.0 * cut_m_;
  double speed = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = c_[static_cast<std::size_t>(axis)];
    const double v = derivative_bound(c) / L;
    const double a = largest_cubic(2.0 * c[2], 6.0 * c[3], 12.0 * c[4], 20.0 * c[5]) / (L * L);
    const double j = largest_quadratic(6.0 * c[3], 24.0 * c[4], 60.0 * c[5]) / (L * L * L);
    if (v > 0.0) speed = std::min(speed, axes.speed_m_per_s[axis] / v);
    if (a > 0.0) speed = std::min(speed, std::sqrt(axes.acceleration_m_per_s2[axis] / a));
    if (j > 0.0) speed = std::min(speed, std::cbrt(axes.jerk_m_per_s3[axis] / j));
  }
  return speed;
}

CornerBlend blend_within(const Segment& before, const Segment& after, double tolerance_m) noexcept {
  double cut_m = std::min(largest_cut_m(before), largest_cut_m(after));
  for (int i = 0; i < 60 && cut_m > least_cut_m; ++i) {
    CornerBlend blend(before, after, cut_m);
    const double deviation_m = blend.deviation_m(before, after);
    if (deviation_m <= tolerance_m) return blend;
    // grows with the cut's first power at a corner, with its square where only the curvature changes
    cut_m *= 0.995 * std::max(1e-3, std::sqrt(tolerance_m / deviation_m));
  }
  return {};
}

}  // namespace feedtwin::controllers::gcode
