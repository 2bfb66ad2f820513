#include "tools/diagnose/finding.h"

#include <algorithm>

#include "tools/diagnose/dropouts.h"
#include "tools/diagnose/forward/arbiter.h"
#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/confirm.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/gain_in_numbers.h"
#include "tools/diagnose/forward/hidden.h"
#include "tools/diagnose/forward/missed.h"
#include "tools/diagnose/forward/most_of_the_way.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/diagnose/forward/second_look.h"
#include "tools/diagnose/forward/setting_in.h"
#include "tools/diagnose/forward/sizes.h"
#include "tools/diagnose/forward/stiffness.h"
#include "tools/diagnose/judge.h"
#include "tools/diagnose/motor_friction.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/screen.h"
#include "tools/diagnose/switching.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Both engines in turn, and what stands at each moment.
class Finder {
 public:
  Finder(Fitter& fitter, ForwardModel& forward, const plant::AxisParameters& given, const Progress& progress)
      : progress_(progress), given_(given), fitter_(fitter), forward_(forward) {}

  Finding run() {
    explain();
    now_.cut_short = forward_.spent();
    polish_numbers();
    return std::move(now_);
  }

 private:
  /// What the inverse model asks for and the closed loop bears out.
  void explain() {
    fitter_.take_effects(motor_as_it_sets_in(forward_, fitter_, progress_));
    now_.found = search(fitter_, bar_for(given_), progress_);
    now_.fit = now_.found.final;
    const Candidate& recalibrated = now_.found.recalibrated.model;
    now_.unknown = torque_fails_for_moments(fitter_.model(), recalibrated, now_.fit.model) ||
                   force_switches(fitter_.model(), recalibrated, now_.fit.model);
    if (now_.unknown) return;
    settled_ = ask_how_stiff(forward_, fitter_, now_.found, now_.fit, progress_);
    search_anew_if_the_motor_sets_in();
    const auto names_before = now_.fit.model.effects;
    keep_confirmed(forward_, fitter_, now_.found, now_.fit, progress_);
    if (settled_ && !same_names(names_before))
      settled_ = rule_beside(*settled_, now_.fit, forward_, fitter_, SlopesOf::anew);
    const auto names_confirmed = now_.fit.model.effects;
    settled_ = Arbiter(forward_, fitter_, progress_).settle(now_.found, now_.fit, std::move(settled_));
    if (!same_names(names_confirmed)) ask_the_others_again();
    now_.unknown = is_unknown(forward_, fitter_, now_.found, now_.fit.model, progress_);
    if (now_.unknown) return;
    const auto names_asked = now_.fit.model.effects;
    forward_.learn_meter_noise(extended(settled_ ? settled_->model : now_.fit.model));
    if (!same_names(names_before)) now_.found.last = screen(fitter_, now_.fit, now_.found.whitening);
    look_again_at_the_runs();
    if (dropped_what_is_not_missed() && look_again_at_the_runs()) dropped_what_is_not_missed();
    settled_ = ask_for_gain_in_numbers(forward_, fitter_, now_.found, now_.fit, std::move(settled_), progress_);
    ask_again_what_is_unknown(names_asked, now_.fit.model);
  }

  /// A name that went may have stood for what none of the catalogue is.
  void ask_again_what_is_unknown(const std::vector<Active>& asked, const Candidate& now) {
    const auto gone = [&](const Active& then) { return !has(now, *then.hypothesis); };
    if (std::ranges::any_of(asked, gone)) now_.unknown = is_unknown(forward_, fitter_, now_.found, now, progress_);
  }

  /// What went may have hidden another.
  bool dropped_what_is_not_missed() {
    if (!settled_) return false;
    const auto names_then = now_.fit.model.effects;
    keep_missed(forward_, fitter_, now_.found, now_.fit, *settled_, progress_);
    if (same_names(names_then)) return false;
    if (name_what_they_hid(names_then, forward_, fitter_, now_.found, now_.fit, progress_)) {
      settled_ = rule_beside(*settled_, now_.fit, forward_, fitter_, SlopesOf::anew);
      keep_missed(forward_, fitter_, now_.found, now_.fit, *settled_, progress_);
    }
    now_.found.last = screen(fitter_, now_.fit, now_.found.whitening);
    return true;
  }

