#include "tools/diagnose/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tools/diagnose/judge.h"
#include "tools/diagnose/preferred.h"
#include "tools/diagnose/whole_number.h"
#include "tools/diagnose/wider_stribeck.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr int rounds = 3;
/// Of the best hypotheses that are refitted; of which none is enough.
constexpr std::size_t refitted = 4, refitted_for_one = 10, rivals_tried = 4;

class Search {
 public:
  Search(const Fitter& fitter, const Bar& bar, const std::function<void(std::string_view)>& progress)
      : fitter_(fitter), bar_(bar), progress_(progress) {}

  SearchResult run() {
    SearchResult result;
    const Candidate nominal{fitter_.nominal(), {}};
    const Whitening of_nominal = whitening_ = fitter_.colour_of(fitter_.model().residual(nominal.axis, {}));
    progress_("recalibrating the nominal numbers");
    take(nominal, rounds);
    try_wider_stribeck();
    result.recalibrated = fit_;
    if (!try_what_strikes(fitter_.linearised(nominal, of_nominal), of_nominal)) try_what_strikes(fit_, whitening_);
    for (std::size_t step = 0; step < 3 * bar_.most_effects; ++step) {
      progress_(fmt::format("asking {} hypotheses about the residual", hypotheses().size()));
      last_ = screen(fitter_, fit_, whitening_);
      progress_(in_words(last_));
      if (fit_.model.effects.size() >= bar_.most_effects || !add_best()) break;
      drop_needless();
    }
    drop_needless();
    confirm(result);
    result.final = fit_;
    result.whitening = whitening_;
    result.last = last_;
    return result;
  }

 private:
  /// The model from here on, refitted with a colour of its own.
  void take(const Candidate& model, int colours = 2) {
    fit_ = fitter_.fit_with_colour(model, whitening_, colours, refit_iterations);
    bring_back();
    for (const auto& effect : fit_.model.effects)
      if (possible(effect, fit_.model.axis)) sound_[effect.hypothesis] = effect.q;
    lacking_.clear();
  }

  /// A law with a kink may be stepped over to where its effect is none: once more from where it stood, beside the others
  /// as they are now.
  void bring_back() {
    Candidate again = fit_.model;
    bool any = false;
    for (auto& effect : again.effects) {
      const auto stood = sound_.find(effect.hypothesis);
      if (stood != sound_.end() && !possible(effect, again.axis)) effect.q = stood->second, any = true;
    }
    if (!any) return;
    Fit other = fitter_.fit(again, whitening_, refit_iterations);
    if (other.cost > fit_.cost) return;
    whitening_ = fitter_.colour_of(other.residual);
    fit_ = fitter_.linearised(other.model, whitening_);
  }

  /// The fit without one of its effects; asked for more than once.
  const Fit& lacking(std::size_t effect) {
    const auto known = lacking_.find(effect);
    if (known != lacking_.end()) return known->second;
    return lacking_.emplace(effect, fitter_.fit(without(fit_.model, effect), whitening_, refit_iterations)).first->second;
  }

  void try_wider_stribeck() {
    const auto wider = with_wider_stribeck(fitter_, fit_, whitening_, 2 * refit_iterations);
    if (!wider) return;
    progress_(
        fmt::format("a Stribeck velocity of {:.2g} m/s explains more", wider->model.axis.ball_screw.stribeck_m_per_s.pos));
    take(wider->model, rounds);
  }

  /// What strikes once, harder than everything else pushes, bends all numbers until it no longer shows as itself: it is
  /// asked for beside the nominal ones too, and without chance's leave: signs drawn at random leave one event what it is.
  bool try_what_strikes(const Fit& before, const Whitening& colour) {
    constexpr double asked_at = 0.2, most_left = 0.5;  // of the cost: its place is not known well, before it is fitted
    const auto scores = scores_of({&hypothesis("hard_stop")}, fitter_, before, colour);
    if (scores.empty() || scores.front().gain < asked_at * before.cost) return false;
    const Fit struck = fit_with(fitter_, before.model, scores.front(), 0, whitening_, refit_iterations);
    const Active& effect = struck.model.effects.front();
    progress_(fmt::format("  {}: {:.2g} times the cost of the numbers alone", in_words(effect, struck.model.axis),
                          struck.cost / fit_.cost));
    if (!possible(effect, struck.model.axis) || struck.cost > most_left * fit_.cost) return false;
    progress_("adding " + in_words(effect, struck.model.axis));
    const auto verdict = judged(fitter_, struck, fit_, *effect.hypothesis, bar_);
    chances_.push_back(std::min(1.0, std::exp(-0.5 * verdict.surprise) * static_cast<double>(hypotheses().size())));
    earlier_.push_back(scores);
    take(struck.model, rounds);
    return true;
  }

