#include "tools/diagnose/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnose/dropouts.h"
#include "tools/diagnose/reading_structure.h"
#include "tools/diagnose/structure.h"
#include "tools/diagnose/sweep.h"
#include "tools/diagnose/switching.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// (N rms)^2 of structure that the names leave over, and of what they explain.
struct Squares {
  double left, explained;
  Squares(const Structure& before, const Structure& after)
      : left(std::pow(after.structured_N(), 2)),
        explained(std::max(0.0, std::pow(before.remainder_N, 2) - std::pow(after.remainder_N, 2))) {}
  [[nodiscard]] double share_left() const { return left > 0.0 ? left / (left + explained) : 0.0; }
};

/// Do the names only take a bite of something else? Right names left 0.07 of the structure at most in 192 made cases where a
/// third of the remainder was structure, beside a real record's own 0.28; false ones, of three cases outside the catalogue,
/// 0.41 and more. Of less structure they must leave more than they explain: of some 500 answers one had such names, a law
/// of speed for a hump of friction at one.
bool only_a_bite(const Structure& after, const Squares& squares) {
  constexpr double least_share = 0.3, least_N = 0.3, least_left = 0.35, more_than_explained = 0.5;
  const double least = after.share > least_share ? least_left : more_than_explained;
  return after.share > least_share_of_much && after.structured_N() > least_N * after.newton && squares.share_left() > least;
}

/// Most of what the runs are off by is the name's: a hidden compensation that the numbers had half taken up left 9 times as
/// much without it, of which the structure that was left with it was a bite.
bool explains_most(const SearchResult& found) {
  return std::ranges::any_of(found.found, [&](const Found& one) {
    return one.error_ratio > explains_most_ratio && rests_on_force(*one.effect.hypothesis) &&
           worth_naming(one.effect, found.final.model.axis);
  });
}

/// A name that every unseen fold bears out stays whatever else is left over, if it is more than a bite: not where it leaves
/// most of the structure, and not beside a spring that gives way with time, which none of the catalogue is and which looks
/// like a spring and a drag.
bool certain(const SearchResult& found, const Structure& after, const Squares& squares) {
  constexpr double most_left = 0.5, gives_way = 0.2;
  if (squares.share_left() > most_left || after.gives_way > gives_way) return explains_most(found);
  return std::ranges::any_of(found.found, [&](const Found& one) {
    return one.held_everywhere && rests_on_force(*one.effect.hypothesis) && worth_naming(one.effect, found.final.model.axis);
  });
}

/// On a table that its own force sensor shows. Of 44 made cases with nothing hidden none had more than 0.06 N there, though
/// up to half of what was left over; a bellows that leaked had 0.53 N, 0.8 of it, of which the motor's noise hid all but a
/// thirteenth from the sum.
bool stands_out_on_the_table(const Structure& table) {
  constexpr double least_share = 0.4, least_N = 0.3;
  return table.share > least_share && table.structured_N() > least_N * table.newton;
}

/// What the sensor adds is in the equation before it too, turned round: then it is not the table's.
bool force_sensor_shows_more(const InverseModel& model, const Candidate& final) {
  const auto readings = structure_of_readings(model, final);
  return std::ranges::any_of(readings, [](const ReadingStructure& reading) {
    return reading.channel == channel::force_sensor_N && reading.stands_out();
  });
}

}  // namespace

bool anything_missing(const Diagnosis& result) {
  const auto is_physics = [](const NamedEffect& e) { return !e.hypothesis->number_of_the_model; };
  return !result.setup.empty() || std::ranges::any_of(result.effects, is_physics);
}

const char* verdict_of(const Diagnosis& result) {
  const auto open = [](const NamedEffect& e) { return !e.alternatives.empty() && !e.hypothesis->number_of_the_model; };
  if (std::ranges::any_of(result.effects, open)) return "named-set";
  if (anything_missing(result)) return "named";
  if (!result.suspects.empty() && result.effects.empty()) return "cannot-tell";
  const bool as_given = result.recalibrated.empty() && result.effects.empty() && result.motor_presliding_m == 0.0;
  return as_given ? "agrees" : "recalibrate";
}

bool beyond_the_catalogue(const Fitter& fitter, const SearchResult& found, const Candidate& final,
                          const std::function<void(std::string_view)>& progress) {
  constexpr double unexplained = 0.1;
  const bool nothing_named = names_no_force(final);
  const auto& structure_of = fitter.structure();
  const Structure before = structure_of.remaining(found.recalibrated.residual);
  const Vector residual = fitter.model().residual(final.axis, final.effects);
  const Structure with_names = structure_of.remaining(residual);
  // what no name of the forces left and was not there before is numbers that a scale's names have bent: 1.4 N from 0.3
  const Structure& after = nothing_named && before.structured_N() < with_names.structured_N() ? before : with_names;
  const Squares squares(before, after);
  progress(fmt::format("structure: {:.2g} N of {:.2g} N left over; before naming {:.2g} N of {:.2g} N",
                       with_names.structured_N(), with_names.remainder_N, before.structured_N(), before.remainder_N));
  if (const auto sweep = nothing_named ? sweep_of(fitter.model(), residual) : std::nullopt) {
    progress(
        fmt::format("a force of {:.2g} N runs from {:.3g} to {:.3g} Hz", sweep->amplitude_N, sweep->low_Hz, sweep->high_Hz));
    return true;
  }
  if (const auto dropouts = nothing_named ? dropouts_of(fitter.model(), final) : std::nullopt) {
    progress(fmt::format("{:.0f} % of the commanded torque fail at {} moments", 100.0 * dropouts->share, dropouts->moments));
    return true;
  }
  if (const auto switching = nothing_named ? switching_of(fitter.model(), final) : std::nullopt) {
    progress(fmt::format("a force of {:.2g} N is on or off, {} switches seen", switching->force_N, switching->switches));
    return true;
  }
  const auto on_the_table = [&](const Vector& left) { return stands_out_on_the_table(structure_of.of_the_table(left)); };
  if (nothing_named && on_the_table(found.recalibrated.residual) && on_the_table(residual) &&
      !force_sensor_shows_more(fitter.model(), final))
    return true;
  return (only_a_bite(after, squares) && !explains_most(found)) ||
         (after.is_unknown(nothing_named) && squares.share_left() > unexplained && !certain(found, after, squares));
}

}  // namespace feedtwin::tools::diagnosis