  /// Where the motor's friction sets in over a path, what was found without it stood for that path about every reversal.
  void search_anew_if_the_motor_sets_in() {
    const bool known = motor_presliding_m(now_.fit.model.axis) > 0.0;
    settled_ = ask_how_motor_sets_in(forward_, fitter_, now_.found, now_.fit, std::move(settled_), progress_);
    if (known || motor_presliding_m(now_.fit.model.axis) == 0.0) return;
    fitter_.take_effects(now_.fit.model.axis.effects);
    now_.found = search(fitter_, bar_for(given_), progress_);
    now_.fit = now_.found.final;
    settled_ = ask_how_stiff(forward_, fitter_, now_.found, now_.fit, progress_);
  }

  [[nodiscard]] bool same_names(const std::vector<Active>& as) const {
    return std::ranges::equal(as, now_.fit.model.effects, {}, &Active::hypothesis, &Active::hypothesis);
  }

  /// Is there a name more?
  bool look_again_at_the_runs() {
    const std::size_t seen_before = now_.found.found.size();
    settled_ = look_again(forward_, fitter_, now_.found, now_.fit, settled_, progress_);
    const bool more = now_.found.found.size() > seen_before;
    if (more) ask_the_others_again();
    return more;
  }

  /// What was named in place of a name that came later goes. A name that the closed loop gave may leave the inverse model
  /// with numbers that simulate nothing well; by those no other can be judged.
  void ask_the_others_again() {
    if (settled_ && is_far_behind(forward_, now_.fit.model, settled_->model)) return;
    const std::size_t before = now_.fit.model.effects.size();
    keep_confirmed(forward_, fitter_, now_.found, now_.fit, progress_);
    if (now_.fit.model.effects.size() < before)
      settled_ = rule_beside(*settled_, now_.fit, forward_, fitter_, SlopesOf::anew);
  }

  void polish_numbers() {
    now_.covariance = covariance_by_what_is_left(fitter_.model(), now_.fit);
    now_.by_inverse_model = now_.fit;
    progress_("polishing the numbers by closed-loop simulation");
    if (!now_.unknown) take_polished(polish_settled(settled_, now_.fit.model, forward_, fitter_));
    now_.found.recalibrated.model = now_.fit.model.effects.empty()
                                        ? now_.fit.model
                                        : polished_if_closer(forward_, fitter_, now_.found.recalibrated.model);
  }

  void take_polished(const Polished& polished) {
    if (is_better(forward_, polished.model, now_.fit.model)) {
      now_.fit.model = polished.model;
      now_.covariance =
          with_what_only_inverse_tells(polished.covariance, now_.covariance, polished.model, now_.fit.base_count());
    }
    const auto named = now_.fit.model.effects;
    drop_sizeless(forward_, fitter_, now_.by_inverse_model.model, now_.found, now_.fit, now_.covariance, progress_);
    if (now_.fit.model.effects.size() == named.size()) return;
    Candidate left = now_.by_inverse_model.model;
    std::erase_if(left.effects, [&](const Active& then) { return !has(now_.fit.model, *then.hypothesis); });
    ask_again_what_is_unknown(named, fitter_.fit(left, now_.found.whitening, refit_iterations).model);
    now_.fit.model = polished_if_closer(forward_, fitter_, now_.fit.model);
    drop_sizeless(forward_, fitter_, now_.by_inverse_model.model, now_.found, now_.fit, now_.covariance, progress_);
  }

  const Progress& progress_;
  const plant::AxisParameters& given_;
  Fitter& fitter_;
  ForwardModel& forward_;
  Finding now_;
  std::optional<Ruling> settled_;  ///< as the closed loop has it, where it was asked
};

}  // namespace

Finding find(Fitter& fitter, ForwardModel& forward, const plant::AxisParameters& given, const Progress& progress) {
  return Finder(fitter, forward, given, progress).run();
}

}  // namespace feedtwin::tools::diagnosis
