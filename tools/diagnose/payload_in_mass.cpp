#include "tools/diagnose/payload_in_mass.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/reported.h"
#include "tools/diagnose/sentence.h"
#include "tools/intervals.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double least_tolerances = 5.0, least_deviations = 8.0;

}  // namespace

std::optional<NamedEffect> payload_in_mass(const Fitter& fitter, const Fit& fit, const Eigen::MatrixXd& covariance) {
  const Hypothesis& own = hypothesis("payload");
  const auto mass =
      std::ranges::find(fitter.base(), "guide.mass_kg", [](const BaseParameter& one) { return one.entry->key; });
  if (mass == fitter.base().end() || has(fit.model, own)) return std::nullopt;
  const Index place = mass - fitter.base().begin();
  const double tolerance_kg = fitter.tolerance(static_cast<std::size_t>(place));
  const double more_kg = value_of(*mass, fit.model.axis) - value_of(*mass, fitter.nominal());
  const double deviation_kg = tolerance_kg * std::sqrt(std::max(0.0, covariance(place, place)));
  if (more_kg < least_tolerances * tolerance_kg || more_kg < least_deviations * deviation_kg ||
      !possible({&own, {more_kg}}, fitter.nominal()))
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

}  // namespace feedtwin::tools::diagnosis
