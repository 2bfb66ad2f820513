#include "tools/diagnose/forward/gain_in_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double least_share_of_mass = 0.5;  // of the shift: friction that is off by itself leaves the mass where it is
constexpr double most_left = 1.0;            // squared tolerances a number, once the shift is taken from it

bool can_be_told(const Fitter& fitter, const Candidate& model) {
  return fitter.model().tracks().front().force_sensor_N.size() > 0 && !has(model, hypothesis("sensor_gain"));
}

/// The reading as it was, of a table that is as much less as the sensor shows too much.
Candidate with_gain(const Candidate& model, double gain) {
  constexpr double force_sensor = 1.0;
  Candidate with{with_table_less(model.axis, gain), model.effects};
  with.effects.push_back({&hypothesis("sensor_gain"), {0.0, gain - 1.0, force_sensor}});
  return with;
}

/// Polished, if that did not leave the file's numbers for what the model simplifies.
Ruling likelier(const Fit& fit, const ForwardModel& forward, const Fitter& fitter) {
  Ruling polished = rule(fit, forward, fitter), as_it_is = rule_as_it_is(fit, forward, fitter);
  return polished.value > as_it_is.value ? polished : as_it_is;
}

/// @param share of the squared deviations from the file
Found told(const Active& gain, const CommonShift& shift, double share) {
  return {.effect = gain,
          .gain = shift.fall,
          .share = share,
          .strength = 0.0,
          .p_false_alarm = std::erfc(std::sqrt(0.5 * shift.fall)),  // of so much in one direction
          .rivals = {},
          .by_closed_loop = true,
          .by_common_shift = true};
}

}  // namespace

CommonShift common_shift(const Fitter& fitter, const plant::AxisParameters& axis, const Eigen::MatrixXd& covariance) {
  std::vector<std::pair<double, double>> shifts;  // and how much of each the runs tell, where the file's tolerance does not
  double mass = 0.0, tolerance = 0.0, told = 0.0, mean = 0.0, left = 0.0;
  for (std::size_t i = 0; i < fitter.base().size(); ++i) {
    const auto& number = fitter.base()[i];
    if (!number.entry->key.starts_with("guide.") || number.known_to_a_factor) continue;
    const double now = value_of(number, axis), nominal = value_of(number, fitter.nominal());
    if (now <= 0.0 || nominal <= 0.0) return {};
    const auto at = static_cast<Index>(i);
    shifts.emplace_back(std::log(now / nominal), std::clamp(1.0 - covariance(at, at), 0.0, 1.0));
    told += shifts.back().second;
    if (number.entry->key == "guide.mass_kg") mass = shifts.back().first, tolerance = number.tolerance;
  }
  if (told <= 0.0) return {};
  for (const auto& [shift, weight] : shifts) mean += weight * shift / told;
  for (const auto& [shift, weight] : shifts) left += weight * std::pow((shift - mean) / tolerance, 2);
  return {.factor = std::exp(mean),
          .fall = told * std::pow(mean / tolerance, 2),
          .of_all_together = std::abs(mean) > tolerance && mass / mean > least_share_of_mass && left < most_left * told};
}

bool CommonShift::stands_for(double gain) const {
  const double part = std::log(gain) / std::log(factor);
  return part > 0.5 && part < 2.0;
}

plant::AxisParameters with_table_less(plant::AxisParameters axis, double times) {
  const double k = per_lead(axis.axis), less = 1.0 - 1.0 / times;
  const auto give = [&](double& table, double& screw) {
    screw += less * table;
    table -= less * table;
  };
  const auto give_both_ways = [&](plant::Directional& table, plant::Directional& screw) {
    give(table.pos, screw.pos);
    give(table.neg, screw.neg);
  };
  plant::LugreParameters &table = axis.guide, &screw = axis.ball_screw;
  give_both_ways(table.coulomb_N, screw.coulomb_N);
  give_both_ways(table.static_N, screw.static_N);
  give_both_ways(table.viscous_Ns_per_m, screw.viscous_Ns_per_m);
  give(table.stiffness_N_per_m, screw.stiffness_N_per_m);
  axis.ball_screw_inertia_kgm2 += less * axis.guide_mass_kg / (k * k);
  axis.guide_mass_kg -= less * axis.guide_mass_kg;
  return axis;
}

std::optional<Ruling> ask_for_gain_in_numbers(const ForwardModel& forward, const Fitter& fitter, SearchResult& found,
                                              Fit& fit, std::optional<Ruling> settled,
                                              const std::function<void(std::string_view)>& progress) {
  if (!can_be_told(fitter, fit.model)) return settled;
  const CommonShift shift = common_shift(fitter, settled ? settled->model.axis : fit.model.axis, fit.covariance);
  if (!shift.of_all_together) return settled;
  Ruling now = settled ? *settled : rule(fit, forward, fitter);
  Ruling with = likelier(fitter.linearised(with_gain(now.model, shift.factor), found.whitening), forward, fitter);
  contest(with, now, forward, fitter);
  const Active& gain = with.model.effects.back();
  const double fall = fitter.squared_tolerances(now.model.axis) - fitter.squared_tolerances(with.model.axis);
  progress(fmt::format(
      "the table's numbers are {:.2f} times the file's together; closed loop, with {}: {:+.0f} nats, {:.1f} squared "
      "tolerances nearer to nominal",
      shift.factor, in_words(gain, with.model.axis), with.value - now.value, fall));
  const bool tells = with.value >= now.value && fall >= 0.0 && shift.stands_for(1.0 + gain.q[1]);
  if (!tells || !can_be_named(gain, with.model.axis)) return settled;
  found.found.push_back(told(gain, shift, fall / (fall + fitter.squared_tolerances(with.model.axis))));
  fit = with.fit;
  return with;
}

}  // namespace feedtwin::tools::diagnosis
