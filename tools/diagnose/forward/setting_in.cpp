#include "tools/diagnose/forward/setting_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/motor_friction.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::string_view id = "motor_presliding";
constexpr std::array distances_m{2.5e-7, 5e-7, 1e-6, 2e-6, 4e-6};

/// It must be worth its place beyond all doubt: what it stands for wrongly would be lost.
constexpr double surely_nats = 300.0, surely_deviations = 4.0;

void give(plant::AxisParameters& axis, double distance_m) {
  std::erase_if(axis.effects, [](const plant::EffectSetting& effect) { return effect.id == id; });
  axis.effects.push_back({.id = std::string(id), .values = {distance_m}, .lists = {}});
}

/// The likeliest path with the numbers as they are, and by how much.
std::pair<double, double> likeliest(const ForwardModel& forward, const Candidate& model) {
  const double at_once = likelihood(forward, extended(model)).total();
  std::pair<double, double> best{0.0, 0.0};
  for (const double distance_m : distances_m) {
    Candidate other = model;
    give(other.axis, distance_m);
    const double more = likelihood(forward, extended(other)).total() - at_once;
    if (more > best.second) best = {distance_m, more};
  }
  return best;
}

}  // namespace

std::optional<Ruling> ask_how_motor_sets_in(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                                            std::optional<Ruling> settled,
                                            const std::function<void(std::string_view)>& progress) {
  // without a torque sensor it is the screw's pre-sliding that it would stand for: the command shows their sum
  const bool can_be_told = fitter.model().tracks().front().torque_sensor_N.size() > 0;
  if (!can_be_told || motor_presliding_m(fit.model.axis) > 0.0) return settled;
  const auto [distance_m, nats] = likeliest(forward, settled ? settled->model : fit.model);
  if (nats < clearly_nats) return settled;
  Ruling at_once = settled ? *settled : rule(fit, forward, fitter);
  Fit other = fit;
  give(other.model.axis, distance_m);
  Ruling over_path = rule_beside(at_once, other, forward, fitter, SlopesOf::anew);
  const auto difference = compared(over_path.likelihood, at_once.likelihood);
  progress(fmt::format("closed loop, the motor's friction setting in over {:.2g} um: {:+.0f} nats, {:+.1f} deviations",
                       1e6 * distance_m, difference.nats, difference.deviations));
  if (difference.nats < surely_nats || difference.deviations < surely_deviations) return at_once;
  fit = over_path.fit;
  give(found.recalibrated.model.axis, distance_m);
  return over_path;
}

}  // namespace feedtwin::tools::diagnosis
