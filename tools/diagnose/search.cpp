#include "tools/diagnose/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "tools/diagnose/exchange.h"
#include "tools/diagnose/judge.h"
#include "tools/diagnose/preferred.h"
#include "tools/diagnose/strikes.h"
#include "tools/diagnose/whole_number.h"
#include "tools/diagnose/wider_stribeck.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr int rounds = 3;
/// Of the best hypotheses that are refitted; of which none is enough.
constexpr std::size_t refitted = 4, refitted_for_one = 10;

/// That the numbers are as far off as they would have to be without it, for any of the hypotheses.
double chance_by_numbers(const Verdict& verdict) {
  return std::min(1.0, std::exp(-0.5 * verdict.surprise) * static_cast<double>(hypotheses().size()));
}

/// What is known of a name stays, with its numbers as they are now.
Found as_known(Found known, const Found& now) {
  known.effect = now.effect, known.gain = now.gain, known.strength = now.strength;
  return known;
}

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
    if (const auto wider = with_wider_stribeck(fitter_, fit_, whitening_, progress_)) take(wider->model, rounds);
    result.recalibrated = fit_;
    if (!try_what_strikes(fitter_.linearised(nominal, of_nominal), of_nominal)) try_what_strikes(fit_, whitening_);
    add_and_drop();
    return told(std::move(result));
  }

  std::optional<SearchResult> run_on(SearchResult before, const Fit& now, const std::set<const Hypothesis*>& not_these) {
    whitening_ = before.whitening, dropped_ = gave_way_ = not_these;
    fit_ = fitter_.fit(now.model, whitening_, refit_iterations);
    for (const Active& effect : fit_.model.effects) {
      const Found* known = before.of(effect.hypothesis);
      chances_.push_back(known == nullptr ? 1.0 : known->p_false_alarm);
      if (known != nullptr && known->by_closed_loop) vouched_for_.insert(effect.hypothesis);
    }
    earlier_.resize(chances_.size());
    if (!add_and_drop()) return std::nullopt;
    SearchResult result = told({before.recalibrated, {}, {}, {}, {}});
    for (Found& one : result.found)
      if (const Found* known = before.of(one.effect.hypothesis)) one = as_known(*known, one);
    return result;
  }

 private:
  /// True where a name came.
  bool add_and_drop() {
    bool any = false;
    for (std::size_t step = 0; step < 3 * bar_.most_effects; ++step) {
      progress_(fmt::format("asking {} hypotheses about the residual", hypotheses().size()));
      last_ = screen(fitter_, fit_, whitening_);
      progress_(in_words(last_));
      if (fit_.model.effects.size() >= bar_.most_effects || !add_best()) break;
      any = true;
      drop_needless();
    }
    drop_needless();
    return any;
  }

  SearchResult told(SearchResult result) {
    confirm(result);
    result.final = fit_;
    result.whitening = whitening_;
    result.last = last_;
    return result;
  }

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

  bool try_what_strikes(const Fit& before, const Whitening& colour) {
    auto struck = what_strikes(fitter_, before, colour, fit_, whitening_, progress_);
    if (!struck) return false;
    const Hypothesis& striking = *struck->fit.model.effects.front().hypothesis;
    chances_.push_back(chance_by_numbers(judged(fitter_, struck->fit, fit_, striking, bar_)));
    earlier_.push_back(std::move(struck->scores));
    take(struck->fit.model, rounds);
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
      if (by_chance) p = chance_by_numbers(verdict);
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
        if (vouched_for_.contains(active.hypothesis)) continue;
        const Fit& other = lacking(i);
        const auto verdict = judged(fitter_, fit_, other, *active.hypothesis, bar_);
        const bool needed = verdict.enough && possible(active, fit_.model.axis);
        if (needed || verdict.gain > least) continue;
        least = verdict.gain, weakest = i, less = other.model, why = verdict, again = true;
      }
      if (again) drop(weakest, less, why);
    }
  }

  /// Puts a better one in an effect's place where there is one; notes those that fit as well.
  bool exchange(std::size_t i, const Fit& less, double gain, std::vector<const Hypothesis*>& rivals) {
    const auto* named = fit_.model.effects[i].hypothesis;
    const Placed placed{fit_, less, i, gain, earlier_[i]};
    const auto better = exchanged(fitter_, bar_, whitening_, placed, last_, gave_way_, rivals);
    if (!better) return false;
    progress_(fmt::format("{} in place of {}", better->by->hypothesis->id, named->id));
    dropped_.insert(named);
    gave_way_.insert(named);
    chances_[i] = last_.p_false_alarm(better->by->standard);
    take(better->model);
    return true;
  }

  /// The last question to each: does it hold on stretches that it was not fitted to, and could another stand for it?
  void confirm(SearchResult& result) {
    while (!settled(result)) result.found.clear();
    std::ranges::stable_sort(result.found, [](const Found& a, const Found& b) { return a.gain > b.gain; });
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
      if (vouched_for_.contains(effect.hypothesis)) continue;
      const auto& verdict = verdicts[i];
      const Unseen unseen = on_unseen(fitter_.model(), fit_, less[i], *effect.hypothesis, verdict, bar_);
      progress_(fmt::format("{}: gain {:.0f}, on unseen folds {:.0f} in {} of {}, surprise {:.0f}, strength {:.2f}",
                            effect.hypothesis->id, verdict.gain, unseen.gain, unseen.folds, bar_.folds, verdict.surprise,
                            verdict.strength));
      everywhere[i] = unseen.everywhere;
      const bool hidden = hidden_beside(share_beside(fitter_.model(), fit_, less, i, bar_), verdict, unseen, bar_);
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
      if (exchange(i, less[i], verdicts[i].gain, found.rivals)) return false;
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
  std::set<const Hypothesis*> vouched_for_;  ///< by the closed loop, which alone asked for it: the inverse model has no say
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

std::optional<SearchResult> search_on(const Fitter& fitter, const Bar& bar, const SearchResult& before, const Fit& now,
                                      const std::set<const Hypothesis*>& not_these,
                                      const std::function<void(std::string_view)>& progress) {
  return Search(fitter, bar, progress).run_on(before, now, not_these);
}

}  // namespace feedtwin::tools::diagnosis
