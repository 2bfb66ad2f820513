#include "tools/identify/stages/hysteresis.h"

#include <algorithm>
#include <cmath>

#include "plant/steady_friction.h"
#include "tools/identify/stages/line_search.h"

namespace feedtwin::tools {
namespace {

constexpr double bristle_lengths = 6.0;  // of F_S / sigma0 after a reversal: the bristle still moves

double of_direction(const plant::Directional& value, double v) {
  return v > 0.0 ? value.pos : value.neg;
}

double sliding_N(const plant::LugreParameters& p, double v) {
  return plant::stribeck_force_N(p, v > 0.0, std::abs(v));
}

}  // namespace

/// A run with everything that does not depend on sigma0 worked out.
struct HysteresisCost::Run {
  std::vector<double> travel_m, travel_per_force_m_per_N;  // over the tick that starts at a row; signed, and |.| / g
  std::vector<double> direction_force_N;                   // s g over that tick
  std::vector<double> velocity, rate_per_force;            // at the row: v, |v| / g
  std::vector<double> bristle_part_N;                      // F - m a - mu v
  std::vector<bool> counts;
};

namespace {

template <class PreparedRun>
PreparedRun prepare(const ComponentForces& run, std::span<const double> force_N, double mass_kg,
                    const plant::LugreParameters& friction, double reach_m) {
  PreparedRun prepared;
  const std::size_t n = force_N.empty() ? 0 : force_N.size() - 2;
  for (std::size_t i = 0; i < n; ++i) {
    const double travel_m = run.position_m[i + 1] - run.position_m[i], v_tick = travel_m / run.sample_s;
    const double g_tick = sliding_N(friction, v_tick), v = run.velocity_m_per_s[i];
    prepared.travel_m.push_back(travel_m);
    prepared.travel_per_force_m_per_N.push_back(std::abs(travel_m) / g_tick);
    prepared.direction_force_N.push_back(travel_m < 0.0 ? -g_tick : g_tick);
    prepared.velocity.push_back(v);
    prepared.rate_per_force.push_back(std::abs(v) / sliding_N(friction, v));
    prepared.bristle_part_N.push_back(force_N[i] - mass_kg * run.acceleration_m_per_s2[i] -
                                      of_direction(friction.viscous_Ns_per_m, v) * v);
    prepared.counts.push_back(run.since_reversal_m[i] < reach_m);
  }
  return prepared;
}

/// Bristle deflection at every row of a run.
template <class PreparedRun, class Visit>
void follow_bristle(const PreparedRun& run, double stiffness, const Visit& visit) {
  double z_m = 0.0;
  for (std::size_t i = 0; i < run.travel_m.size(); ++i) {
    visit(i, z_m);
    const double y = stiffness * run.travel_per_force_m_per_N[i];
    const double decay = 1.0 / (1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0))));
    const double steady_m = run.direction_force_N[i] / stiffness;
    z_m = steady_m + (z_m - steady_m) * decay;
  }
}

/// Sums over the samples that count, of r = dz/dt and y = the bristle's part less sigma0 z.
struct Squares {
  double rr = 0.0, ry = 0.0, yy = 0.0;
  std::size_t samples = 0;

  [[nodiscard]] double rms(double damping) const {
    const double squares = yy - 2.0 * damping * ry + damping * damping * rr;
    return std::sqrt(std::max(squares, 0.0) / static_cast<double>(std::max<std::size_t>(samples, 1)));
  }
};

template <class PreparedRun>
Squares squares_at(std::span<const PreparedRun> runs, double stiffness) {
  Squares sums;
  for (const auto& run : runs) {
    follow_bristle(run, stiffness, [&](std::size_t i, double z_m) {
      if (!run.counts[i]) return;
      const double rate = run.velocity[i] - stiffness * run.rate_per_force[i] * z_m;
      const double y = run.bristle_part_N[i] - stiffness * z_m;
      sums.rr += rate * rate, sums.ry += rate * y, sums.yy += y * y;
      ++sums.samples;
    });
  }
  return sums;
}

}  // namespace

HysteresisCost::HysteresisCost(std::span<const ComponentForces> runs, std::vector<double> ComponentForces::* component,
                               double mass_kg, const plant::LugreParameters& friction) {
  const double reach_m =
      bristle_lengths * std::max(friction.static_N.pos, friction.static_N.neg) / friction.stiffness_N_per_m;
  for (const auto& run : runs) runs_.push_back(prepare<Run>(run, run.*component, mass_kg, friction, reach_m));
}

HysteresisCost::~HysteresisCost() = default;

double HysteresisCost::rms_N(double stiffness_N_per_m, double damping_Ns_per_m) const {
  return squares_at<Run>(runs_, stiffness_N_per_m).rms(damping_Ns_per_m);
}

HysteresisFit HysteresisCost::projected(double stiffness_N_per_m) const {
  const Squares sums = squares_at<Run>(runs_, stiffness_N_per_m);
  const double damping = sums.rr > 0.0 ? std::max(sums.ry / sums.rr, 0.0) : 0.0;
  return {stiffness_N_per_m, damping, sums.rms(damping), sums.samples};
}

std::size_t HysteresisCost::samples() const {
  std::size_t count = 0;
  for (const auto& run : runs_) count += static_cast<std::size_t>(std::ranges::count(run.counts, true));
  return count;
}

std::optional<HysteresisFit> fit_hysteresis(std::span<const ComponentForces> runs,
                                            std::vector<double> ComponentForces::* component, double mass_kg,
                                            const plant::LugreParameters& friction) {
  const HysteresisCost squares(runs, component, mass_kg, friction);
  if (squares.samples() < 20) return std::nullopt;
  const auto cost = [&squares](double log_stiffness) { return squares.projected(std::exp(log_stiffness)).rms_N; };
  const double middle = std::log(friction.stiffness_N_per_m), reach = std::log(30.0);
  return squares.projected(std::exp(lowest_point(cost, middle - reach, middle + reach, 15, 1e-5)));
}

std::vector<double> HysteresisCost::model_N(const ComponentForces& run, double mass_kg,
                                            const plant::LugreParameters& friction) {
  std::vector<double> force_N(run.position_m.size(), 0.0);
  const auto prepared = prepare<Run>(run, force_N, mass_kg, friction, 0.0);
  follow_bristle(prepared, friction.stiffness_N_per_m, [&](std::size_t i, double z_m) {
    const double rate = prepared.velocity[i] - friction.stiffness_N_per_m * prepared.rate_per_force[i] * z_m;
    force_N[i] = friction.stiffness_N_per_m * z_m + friction.damping_Ns_per_m * rate - prepared.bristle_part_N[i];
  });
  return force_N;
}

}  // namespace feedtwin::tools
