#include "tools/identify/stages/stribeck_curve.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "plant/lanes.h"
#include "tools/identify/stages/line_search.h"

namespace feedtwin::tools {
namespace {

using Lanes = plant::Doubles<2>;

/// Weighted sums of a curve that do not depend on v_S, and the curve in lanes.
class ProjectedCurve {
 public:
  explicit ProjectedCurve(const StribeckCurve& curve) : points_((curve.speed_m_per_s.size() + 1) / 2) {
    for (std::size_t i = 0; i < curve.speed_m_per_s.size(); ++i) {
      const double v = curve.speed_m_per_s[i], w = curve.weight[i], y = curve.force_N[i];
      points_[i / 2].speed[i % 2] = v;
      points_[i / 2].weight[i % 2] = w;
      points_[i / 2].force[i % 2] = y;
      w_ += w, wv_ += w * v, wvv_ += w * v * v, wy_ += w * y, wvy_ += w * v * y, wyy_ += w * y * y;
    }
  }

  /// The best of the other three for this v_S.
  [[nodiscard]] StribeckFit at(double stribeck_m_per_s) const {
    Lanes we{}, wee{}, wve{}, wye{};
    const double per_v = 1.0 / stribeck_m_per_s;
    for (const auto& p : points_) {
      const Lanes e = plant::exp_of_minus<Lanes>(p.speed * per_v), x = p.weight * e;
      we += x, wee += x * e, wve += x * p.speed, wye += x * p.force;
    }
    const double e = we[0] + we[1], ee = wee[0] + wee[1], ve = wve[0] + wve[1], ye = wye[0] + wye[1];
    Eigen::Matrix3d normal;
    normal << w_, e, wv_, e, ee, ve, wv_, ve, wvv_;
    const Eigen::Vector3d right{wy_, ye, wvy_};
    // what a bound forbids is left out: rise, then viscous friction, then both
    constexpr bool kept[4][2] = {{true, true}, {false, true}, {true, false}, {false, false}};
    StribeckFit best;
    best.cost = std::numeric_limits<double>::infinity();
    for (const auto& [rise, viscous] : kept) {
      Eigen::Matrix3d a = normal;
      Eigen::Vector3d b = right;
      for (const int i : {rise ? 3 : 1, viscous ? 3 : 2}) {
        if (i == 3) continue;
        a.row(i).setZero();
        a.col(i).setZero();
        a(i, i) = 1.0;
        b[i] = 0.0;
      }
      const Eigen::Vector3d x = a.inverse() * b;
      if (!x.allFinite() || x[0] <= 0.0 || x[1] < 0.0 || x[2] < 0.0) continue;
      const double cost = wyy_ - 2.0 * x.dot(right) + x.dot(normal * x);
      if (cost < best.cost) best = {x[0], x[0] + x[1], stribeck_m_per_s, x[2], cost};
      if (rise && viscous) break;  // the free optimum is within the bounds
    }
    return best;
  }

 private:
  struct Pair {
    Lanes speed{}, force{}, weight{};
  };
  std::vector<Pair> points_;
  double w_ = 0.0, wv_ = 0.0, wvv_ = 0.0, wy_ = 0.0, wvy_ = 0.0, wyy_ = 0.0;
};

}  // namespace

double StribeckFit::force_N(double speed_m_per_s) const noexcept {
  return coulomb_N + (static_N - coulomb_N) * std::exp(-speed_m_per_s / stribeck_m_per_s) + viscous_Ns_per_m * speed_m_per_s;
}

std::optional<StribeckFit> fit_stribeck_curve(const StribeckCurve& curve) {
  if (curve.speed_m_per_s.size() < 6) return std::nullopt;
  const auto [slowest, fastest] = std::ranges::minmax(curve.speed_m_per_s);
  if (!(slowest > 0.0) || !(fastest > 1.5 * slowest)) return std::nullopt;
  const ProjectedCurve projected(curve);
  const auto cost = [&projected](double log_v) { return projected.at(std::exp(log_v)).cost; };
  const double log_v = lowest_point(cost, std::log(slowest / 3.0), std::log(fastest / 3.0), 18);
  const StribeckFit fit = projected.at(std::exp(log_v));
  return std::isfinite(fit.cost) ? std::optional(fit) : std::nullopt;
}

StribeckCurve binned_curve(std::span<const double> speed_m_per_s, std::span<const double> force_N, std::size_t most_points) {
  StribeckCurve curve;
  if (speed_m_per_s.empty()) return curve;
  const auto [slowest, fastest] = std::ranges::minmax(speed_m_per_s);
  const double per_ratio = static_cast<double>(most_points) / std::max(std::log(fastest / slowest) * (1.0 + 1e-9), 1e-9);
  std::vector<double> count(most_points, 0.0), speed(most_points, 0.0), force(most_points, 0.0);
  for (std::size_t i = 0; i < speed_m_per_s.size(); ++i) {
    const auto bin = std::min(static_cast<std::size_t>(per_ratio * std::log(speed_m_per_s[i] / slowest)), most_points - 1);
    count[bin] += 1.0;
    speed[bin] += speed_m_per_s[i];
    force[bin] += force_N[i];
  }
  for (std::size_t bin = 0; bin < most_points; ++bin) {
    if (count[bin] == 0.0) continue;
    curve.speed_m_per_s.push_back(speed[bin] / count[bin]);
    curve.force_N.push_back(force[bin] / count[bin]);
    curve.weight.push_back(count[bin]);
  }
  return curve;
}

}  // namespace feedtwin::tools
