#include "tools/diagnose/forward/missed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tools/diagnose/forward/closest.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double in_question_nats = 1000.0, doubtful_nats = 50.0;
/// Of 800 cases one false name was missed by 1; true ones by 24 and more, those of a real axis by 111.
constexpr double found_by_both = 15.0;

/// Times what it takes: a name that is missed so is not asked again when another has gone or the numbers are better.
constexpr double surely_missed = 10.0;

/// A name that was asked, and the runs without it. That structure comes back saves none that follows any law's mistakes: a
/// mass that brakes came and went as a warm-up of 0.7 %, missed by 179.
struct Lacking {
  const Hypothesis* hypothesis;
  Ruling rest;
  double short_of_nats;  ///< what it would take to stay; not positive: it stays
  bool cannot_be;        ///< not of the size that it has beside the others: however much likelier the runs become
};

double most_missed_nats(const SearchResult& found) {
  double most = 0.0;
  for (const auto& one : found.found)
    if (rests_on_force(*one.effect.hypothesis)) most = std::max(most, one.missed_nats);
  return most;
}

/// Asks every name, and notes the answers. Where the numbers make the runs likelier without a name by what they make of fast
/// residuals, and leave a slow one to its colour, a channel far worse says that it is missed: with the drag of the EMPS axis
/// made linear and all numbers bent they were 3537 nats likelier, and the torque 2.7 times as far off.
class Asked {
 public:
  Asked(const ForwardModel& forward, const Fitter& fitter, const std::function<void(std::string_view)>& progress)
      : forward_(forward), fitter_(fitter), progress_(progress) {}

  [[nodiscard]] std::optional<Lacking> least_missed(SearchResult& found, const Fit& fit, Ruling& settled) const {
    std::vector<Lacking> asked;
    for (std::size_t e = 0; e < fit.model.effects.size(); ++e) {
      const auto* hypothesis = fit.model.effects[e].hypothesis;
      auto* named = found.of(hypothesis);
      if (named == nullptr || !worth_naming(fit.model.effects[e], fit.model.axis)) continue;
      if (named->missed_nats > surely_missed * std::max(100.0, nats_to_stay(*named))) continue;
      Ruling rest = without_it(found, fit, settled, e);
      if (likelier_at_a_channels_cost(rest, settled, *hypothesis)) {
        progress_(fmt::format("closed loop, all numbers free, without {}: a channel is far worse, and that is no answer",
                              hypothesis->id));
        const double as_it_is = rule_as_it_is(rest.fit, forward_, fitter_).value;
        named->missed_nats = std::max(named->missed_nats, settled.value - as_it_is);
        continue;
      }
      if (settled.value - rest.value < std::max(doubtful_nats, nats_to_stay(*named))) asked_fairly(settled, rest, e);
      named->missed_nats = settled.value - rest.value;
      const Active& now = settled.model.effects[e];
      const bool cannot_be = !possible(now, settled.model.axis) || (named->by_runs_alone && !runs_may_tell(now));
      const double farther = fitter_.squared_tolerances(rest.model.axis) - fitter_.squared_tolerances(settled.model.axis);
      progress_(
          fmt::format("closed loop, all numbers free, without {}: {:+.0f} nats, numbers {:+.0f} squared tolerances farther "
                      "from nominal",
                      in_words(now, settled.model.axis), -named->missed_nats, farther));
      double short_of_nats = cannot_be ? 1e300 : nats_to_stay(*named, farther) - named->missed_nats;
      if (short_of_nats > 0.0 && !cannot_be && !hypothesis->follows_any_law &&
          structure_comes_back(fitter_, named->missed_nats, fit.residual, rest.fit)) {
        progress_(fmt::format("closed loop: without {} structure comes back that no other name has", hypothesis->id));
        short_of_nats = 0.0;
      }
      asked.push_back({hypothesis, std::move(rest), short_of_nats, cannot_be});
    }
    return least_of(std::move(asked), found);
  }

 private:
  /// Not of what numbers could do: there a channel far worse is what it takes to be without it.
  [[nodiscard]] bool likelier_at_a_channels_cost(const Ruling& rest, const Ruling& settled,
                                                 const Hypothesis& missing) const {
    return rest.value > settled.value && !missing.absorbed &&
           spoils_a_channel(forward_, rest.model, settled.model, far_worse_polished);
  }

  /// The one that lacks most, if one does.
  [[nodiscard]] static std::optional<Lacking> least_of(std::vector<Lacking> asked, SearchResult& found) {
    const double most = most_missed_nats(found);
    for (auto& one : asked)
      one.short_of_nats =
          std::max(one.short_of_nats, nats_beside(*one.hypothesis, most) - found.of(one.hypothesis)->missed_nats);
    const auto least = std::ranges::max_element(asked, {}, &Lacking::short_of_nats);
    return least == asked.end() || least->short_of_nats <= 0.0 ? std::nullopt : std::optional(std::move(*least));
  }

