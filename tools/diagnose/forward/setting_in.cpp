#include "tools/diagnose/forward/setting_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/motor_friction.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::string_view id = "motor_presliding";
constexpr std::array distances_m{2.5e-7, 5e-7, 1e-6, 2e-6, 4e-6};
constexpr std::array finer_m{2.5e-7, 3.5e-7, 5e-7, 7e-7, 1e-6, 1.4e-6, 2e-6, 2.8e-6, 4e-6};

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

/// The paths that the inverse model fits best from the file's numbers, if they are worth their place there: numbers that
/// were fitted without may be so far off that no path helps as they are. Of rests that an integrator's torque leaves slowly,
/// with motor and screw creeping on bristles of their own, it took a third of the cost; of axes whose motor does so, which
/// seldom rest, a tenth to a twentieth, and of those with friction at once it took none.
std::vector<Fit> likeliest_by_inverse_model(const Fitter& fitter, const Fit& at_once, const Whitening& whitening) {
  constexpr double least_share = 0.05, nearly = 0.9, usual_m = 5e-7, promising = 0.25;
  const auto fit_over = [&](double distance_m) {
    Candidate from_file{fitter.nominal(), {}};
    give(from_file.axis, distance_m);
    return fitter.fit(from_file, whitening, 2 * refit_iterations);
  };
  const double least = std::max(least_share * at_once.cost, 2.0 * surely_nats);
  // any path is nearer to any other than to none: where friction sets in at once this one is seldom better, and never so
  if (at_once.cost - fit_over(usual_m).cost < promising * least) return {};
  std::vector<Fit> fits;
  for (const double distance_m : finer_m) fits.push_back(fit_over(distance_m));
  const double most = at_once.cost - std::ranges::min_element(fits, {}, &Fit::cost)->cost;
  if (most < least) return {};
  std::erase_if(fits, [&](const Fit& fit) { return at_once.cost - fit.cost < nearly * most; });
  return fits;
}

bool surely_likelier(const Ruling& over_path, const Ruling& at_once, const std::function<void(std::string_view)>& progress) {
  const auto difference = compared(over_path.likelihood, at_once.likelihood);
  progress(fmt::format("closed loop, the motor's friction setting in over {:.2g} um: {:+.0f} nats, {:+.1f} deviations",
                       1e6 * motor_presliding_m(over_path.model.axis), difference.nats, difference.deviations));
  return difference.nats >= surely_nats && difference.deviations >= surely_deviations;
}

// without a torque sensor it is the screw's pre-sliding that it would stand for: the command shows their sum
bool can_be_told(const Fitter& fitter) {
  return fitter.model().tracks().front().torque_sensor_N.size() > 0;
}

}  // namespace

std::vector<plant::EffectSetting> motor_as_it_sets_in(const ForwardModel& forward, const Fitter& fitter,
                                                      const std::function<void(std::string_view)>& progress) {
  auto effects = fitter.nominal().effects;
  if (!can_be_told(fitter) || motor_presliding_m(fitter.nominal()) > 0.0) return effects;
  constexpr int colours = 3;
  constexpr double sure_share = 0.2;  // then the closed loop, which other physics may still bend, is not asked
  const Candidate nominal{fitter.nominal(), {}};
  Whitening whitening = fitter.colour_of(fitter.model().residual(nominal.axis, {}));
  const Fit fit = fitter.fit_with_colour(nominal, whitening, colours, refit_iterations);
  const auto ways = likeliest_by_inverse_model(fitter, fit, whitening);
  if (ways.empty()) return effects;
  const Fit& best = *std::ranges::min_element(ways, {}, &Fit::cost);
  if (best.cost < (1.0 - sure_share) * fit.cost) {
    progress(fmt::format("the motor's friction sets in over {:.2g} um: by its torque sensor alone {:.0f} % of the squares",
                         1e6 * motor_presliding_m(best.model.axis), 100.0 * (1.0 - best.cost / fit.cost)));
    return best.model.axis.effects;
  }
  const Ruling at_once = rule(fit, forward, fitter);
  std::vector<Ruling> over_paths;
  for (const Fit& way : ways) over_paths.push_back(rule_beside(at_once, way, forward, fitter, SlopesOf::anew));
  const Ruling& over_path = *std::ranges::max_element(over_paths, {}, &Ruling::value);
  return surely_likelier(over_path, at_once, progress) ? over_path.model.axis.effects : effects;
}

std::optional<Ruling> ask_how_motor_sets_in(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                                            std::optional<Ruling> settled,
                                            const std::function<void(std::string_view)>& progress) {
  if (!can_be_told(fitter) || motor_presliding_m(fit.model.axis) > 0.0) return settled;
  const auto [distance_m, nats] = likeliest(forward, settled ? settled->model : fit.model);
  if (nats < clearly_nats) return settled;
  Ruling at_once = settled ? *settled : rule(fit, forward, fitter);
  Fit other = fit;
  give(other.model.axis, distance_m);
  Ruling over_path = rule_beside(at_once, other, forward, fitter, SlopesOf::anew);
  if (!surely_likelier(over_path, at_once, progress)) return at_once;
  fit = over_path.fit;
  give(found.recalibrated.model.axis, distance_m);
  return over_path;
}

}  // namespace feedtwin::tools::diagnosis
