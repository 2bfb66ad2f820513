#include "tools/diagnose/forward/second_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/questions.h"
#include "tools/diagnose/forward/telling.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr int most_names = 2;
constexpr double beyond_noise = 2.0;  // a channel that is worth the question

/// How a model brings a channel closer, of those that are off beyond noise.
struct Closer {
  std::string channel;
  double ratio = 1.0, share = 0.0;
};

Closer closer(const Nrmse& before, const Nrmse& after, const Nrmse& floor, const Active& effect) {
  Closer best;
  for (const auto& [name, error] : before) {
    if (error < beyond_noise * floor.at(name) || !bears_out(effect, name)) continue;
    const double ratio = error / std::max(after.at(name), 1e-12);
    if (ratio > best.ratio) best = {name, ratio, (error - after.at(name)) / (error - floor.at(name))};
  }
  return best;
}

/// Channel by channel the lesser error.
Nrmse lesser(Nrmse one, const Nrmse& other) {
  for (auto& [name, error] : one) error = std::min(error, other.at(name));
  return one;
}

/// Of as many deviations in any of the hypotheses: what the closed loop names, it vouches for. Where a channel comes all of
/// its way the likelihood ratio alone tells (Wilks 1938): stretches that stick otherwise say nothing of that.
double chance_of(const Comparison& likelier, bool all_of_its_way) {
  const double by_ratio = all_of_its_way ? std::sqrt(2.0 * std::max(0.0, likelier.nats)) : 0.0;
  const double deviations = std::max(likelier.deviations, by_ratio);
  return std::min(1.0, 0.5 * std::erfc(deviations / std::numbers::sqrt2) * static_cast<double>(hypotheses().size()));
}

class SecondLook {
 public:
  SecondLook(const ForwardModel& forward, const Fitter& fitter, const std::function<void(std::string_view)>& progress)
      : forward_(forward), fitter_(fitter), progress_(progress) {}

  /// One name more, if there is one.
  bool look(SearchResult& found, Fit& fit, std::optional<Ruling>& settled) {
    const auto asked = questions(found.last, fit.model);
    const Candidate& model = settled ? settled->model : fit.model;
    if (asked.empty() || forward_.spent()) return false;
    floor_ = forward_.noise_floor(extended(model));
    if (!is_off(forward_.nrmse(extended(model)))) return false;
    settled =
        polished_out(settled ? rule_again(*settled, forward_, fitter_, SlopesOf::before) : rule(fit, forward_, fitter_));
    errors_ = forward_.nrmse(extended(settled->model));
    least_errors_ = lesser(forward_.nrmse(extended(fit.model)), errors_);
    if (!is_off(errors_)) return false;
    std::vector<Answer> answers;
    for (const auto& question : asked) {
      if (forward_.spent()) break;
      if (auto one = answer(question, *settled, shared_nats(answers, *settled), found.whitening, fit))
        answers.push_back(std::move(*one));
    }
    std::ranges::stable_sort(answers, std::greater{}, [](const Answer& a) { return a.ruling.value; });
    auto best = std::ranges::find(answers, true, &Answer::enough);
    while (best != answers.end() && !told_fairly(*best, *settled)) best = std::find_if(++best, answers.end(), &enough);
    if (best == answers.end() || !stands_out(answers, *best, *settled)) return false;
    const bool by_runs_alone = best->by_runs_alone;
    const auto rivals = settled_against_others(answers, best);
    if (by_runs_alone && !runs_may_tell(best->ruling.model.effects.back())) return false;
    const double gain = fit.cost - best->ruling.fit.cost;
    found.found.push_back(
        {.effect = best->ruling.model.effects.back(),
         .gain = gain,
         .share = std::clamp(gain / std::max(1.0, best->score->touched), 0.0, 1.0),
         .strength = 0.0,
         .p_false_alarm = chance_of(compared(best->ruling.likelihood, settled->likelihood), best->all_of_its_way),
         .rivals = rivals,
         .held_everywhere = false,
         .by_closed_loop = true,
         .by_runs_alone = by_runs_alone,
         .error_ratio = best->error_ratio});
    fit = best->ruling.fit;
    settled = std::move(best->ruling);
    return true;
  }