  [[nodiscard]] Ruling without_it(const SearchResult& found, const Fit& fit, const Ruling& settled, std::size_t e) const {
    const Fit less = fitter_.fit(without(fit.model, e), found.whitening, refit_iterations);
    Ruling rest = rule_beside(settled, less, forward_, fitter_, SlopesOf::before, settled.value);
    if (settled.value - rest.value < in_question_nats) rest = rule_again(rest, forward_, fitter_, SlopesOf::anew);
    return rest;
  }

  /// With its effect a model does at least as well as without: where it does not, it was not where it does best. The
  /// numbers of the model without are a better place to start from; and then both go on as long as that helps.
  void asked_fairly(Ruling& settled, Ruling& rest, std::size_t e) const {
    Fit with = settled.fit;
    with.model = settled.model;
    Ruling again = rule_with_one_more(rest, with, e, forward_, fitter_);
    if (again.value > settled.value) {
      again.seen = settled.seen;
      again.fit = settled.fit;
      settled = std::move(again);
    }
    contest(settled, rest, forward_, fitter_);
  }

  const ForwardModel& forward_;
  const Fitter& fitter_;
  const std::function<void(std::string_view)>& progress_;
};

/// Of a channel in closed loop, or of all that was left over, on every stretch that it was not fitted to.
bool explains_most(const Found& named) {
  // compensations that were none had 0.02 to 0.52 where the axis slides, true ones 1.1 to 6.7
  constexpr double times_what_is_left = 3.0;
  return named.error_ratio > explains_most_ratio || (named.held_everywhere && named.strength > times_what_is_left);
}

}  // namespace

double nats_to_stay(const Found& named, double farther) {
  constexpr double enough_of_what_explains_most = 500.0;
  // What numbers take up takes them back when it goes: of 14 true torque constants, five of them with numbers fitted to data
  // that held it, they were 23 to 1173 squared tolerances farther off without; of one that was noise, 17 nearer.
  constexpr double where_it_puts_them_off = 4.0;
  // what numbers could do and what puts them far off has led them astray: a false weight, and a false offset in its place,
  // were missed by 1360 nats and put them 930 squared tolerances off
  constexpr double far_nearer = 100.0, times_as_many = 2.0;
  const Hypothesis& h = *named.effect.hypothesis;
  double least = nats_asked(named.effect, farther > far_from_nominal);
  if (farther < (h.told_by_runs_nats ? 0.0 : h.number_of_the_model ? -clearly_nearer : -1e300))
    least *= where_it_puts_them_off;
  if (explains_most(named)) least = std::min(least, enough_of_what_explains_most);
  // other names too: of ten that put the numbers 30 squared tolerances off and more and are right, a real axis's friction
  // along its travel was missed by 2.1 nats for each of these, the others by 21 and more; of four false ones, one on an axis
  // with nothing hidden, the most by 1.5
  constexpr double nearer = 30.0, nats_a_tolerance = 1.7;
  const bool what_numbers_do = h.told_by_runs_nats || h.number_of_the_model;
  if (farther < -(what_numbers_do ? far_nearer : nearer))
    least = std::max(least, -(what_numbers_do ? times_as_many : nats_a_tolerance) * farther);
  return std::max(named.by_closed_loop ? 100.0 : h.jumps ? 20.0 : found_by_both, least);
}

bool leaves_structure(double missed_nats, const Structure& with, const Structure& without, bool nothing_named) {
  constexpr double times_as_much = 2.0;
  constexpr double least_nats = 3.0;  // a cable's spring that was there was missed by 8, a false name by 1
  return missed_nats > least_nats && without.is_unknown(nothing_named) &&
         std::pow(without.structured_N(), 2) > times_as_much * std::pow(with.structured_N(), 2);
}

bool structure_comes_back(const Fitter& fitter, double missed_nats, const Vector& with, const Fit& without) {
  return leaves_structure(missed_nats, fitter.structure().remaining(with), fitter.structure().remaining(without.residual),
                          names_no_force(without.model));
}

double nats_beside(const Hypothesis& h, double most_missed_nats) {
  constexpr double share = 0.012;  // four false ones had 0.2 to 1.1 per cent, of true ones the least 5
  return h.follows_any_law ? share * most_missed_nats : -1e300;
}

void keep_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit, Ruling& settled,
                 const std::function<void(std::string_view)>& progress) {
  constexpr int most_repeats = 2;
  const Asked asked(forward, fitter, progress);
  for (int repeats = 0;;) {
    const double value = settled.value;
    auto least = asked.least_missed(found, fit, settled);
    if (!least) return;
    const bool beside_less = settled.value > value + of_consequence_nats;  // asked before the others did better
    if (beside_less && !least->cannot_be && repeats++ < most_repeats && !forward.spent()) continue;
    progress(fmt::format("closed loop: {} is not missed", least->hypothesis->id));
    std::erase_if(found.found, [&](const Found& one) { return one.effect.hypothesis == least->hypothesis; });
    settled = std::move(least->rest);
    fit = settled.fit;
  }
}

}  // namespace feedtwin::tools::diagnosis
