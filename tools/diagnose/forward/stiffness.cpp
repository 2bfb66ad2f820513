#include "tools/diagnose/forward/stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tools/diagnose/forward/extended_axis.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// 500 to 25 N/um. A swing's phase tells one from the next, so they are close.
constexpr std::array compliances_m_per_N{2e-9,   2.6e-9, 3.4e-9, 4.4e-9, 5.7e-9, 7.4e-9,
                                         9.6e-9, 1.3e-8, 1.7e-8, 2.2e-8, 2.9e-8, 4e-8};

constexpr double other_than_rigid_deviations = 1.5;

bool can_be_told(const Fitter& fitter, const Candidate& model) {
  const Track& track = fitter.model().tracks().front();
  const bool sensor_beyond_motor = track.force_sensor_N.size() > 0 || track.torque_sensor_N.size() > 0;
  return sensor_beyond_motor && !has(model, hypothesis("screw_compliance")) && !has(model, hypothesis("backlash"));
}

/// Compliances to be asked for: with a scale the one that it shows.
std::vector<double> asked_of(const Fitter& fitter, const Whitening& whitening, Candidate on_screw) {
  if (fitter.model().tracks().front().slip_m.size() == 0) return {compliances_m_per_N.begin(), compliances_m_per_N.end()};
  constexpr int iterations = 4;
  on_screw.effects.back().q.front() = compliances_m_per_N.front();
  return {fitter.fit(on_screw, whitening, iterations).model.effects.back().q.front()};
}

/// Reduced mass of motor and screw against the table, kg: what swings on the screw.
double swinging_kg(const plant::AxisParameters& axis) {
  const double rad_per_m = 2.0 * std::numbers::pi / axis.axis.lead_m;
  const double behind_kg = (axis.motor.inertia_kgm2 + axis.ball_screw_inertia_kgm2) * rad_per_m * rad_per_m;
  return behind_kg * axis.guide_mass_kg / (behind_kg + axis.guide_mass_kg);
}

/// Dampings to be asked for with a stiffness: as the plant's preset has it, and a tenth of critical, more on a heavy table.
std::array<double, 2> dampings_Ns_per_m(const plant::AxisParameters& axis, double compliance_m_per_N) {
  // a screw of 0.11 was 1612 nats worse than a rigid one with 3000 N s/m, and 2078 better with 25000
  constexpr double of_critical = 0.1;
  return {screw_damping_Ns_per_m, of_critical * 2.0 * std::sqrt(swinging_kg(axis) / compliance_m_per_N)};
}

/// The model on the screw under which the runs are likeliest with its numbers as they are; and by how much.
std::pair<Candidate, double> on_likeliest_screw(const ForwardModel& forward, const Fitter& fitter,
                                                const Whitening& whitening, const Candidate& model) {
  const double rigid = likelihood(forward, extended(model)).total();
  Candidate best = model, other = model;
  double nats = 0.0;
  other.effects.push_back({&hypothesis("screw_compliance"), {0.0, std::log(screw_damping_Ns_per_m)}});
  for (const double compliance : asked_of(fitter, whitening, other)) {
    for (const double damping : dampings_Ns_per_m(model.axis, compliance)) {
      other.effects.back().q = {compliance, std::log(damping)};
      const double more = likelihood(forward, extended(other)).total() - rigid;
      if (more > nats) nats = more, best = other;
    }
  }
  return {best, nats};
}

/// With a force sensor that is not late, which is what a screw that yields looks like; a torque sensor may be. The numbers
/// stay as they are: read anew, the one body of the inverse model bends them to the swing, mass first.
Candidate with_punctual_force_sensor(Candidate model) {
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    Active& skew = model.effects[e];
    if (skew.hypothesis != &hypothesis("channel_skew")) continue;
    skew.q.back() = 0.0;
    return worth_naming(skew, model.axis) ? model : without(model, e);
  }
  return model;
}

}  // namespace

std::optional<Ruling> ask_how_stiff(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                                    const std::function<void(std::string_view)>& progress) {
  if (!can_be_told(fitter, fit.model)) return std::nullopt;
  const Candidate punctual = with_punctual_force_sensor(fit.model);
  const auto [start, nats] = on_likeliest_screw(forward, fitter, found.whitening, punctual);
  if (nats < clearly_nats) return std::nullopt;
  Ruling yielding = rule(fitter.linearised(start, found.whitening), forward, fitter);
  Ruling rigid = rule(fit, forward, fitter, yielding.value);
  const auto difference = compared(yielding.likelihood, rigid.likelihood);
  const double better = yielding.value - rigid.value;
  const double stiffness = 1.0 / yielding.model.effects.back().q.front();
  progress(fmt::format("closed loop, on a screw of {:.3g} N/m: {:+.0f} nats, {:+.1f} deviations", stiffness, better,
                       difference.deviations));
  if (better < clearly_nats || difference.deviations < other_than_rigid_deviations) return rigid;
  if (punctual.effects.size() < fit.model.effects.size()) {
    progress("the screw yields: the force sensor is not late");
    std::erase_if(found.found, [](const Found& one) { return one.effect.hypothesis == &hypothesis("channel_skew"); });
  }
  // what no number makes up for is as polished; the others stay beside the numbers that they were fitted with
  for (std::size_t e = 0; e < yielding.fit.model.effects.size(); ++e) {
    Active& effect = yielding.fit.model.effects[e];
    if (effect.hypothesis == &hypothesis("screw_compliance") || effect.hypothesis == &hypothesis("channel_skew"))
      effect = yielding.model.effects[e];
  }
  fit = yielding.fit;
  return yielding;
}

}  // namespace feedtwin::tools::diagnosis