 private:
  static constexpr int most_rounds = 4;
  static constexpr double glance_share = 0.3;  // of the nats that tell it: what a glance must promise
  // Of that, what straight slopes must promise of a sensor's reading before a step is simulated: of 77 glances at 16 cases
  // none that promised less was worth asking. What pushes is not judged so: at rest friction hides it, and slopes with it (a
  // weight of 2 N promised 0.3 nats and brought 1200).
  static constexpr double promise_share = 0.3;

  /// The closed loop with one effect more.
  struct Answer {
    const Score* score;
    Ruling ruling;
    bool enough = false;          ///< to be named
    bool by_runs_alone = false;   ///< no channel says so
    double error_ratio = 1.0;     ///< of the channel that says so most
    bool all_of_its_way = false;  ///< comes that channel
  };

  static bool enough(const Answer& answer) { return answer.enough; }

  /// Where what has nothing to do with it brings as much, both have only led polishing to better numbers.
  [[nodiscard]] static bool stands_out(const std::vector<Answer>& answers, const Answer& best, const Ruling& now) {
    constexpr double as_much = 0.9;  // right ones 1.4 times the next and more; two that were polishing 1.01
    const Hypothesis& told = *best.score->hypothesis;
    return std::ranges::none_of(answers, [&](const Answer& other) {
      const Hypothesis& h = *other.score->hypothesis;
      return &h != &told && !easily_confused(h, told) &&
             other.ruling.value - now.value > as_much * (best.ruling.value - now.value);
    });
  }

  /// What no channel's error tells must not be what polishing further tells: the model without goes on from its numbers.
  [[nodiscard]] bool told_fairly(Answer& answer, Ruling& without) const {
    const Hypothesis& h = *answer.score->hypothesis;
    if (!answer.by_runs_alone) return true;
    contest(answer.ruling, without, forward_, fitter_);
    const double nats = answer.ruling.value - without.value;
    progress_(fmt::format("closed loop, {}, both polished further: {:+.0f} nats", h.id, nats));
    return nats >= *h.told_by_runs_nats && runs_may_tell(answer.ruling.model.effects.back());
  }

  /// As far as polishing goes: what it has still to gain would be put down to the effect that is asked about.
  [[nodiscard]] Ruling polished_out(Ruling now) const {
    for (int round = 0; round < most_rounds; ++round) {
      Ruling further = rule_again(now, forward_, fitter_, SlopesOf::anew);
      const bool done = further.value - now.value < of_consequence_nats;
      now = std::move(further);
      if (done) break;
    }
    return now;
  }

  /// What is easily confused with the best of the answers, and does as well, takes its place or stands beside it.
  [[nodiscard]] std::vector<const Hypothesis*> settled_against_others(std::vector<Answer>& answers,
                                                                      std::vector<Answer>::iterator best) const {
    std::vector<const Hypothesis*> rivals;
    for (auto other = answers.begin(); other != answers.end(); ++other) {
      if (other == best || !easily_confused(*other->score->hypothesis, *best->score->hypothesis)) continue;
      contest(best->ruling, other->ruling, forward_, fitter_);
      if (!can_be_named(other->ruling.model.effects.back(), other->ruling.model.axis)) continue;
      if (other->ruling.value > best->ruling.value) std::swap(*best, *other);
      if (best->ruling.value - other->ruling.value < clearly_nats) rivals.push_back(other->score->hypothesis);
    }
    return rivals;
  }

  [[nodiscard]] bool is_off(const Nrmse& errors) const {
    return std::ranges::any_of(errors, [&](const auto& e) { return e.second > beyond_noise * floor_.at(e.first); });
  }

  /// The ruling's model with the effect that is asked about as given.
  [[nodiscard]] static Fit beside(const Ruling& now, const Question& question) {
    Fit with = now.fit;
    with.model = now.model;
    with.model.effects.push_back({question.score.hypothesis, question.start});
    return with;
  }

  /// With the effect as the inverse model fits it; where that cannot tell it as given, or not at all.
  [[nodiscard]] std::optional<Fit> refitted(const Question& question, const Whitening& whitening, const Fit& fit) const {
    Fit with = fit_with(fitter_, fit.model, question.score, fit.model.effects.size(), whitening, refit_iterations);
    Active& effect = with.model.effects.back();
    if (effect.hypothesis->told_by_runs_nats || !can_be_named(effect, with.model.axis)) {
      if (question.start.empty()) return std::nullopt;
      effect.q = question.start;
    }
    return with;
  }