  /// The best of the hypotheses that pass the bar, refitted jointly.
  bool add_best() {
    std::vector<Tried> enough;
    std::size_t tried = 0;
    std::vector<Score> scores = last_.scores;
    const auto worth = [this](const Score& s) {
      return s.gain - bar_.per_parameter * static_cast<double>(freedom(*s.hypothesis));
    };
    std::ranges::stable_sort(scores, std::greater{}, worth);
    for (const auto& score : scores) {
      double p = last_.p_false_alarm(score.standard);
      const bool by_chance = p > bar_.p_false_alarm;
      const bool by_chance_alone = by_chance && score.gain < score.hypothesis->far_off_gain;
      if (score.gain < bar_.gain || by_chance_alone || dropped_.contains(score.hypothesis)) continue;
      ++tried;
      if (tried > refitted && (!enough.empty() || tried > refitted_for_one)) break;
      Fit fit = fit_with_whole_number(fitter_, fit_, score, whitening_, bar_, refit_iterations);
      if (!possible(fit.model.effects.back(), fit.model.axis)) {
        progress_(fmt::format("  {}: no such size", in_words(fit.model.effects.back(), fit.model.axis)));
        continue;
      }
      const auto verdict = judged(fitter_, fit, fit_, *score.hypothesis, bar_);
      progress_(fmt::format("  {}: gain {:.0f}, surprise {:.0f}, strength {:.2f}",
                            in_words(fit.model.effects.back(), fit.model.axis), verdict.gain, verdict.surprise,
                            verdict.strength));
      if (!verdict.enough || (by_chance && !verdict.far_off)) continue;
      if (by_chance) p = std::min(1.0, std::exp(-0.5 * verdict.surprise) * static_cast<double>(hypotheses().size()));
      const double value = verdict.gain - bar_.per_parameter * static_cast<double>(freedom(*score.hypothesis));
      enough.push_back({std::move(fit), value, p});
    }
    if (enough.empty()) return false;
    const Tried& best = preferred(enough);
    progress_("adding " + in_words(best.fit.model.effects.back(), best.fit.model.axis));
    chances_.push_back(best.p_false_alarm);
    earlier_.push_back(last_.scores);
    take(best.fit.model);
    return true;
  }

  void drop(std::size_t effect, const Candidate& less, const Verdict& why) {
    progress_(fmt::format("without {}: gain {:.0f}, surprise {:.0f}, strength {:.2f}",
                          fit_.model.effects[effect].hypothesis->id, why.gain, why.surprise, why.strength));
    dropped_.insert(fit_.model.effects[effect].hypothesis);
    chances_.erase(chances_.begin() + static_cast<std::ptrdiff_t>(effect));
    earlier_.erase(earlier_.begin() + static_cast<std::ptrdiff_t>(effect));
    take(less);
  }

  /// Takes out, one after the other, what the rest can do without.
  void drop_needless() {
    for (bool again = true; again && !fit_.model.effects.empty();) {
      again = false;
      std::size_t weakest = 0;
      double least = 1e300;
      Candidate less;
      Verdict why;
      for (std::size_t i = 0; i < fit_.model.effects.size(); ++i) {
        const auto& active = fit_.model.effects[i];
        const Fit& other = lacking(i);
        const auto verdict = judged(fitter_, fit_, other, *active.hypothesis, bar_);
        const bool needed = verdict.enough && possible(active, fit_.model.axis);
        if (needed || verdict.gain > least) continue;
        least = verdict.gain, weakest = i, less = other.model, why = verdict, again = true;
      }
      if (again) drop(weakest, less, why);
    }
  }

  /// Puts an equal or better one in an effect's place where there is one; notes those that fit as well.
  bool exchange(std::size_t i, const Fit& less, double gain, Found& found) {
    const auto own_score = std::ranges::find(earlier_[i], found.effect.hypothesis, &Score::hypothesis);
    const double own = own_score == earlier_[i].end() ? 0.0 : own_score->gain;
    std::size_t tried = 0;
    for (const auto& score : earlier_[i]) {
      const auto* rival = score.hypothesis;
      if (has(fit_.model, *rival) || gave_way_.contains(rival)) continue;
      if (score.gain < 0.7 * own || last_.leaves_to(score) || ++tried > rivals_tried) continue;
      const Fit fit = fit_with(fitter_, less.model, score, less.model.effects.size(), whitening_, refit_iterations);
      const Active& other = fit.model.effects.back();
      if (!worth_naming(other, fit.model.axis) || !possible(other, fit.model.axis)) continue;
      const auto verdict = judged(fitter_, fit, less, *rival, bar_);
      if (!verdict.enough || !may_be_missed_enough(other, verdict.gain)) continue;
      const double more = bar_.per_parameter *
                          (static_cast<double>(freedom(*rival)) - static_cast<double>(freedom(*found.effect.hypothesis)));
      const double worse = fit.cost + more - fit_.cost;
      if (worse < -clearly_better(*rival, *found.effect.hypothesis, gain)) {
        progress_(fmt::format("{} in place of {}", rival->id, found.effect.hypothesis->id));
        dropped_.insert(found.effect.hypothesis);
        gave_way_.insert(found.effect.hypothesis);
        chances_[i] = last_.p_false_alarm(score.standard);
        Candidate swapped = fit.model;  // in the same place
        std::rotate(swapped.effects.begin() + static_cast<std::ptrdiff_t>(i), swapped.effects.end() - 1,
                    swapped.effects.end());
        take(swapped);
        return true;
      }
      if (worse < std::min(0.03 * gain, 0.005 * fit_.cost) + 15.0) found.rivals.push_back(rival);
    }
    return false;
  }

