#include "tools/diagnose/forward/gain_in_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "plant/steady_friction.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double nats_for_each = 2.0;  // squared tolerance that the numbers are nearer: one of 0.7 lost 71 and won 61
constexpr double least_share = 0.5;    // of the shift: friction that is off by itself leaves the mass where it is

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

double fastest_m_per_s(const std::vector<Track>& tracks) {
  double fastest = 0.0;
  for (const auto& track : tracks) fastest = std::max(fastest, track.centred_m_per_s.cwiseAbs().maxCoeff());
  return fastest;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Logarithms of how many times the nominal friction there is, at speeds that the axis runs at, both ways: of single numbers
/// the runs tell a sum better than each. None where one of them is not there.
std::vector<double> shifts_of_friction(const plant::LugreParameters& now, const plant::LugreParameters& nominal,
                                       double fastest_m_per_s) {
  std::vector<double> shifts;
  for (const double share : {0.1, 0.2, 0.35, 0.5, 0.7, 0.9})
    for (const double v : {share * fastest_m_per_s, -share * fastest_m_per_s}) {
      const double times = plant::steady_force_N(now, v) / plant::steady_force_N(nominal, v);
      if (!(times > 0.0)) return {};
      shifts.push_back(std::log(times));
    }
  return shifts;
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

CommonShift common_shift(const Fitter& fitter, const plant::AxisParameters& axis) {
  constexpr double clearly = 1.1, most_apart = 2.0;  // tolerances
  const auto& nominal = fitter.nominal();
  const auto mass_entry = std::ranges::find(fitter.base(), "guide.mass_kg", [](const auto& n) { return n.entry->key; });
  if (mass_entry == fitter.base().end() || axis.guide_mass_kg <= 0.0 || nominal.guide_mass_kg <= 0.0) return {};
  const double tolerance = mass_entry->tolerance;
  const double mass = std::log(axis.guide_mass_kg / nominal.guide_mass_kg);
  const auto friction = shifts_of_friction(axis.guide, nominal.guide, fastest_m_per_s(fitter.model().tracks()));
  if (friction.empty()) return {};
  const double mean_friction = mean(friction), factor = 0.5 * (mass + mean_friction);
  double apart = 0.0;
  for (const double shift : friction) apart += std::pow(shift - mean_friction, 2) / static_cast<double>(friction.size());
  const bool all = std::min(mass / factor, mean_friction / factor) > least_share && std::sqrt(apart) < tolerance &&
                   std::abs(mass - mean_friction) < most_apart * tolerance;
  const auto of_guide = [](const BaseParameter& n) { return n.entry->key.starts_with("guide.") && !n.known_to_a_factor; };
  return {.factor = std::exp(factor),
          .fall = static_cast<double>(std::ranges::count_if(fitter.base(), of_guide)) * std::pow(factor / tolerance, 2),
          .of_all_together = all && std::abs(factor) > clearly * tolerance};
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
  const CommonShift shift = common_shift(fitter, settled ? settled->model.axis : fit.model.axis);
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
  const bool tells = with.value + nats_for_each * fall >= now.value && fall >= 0.0 && shift.stands_for(1.0 + gain.q[1]);
  if (!tells || !can_be_named(gain, with.model.axis)) return settled;
  found.found.push_back(told(gain, shift, fall / (fall + fitter.squared_tolerances(with.model.axis))));
  fit = with.fit;
  return with;
}

}  // namespace feedtwin::tools::diagnosis