  /// What any effect brings, as the first answers show: it is what polishing further does.
  [[nodiscard]] static double shared_nats(const std::vector<Answer>& answers, const Ruling& now) {
    if (answers.size() < 2) return 0.0;
    const auto least = std::ranges::min_element(answers, {}, [](const Answer& one) { return one.ruling.value; });
    return std::max(0.0, least->ruling.value - now.value);
  }

  /// A few steps along the known slopes of the numbers tell whether to ask at all.
  [[nodiscard]] bool worth_asking(const Fit& with, const Ruling& now, double shared) const {
    const double least = with.model.effects.back().hypothesis->told_by_runs_nats.value_or(least_nats_by_channel);
    const double promise = with.model.effects.back().hypothesis->only_readings ? promise_share * glance_share * least : 0.0;
    const Ruling glance = glance_at_one_more(now, with, forward_, fitter_, promise);
    return glance.value - now.value > shared + glance_share * least;
  }

  /// The closed loop with one effect more; nothing where that is not the answer.
  [[nodiscard]] std::optional<Answer> answer(const Question& question, const Ruling& now, double shared,
                                             const Whitening& whitening, const Fit& fit) const {
    const Hypothesis& h = *question.score.hypothesis;
    if (h.told_by_runs_nats && !worth_asking(beside(now, question), now, shared)) return std::nullopt;
    auto with = refitted(question, whitening, fit);
    if (!with || (!h.told_by_runs_nats && !worth_asking(*with, now, shared))) return std::nullopt;
    const std::size_t more = with->model.effects.size() - 1;
    Ruling one = rule_with_one_more(now, std::move(*with), more, forward_, fitter_);
    if (!can_be_named(one.model.effects.back(), one.model.axis)) return std::nullopt;
    return judged(Answer{&question.score, std::move(one)}, now);
  }

  [[nodiscard]] Answer judged(Answer answer, const Ruling& now) const {
    const Hypothesis& h = *answer.score->hypothesis;
    const Ruling& one = answer.ruling;
    const auto seen = closer(h.only_readings ? least_errors_ : errors_, forward_.nrmse(extended(one.model)), floor_,
                             one.model.effects.back());
    const double nats = one.value - now.value, deviations = compared(one.likelihood, now.likelihood).deviations;
    const double nearer_nominal = fitter_.squared_tolerances(now.model.axis) - fitter_.squared_tolerances(one.model.axis);
    progress_(
        fmt::format("closed loop, with {}: {:+.0f} nats, {:+.1f} deviations, numbers {:+.0f} squared tolerances nearer to "
                    "nominal, {} {:.2f} times as close, {:.0f} %",
                    in_words(one.model.effects.back(), one.model.axis), nats, deviations, nearer_nominal,
                    seen.channel.empty() ? "no channel" : seen.channel, seen.ratio, 100.0 * seen.share));
    const Answered answered{.nats = nats,
                            .deviations = deviations,
                            .nearer_nominal = nearer_nominal,
                            .ratio = seen.ratio,
                            .share = seen.share,
                            .slight = runs_may_tell(one.model.effects.back())};
    const Telling telling = telling_of(h, answered);
    answer.all_of_its_way = all_of_its_way(answered);
    answer.by_runs_alone = telling == Telling::by_runs_alone;
    answer.error_ratio = seen.ratio;
    answer.enough = telling != Telling::nothing;
    return answer;
  }

  const ForwardModel& forward_;
  const Fitter& fitter_;
  const std::function<void(std::string_view)>& progress_;
  Nrmse floor_, errors_;
  Nrmse least_errors_;  ///< polished or not: polishing may have left a sensor to bring the command closer
};

}  // namespace

std::optional<Ruling> look_again(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                                 const std::optional<Ruling>& settled,
                                 const std::function<void(std::string_view)>& progress) {
  SecondLook second(forward, fitter, progress);
  auto ruling = settled;
  for (int names = 0; names < most_names && second.look(found, fit, ruling); ++names)
    found.last = screen(fitter, fit, found.whitening);
  return ruling;
}

}  // namespace feedtwin::tools::diagnosis