  /// The last question to each: does it hold on stretches that it was not fitted to, and could another stand for it?
  void confirm(SearchResult& result) {
    while (!settled(result)) result.found.clear();
    std::ranges::stable_sort(result.found, [](const Found& a, const Found& b) { return a.gain > b.gain; });
  }

  /// Where an effect acts and shows most, the strength of the strongest other one: what its model leaves over is there too.
  /// @param less fits without each effect
  [[nodiscard]] double largest_beside(std::size_t effect, const std::vector<Fit>& less) const {
    const auto& model = fitter_.model();
    const auto own = strengths(model, fit_, less[effect], fit_.model.effects[effect].hypothesis->about_reversals, bar_);
    const auto equation = static_cast<std::size_t>(std::ranges::max_element(own) - own.begin());
    const auto there = rows_of(model, fit_, less[effect]);
    double largest = 0.0;
    for (std::size_t other = 0; other < less.size(); ++other)
      if (other != effect && worth_naming(fit_.model.effects[other], fit_.model.axis))
        largest = std::max(largest, strengths(model, fit_, less[other], false, bar_, there)[equation]);
    return largest;
  }

  /// False when an effect was taken out or exchanged, so that all must be asked again.
  bool settled(SearchResult& result) {
    const std::size_t count = fit_.model.effects.size();
    std::vector<Fit> less;
    std::vector<Verdict> verdicts;
    std::vector<bool> everywhere(count);
    for (std::size_t i = 0; i < count; ++i) {
      less.push_back(lacking(i));
      verdicts.push_back(judged(fitter_, fit_, less[i], *fit_.model.effects[i].hypothesis, bar_));
    }
    std::vector<std::size_t> weakest_first(count);
    std::iota(weakest_first.begin(), weakest_first.end(), 0U);
    std::ranges::stable_sort(weakest_first, std::less{}, [&](std::size_t i) { return verdicts[i].gain; });
    for (const std::size_t i : weakest_first) {
      const Active& effect = fit_.model.effects[i];
      const auto& verdict = verdicts[i];
      const Unseen unseen = on_unseen(fitter_.model(), fit_, less[i], *effect.hypothesis, verdict, bar_);
      progress_(fmt::format("{}: gain {:.0f}, on unseen folds {:.0f} in {} of {}, surprise {:.0f}, strength {:.2f}",
                            effect.hypothesis->id, verdict.gain, unseen.gain, unseen.folds, bar_.folds, verdict.surprise,
                            verdict.strength));
      everywhere[i] = unseen.everywhere;
      const bool hidden = hidden_beside(largest_beside(i, less), verdict, unseen, bar_);
      if (!unseen.holds || !verdict.enough || hidden || !possible(effect, fit_.model.axis)) {
        drop(i, less[i].model, verdict);
        return false;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Active& effect = fit_.model.effects[i];
      double touched = 0.0;
      for (const auto& score : earlier_[i])
        if (score.hypothesis == effect.hypothesis) touched = std::max(1.0, score.touched);
      const double share = std::clamp(verdicts[i].gain / (verdicts[i].gain + std::min(touched, fit_.cost)), 0.0, 1.0);
      Found found{effect,        verdicts[i].gain,   share, verdicts[i].strength, chances_[i], {},
                  everywhere[i], verdicts[i].far_off};
      if (exchange(i, less[i], verdicts[i].gain, found)) return false;
      result.found.push_back(std::move(found));
    }
    return true;
  }

  const Fitter& fitter_;
  const Bar& bar_;
  const std::function<void(std::string_view)>& progress_;
  Whitening whitening_;
  Fit fit_;
  std::map<std::size_t, Fit> lacking_;                      ///< of fit_, by effect
  std::map<const Hypothesis*, std::vector<double>> sound_;  ///< numbers that were possible
  Screen last_;
  std::vector<double> chances_;
  std::vector<std::vector<Score>> earlier_;  ///< what else was in question when each was added
  std::set<const Hypothesis*> dropped_;      ///< not asked again, so that the search ends
  std::set<const Hypothesis*> gave_way_;     ///< to another: not put back in its place, of two that are nearly one
};

}  // namespace

Found* SearchResult::of(const Hypothesis* hypothesis) {
  const auto own = std::ranges::find(found, hypothesis, [](const Found& one) { return one.effect.hypothesis; });
  return own == found.end() ? nullptr : &*own;
}

SearchResult search(const Fitter& fitter, const Bar& bar, const std::function<void(std::string_view)>& progress) {
  return Search(fitter, bar, progress).run();
}

}  // namespace feedtwin::tools::diagnosis
