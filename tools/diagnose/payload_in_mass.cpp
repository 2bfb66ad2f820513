#include "tools/diagnose/payload_in_mass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/diagnose/hypotheses/shapes.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/sentence.h"
#include "tools/intervals.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double least_deviations = 8.0;
/// In tolerances. A force sensor weighs the table by itself: with one the tables of 330 made machines with nothing hidden
/// came out 1.21 times as heavy as in the file at most, which was up to a tenth off.
constexpr double least_by_all = 4.0, least_by_force_sensor = 3.3;

/// Among the recalibrated numbers; none: it is none of them.
std::optional<Index> place_of(const Fitter& fitter, std::string_view key) {
  const auto one = std::ranges::find(fitter.base(), key, [](const BaseParameter& base) { return base.entry->key; });
  return one == fitter.base().end() ? std::nullopt : std::optional<Index>(one - fitter.base().begin());
}

/// Is the screw's Coulomb friction, both ways, off by more than a data sheet's could be? Numbers that were fitted under a
/// lead that is wrong are all off by what the lead is.
bool friction_is_another(const Fitter& fitter, const plant::AxisParameters& axis) {
  constexpr double far_tolerances = 4.0;
  const Vector off = fitter.deviations(axis).cwiseAbs();
  double least = 1e300;
  for (std::size_t i = 0; i < fitter.base().size(); ++i)
    if (fitter.base()[i].entry->key.starts_with("ball_screw.coulomb")) least = std::min(least, off[static_cast<Index>(i)]);
  return least > far_tolerances;
}

/// Does the table take what the screw gives away? What swings between the two, and is none of the model, makes them exchange
/// mass, and all that moves is as heavy as before: two tables grew by 62 and 160 kg, the screws' inertias shrank by as much,
/// to two fifths.
bool only_exchanged(const Fitter& fitter, const plant::AxisParameters& axis, double more_kg) {
  constexpr double far_tolerances = 4.0, most_share = 0.5;
  const auto screw = place_of(fitter, "ball_screw.inertia_kgm2");
  if (!screw || fitter.deviations(axis)[*screw] > -far_tolerances) return false;
  const double k = per_lead(axis.axis);
  const double screw_kg = k * k * (axis.ball_screw_inertia_kgm2 - fitter.nominal().ball_screw_inertia_kgm2);
  return more_kg + screw_kg < most_share * more_kg;
}

}  // namespace

std::optional<NamedEffect> payload_in_mass(const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance) {
  const Hypothesis& own = hypothesis("payload");
  const auto place = place_of(fitter, "guide.mass_kg");
  if (!place || has(fit.model, own)) return std::nullopt;
  const double tolerance_kg = fitter.tolerance(static_cast<std::size_t>(*place));
  const double more_kg = fit.model.axis.guide_mass_kg - fitter.nominal().guide_mass_kg;
  const double deviation_kg = tolerance_kg * std::sqrt(std::max(0.0, covariance(*place, *place)));
  const bool weighed = fitter.model().tracks().front().force_sensor_N.size() > 0;
  const double least_tolerances = weighed ? least_by_force_sensor : least_by_all;
  if (more_kg < least_tolerances * tolerance_kg || more_kg < least_deviations * deviation_kg ||
      !possible({&own, {more_kg}}, fitter.nominal()) || only_exchanged(fitter, fit.model.axis, more_kg))
    return std::nullopt;
  const double gain = std::pow(more_kg / std::max(deviation_kg, 1e-9 * tolerance_kg), 2);
  NamedEffect effect = held_by_numbers(own, gain, fit);
  // what the table itself weighs is known by the axis file alone
  const double half_kg = normal_90 * std::hypot(for_the_laws * deviation_kg, tolerance_kg);
  effect.parameters = {{"mass_kg", {more_kg, more_kg - half_kg, more_kg + half_kg}}};
  double longest_s = 0.0;
  for (const auto& track : fitter.model().tracks())
    longest_s = std::max(longest_s, static_cast<double>(track.size) * track.sample_s);
  effect.intervals = {{0.0, longest_s}};
  effect.sentence = sentence_of(effect) + " The recalibrated mass of the table holds it.";
  return effect;
}

void tell_load(Diagnosis& told, const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance) {
  const auto lead = std::ranges::find(told.setup, "wrong_lead", &SetupFault::id);
  if (lead != told.setup.end() && friction_is_another(fitter, fit.model.axis)) {
    std::erase_if(told.effects, [](const NamedEffect& one) { return one.hypothesis == &hypothesis("payload"); });
    lead->sentence +=
        " The file's friction is off with it, as if it had been fitted under that lead: no load is told from the "
        "table's mass.";
  } else if (auto payload = payload_in_mass(fitter, fit, covariance)) {
    told.effects.push_back(std::move(*payload));
  }
}

}  // namespace feedtwin::tools::diagnosis
