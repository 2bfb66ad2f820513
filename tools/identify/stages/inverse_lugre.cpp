#include "tools/identify/stages/inverse_lugre.h"

#include <algorithm>
#include <cmath>

#include "plant/lugre.h"
#include "tools/identify/stages/inverse_search.h"

namespace feedtwin::tools {
namespace {

constexpr double cost_tolerance = 2.5e-7;  // half the relative fall of the cost that another step would promise

lanes::MotionView view_of(const InverseLugre::Run& run) {
  return {run.velocity.size(), run.sample_s, run.velocity.data(), run.acceleration.data(), run.force_N.data()};
}

/// Where numbers are looked for. A Stribeck velocity beyond the fastest motion is not told from viscous friction, and one
/// far below it is never seen.
ShapeBounds bounds_for(double fastest_m_per_s) {
  const double v = std::max(fastest_m_per_s, 1e-9);
  return {{-std::log(1e-2), std::log(small_rise), std::log(1e-4 * v)},
          {-std::log(1e-10), std::log(10.0), std::log(3.0 * v)}};
}

}  // namespace

InverseLugre::InverseLugre(std::span<const ComponentForces> runs) {
  for (const auto& from : runs) {
    Run run;
    run.sample_s = from.sample_s;
    const auto& x = from.position_m;
    for (std::size_t i = 1; i + 2 < x.size(); ++i) {
      run.velocity.push_back((x[i + 1] - x[i]) / from.sample_s);
      run.acceleration.push_back((x[i + 2] - x[i + 1] - x[i] + x[i - 1]) / (2.0 * from.sample_s * from.sample_s));
      run.force_N.push_back(from.total_N[i]);
    }
    samples_ += run.velocity.size();
    for (const double v : run.velocity) fastest_m_per_s_ = std::max(fastest_m_per_s_, std::abs(v));
    products_ += motion_products(view_of(run));
    runs_.push_back(std::move(run));
  }
}

std::optional<InverseLugreFit> InverseLugre::fit(const InverseLugreStart& start) const {
  if (samples_ < 50) return std::nullopt;
  InverseMotion motion{{}, products_};
  for (const auto& run : runs_) motion.runs.push_back(view_of(run));
  const Eigen::Vector3d x{-std::log(start.bristle_length_m),
                          std::log(std::max(start.static_over_coulomb - 1.0, 0.0) + small_rise),
                          std::log(start.stribeck_m_per_s)};
  const auto [end, passes] = search_shape(InverseProjection(motion), bounds_for(fastest_m_per_s_), x, cost_tolerance);
  const auto shape = friction_shape(end.at);
  const InverseLugreFit fit{end.linear[0],
                            end.linear[1],
                            end.linear[1] * (1.0 + shape.rise),
                            1.0 / shape.inverse_stribeck_s_per_m,
                            end.linear[3],
                            end.linear[1] * shape.per_length_per_m,
                            end.linear[2],
                            end.linear[4],
                            end.cost,
                            passes};
  return std::isfinite(fit.cost) && fit.coulomb_N > 0.0 ? std::optional(fit) : std::nullopt;
}

double InverseLugre::cost(const InverseLugreFit& at) const {
  const plant::LugreBristle<double> bristle{at.stiffness_N_per_m, 1.0 / at.stiffness_N_per_m, at.damping_Ns_per_m};
  const plant::LugreSide<double> side{at.coulomb_N, at.static_N - at.coulomb_N, 1.0 / at.stribeck_m_per_s,
                                      at.viscous_Ns_per_m};
  double sum = 0.0;
  for (const auto& run : runs_) {
    double z_m = 0.0;
    for (std::size_t i = 0; i < run.velocity.size(); ++i) {
      const double v = run.velocity[i], sign = v < 0.0 ? -1.0 : 1.0;
      const auto step = plant::lugre_step<double>(bristle, side, sign, sign * v, z_m, run.sample_s, 1.0 / run.sample_s);
      z_m = step.bristle_m;
      const double off_N = at.mass_kg * run.acceleration[i] + step.force_N + at.offset_N - run.force_N[i];
      sum += off_N * off_N;
    }
  }
  return sum;
}

}  // namespace feedtwin::tools
