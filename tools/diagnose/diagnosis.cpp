#include "tools/diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/diagnose/by_direction.h"
#include "tools/diagnose/denied.h"
#include "tools/diagnose/fast_lines.h"
#include "tools/diagnose/forward/arbiter.h"
#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/confirm.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/gain_in_numbers.h"
#include "tools/diagnose/forward/hidden.h"
#include "tools/diagnose/forward/missed.h"
#include "tools/diagnose/forward/most_of_the_way.h"
#include "tools/diagnose/forward/pictures.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/diagnose/forward/second_look.h"
#include "tools/diagnose/forward/setting_in.h"
#include "tools/diagnose/forward/sizes.h"
#include "tools/diagnose/forward/stiffness.h"
#include "tools/diagnose/forward/with_mode.h"
#include "tools/diagnose/holdout.h"
#include "tools/diagnose/judge.h"
#include "tools/diagnose/lead_by_numbers.h"
#include "tools/diagnose/lead_by_torque.h"
#include "tools/diagnose/mended_case.h"
#include "tools/diagnose/motor_friction.h"
#include "tools/diagnose/next_move.h"
#include "tools/diagnose/own_phase.h"
#include "tools/diagnose/payload_in_mass.h"
#include "tools/diagnose/reported.h"
#include "tools/diagnose/screen.h"
#include "tools/diagnose/sentence.h"
#include "tools/diagnose/soft_contact.h"
#include "tools/diagnose/told_as_one.h"
#include "tools/diagnose/unknown.h"
#include "tools/diagnose/verdict.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// A diagnosis on its way: both engines, what is found, what is told.
class Diagnosing {
 public:
  /// @param known faults that the case no longer has
  Diagnosing(const Case& given, const std::function<void(std::string_view)>& progress, std::vector<SetupFault> known = {})
      : progress_(progress),
        data_(mended(given, result_.setup, progress)),
        as_read_(track_settings(data_, progress)),
        model_(make_tracks(data_.fit, data_.axis, as_read_), data_.axis),
        fitter_(model_, data_.axis),
        forward_(data_.fit, data_) {
    note_reading(data_, as_read_.jump_shares);
    for (auto& fault : known) result_.setup.push_back(std::move(fault));
    result_.power_of_command = model_.tracks().front().meter.of_command;
  }

  Diagnosis run() {
    explain();
    result_.cut_short = forward_.spent();
    polish_numbers();
    tell();
    tell_what_is_unknown();
    show();
    if (taken_back_if_denied(result_, found_)) ask_what_was_denied();
    if (left_out_if_of_harm(result_, found_)) tell_the_numbers_alone();
    plan_next(result_, {data_, forward_, fitter_, found_.whitening, told_}, progress_);
    show_mended(result_.updated, result_.setup);
    result_.summary = summary_of(result_);
    result_.simulated_samples = forward_.simulated_samples();
    return std::move(result_);
  }

 private:
  /// What the inverse model asks for and the closed loop bears out.
  void explain() {
    fitter_.take_effects(motor_as_it_sets_in(forward_, fitter_, progress_));
    found_ = search(fitter_, bar_for(data_.axis), progress_);
    fit_ = found_.final;
    settled_ = ask_how_stiff(forward_, fitter_, found_, fit_, progress_);
    search_anew_if_the_motor_sets_in();
    const auto names_before = fit_.model.effects;
    keep_confirmed(forward_, fitter_, found_, fit_, progress_);
    if (settled_ && !same_names(names_before)) settled_ = rule_beside(*settled_, fit_, forward_, fitter_, SlopesOf::anew);
    const auto names_confirmed = fit_.model.effects;
    settled_ = Arbiter(forward_, fitter_, progress_).settle(found_, fit_, std::move(settled_));
    if (!same_names(names_confirmed)) ask_the_others_again();
    unknown_ = is_unknown(forward_, fitter_, found_, fit_.model, progress_);
    if (unknown_) return;
    const auto names_asked = fit_.model.effects;
    forward_.learn_meter_noise(extended(settled_ ? settled_->model : fit_.model));
    if (!same_names(names_before)) found_.last = screen(fitter_, fit_, found_.whitening);
    look_again_at_the_runs();
    if (dropped_what_is_not_missed() && look_again_at_the_runs()) dropped_what_is_not_missed();
    settled_ = ask_for_gain_in_numbers(forward_, fitter_, found_, fit_, std::move(settled_), progress_);
    ask_again_what_is_unknown(names_asked, fit_.model);
  }

  /// A name that went may have stood for what none of the catalogue is.
  void ask_again_what_is_unknown(const std::vector<Active>& asked, const Candidate& now) {
    const auto gone = [&](const Active& then) { return !has(now, *then.hypothesis); };
    if (std::ranges::any_of(asked, gone)) unknown_ = is_unknown(forward_, fitter_, found_, now, progress_);
  }

  /// What went may have hidden another.
  bool dropped_what_is_not_missed() {
    if (!settled_) return false;
    const auto names_then = fit_.model.effects;
    keep_missed(forward_, fitter_, found_, fit_, *settled_, progress_);
    if (same_names(names_then)) return false;
    if (name_what_they_hid(names_then, forward_, fitter_, found_, fit_, progress_)) {
      settled_ = rule_beside(*settled_, fit_, forward_, fitter_, SlopesOf::anew);
      keep_missed(forward_, fitter_, found_, fit_, *settled_, progress_);
    }
    found_.last = screen(fitter_, fit_, found_.whitening);
    return true;
  }

  /// Where the motor's friction sets in over a path, what was found without it stood for that path about every reversal.
  void search_anew_if_the_motor_sets_in() {
    const bool known = motor_presliding_m(fit_.model.axis) > 0.0;
    settled_ = ask_how_motor_sets_in(forward_, fitter_, found_, fit_, std::move(settled_), progress_);
    if (known || motor_presliding_m(fit_.model.axis) == 0.0) return;
    fitter_.take_effects(fit_.model.axis.effects);
    found_ = search(fitter_, bar_for(data_.axis), progress_);
    fit_ = found_.final;
    settled_ = ask_how_stiff(forward_, fitter_, found_, fit_, progress_);
  }

  [[nodiscard]] bool same_names(const std::vector<Active>& as) const {
    return std::ranges::equal(as, fit_.model.effects, {}, &Active::hypothesis, &Active::hypothesis);
  }

  /// Is there a name more?
  bool look_again_at_the_runs() {
    const std::size_t seen_before = found_.found.size();
    settled_ = look_again(forward_, fitter_, found_, fit_, settled_, progress_);
    const bool more = found_.found.size() > seen_before;
    if (more) ask_the_others_again();
    return more;
  }

  /// What was named in place of a name that came later goes. A name that the closed loop gave may leave the inverse model
  /// with numbers that simulate nothing well; by those no other can be judged.
  void ask_the_others_again() {
    if (settled_ && is_far_behind(forward_, fit_.model, settled_->model)) return;
    const std::size_t before = fit_.model.effects.size();
    keep_confirmed(forward_, fitter_, found_, fit_, progress_);
    if (fit_.model.effects.size() < before) settled_ = rule_beside(*settled_, fit_, forward_, fitter_, SlopesOf::anew);
  }

  void polish_numbers() {
    covariance_ = covariance_by_what_is_left(model_, fit_);
    by_inverse_model_ = fit_;
    progress_("polishing the numbers by closed-loop simulation");
    if (!unknown_) take_polished(polish_settled(settled_, fit_.model, forward_, fitter_));
    found_.recalibrated.model =
        fit_.model.effects.empty() ? fit_.model : polished_if_closer(forward_, fitter_, found_.recalibrated.model);
  }

  void take_polished(const Polished& polished) {
    if (is_better(forward_, polished.model, fit_.model)) {
      fit_.model = polished.model;
      covariance_ = with_what_only_inverse_tells(polished.covariance, covariance_, polished.model, fit_.base_count());
    }
    const auto named = fit_.model.effects;
    drop_sizeless(forward_, fitter_, by_inverse_model_.model, found_, fit_, covariance_, progress_);
    if (fit_.model.effects.size() == named.size()) return;
    Candidate left = by_inverse_model_.model;
    std::erase_if(left.effects, [&](const Active& then) { return !has(fit_.model, *then.hypothesis); });
    ask_again_what_is_unknown(named, fitter_.fit(left, found_.whitening, refit_iterations).model);
    fit_.model = polished_if_closer(forward_, fitter_, fit_.model);
    drop_sizeless(forward_, fitter_, by_inverse_model_.model, found_, fit_, covariance_, progress_);
  }

  /// Names, numbers and the axis that holds them.
  void tell() {
    for (const auto& one : found_.found) {
      const auto now = std::ranges::find(fit_.model.effects, one.effect.hypothesis, &Active::hypothesis);
      if (now == fit_.model.effects.end()) continue;
      if (worth_telling(*now, fit_.model.axis, data_.axis))
        result_.effects.push_back(named_effect(one, fit_, covariance_, model_));
      else
        progress_(fmt::format("{} is of a size that other physics has too: not named", in_words(*now, fit_.model.axis)));
    }
    tell_as_one(result_, data_.fit.front().duration_s());
    if (auto difference = unknown_ ? std::nullopt : difference_by_direction(fitter_, fit_, covariance_))
      result_.effects.push_back(std::move(*difference));
    if (!unknown_) tell_load(result_, fitter_, fit_, covariance_);
    result_.recalibrated = recalibrated(fitter_, fit_, covariance_);
    if (auto memory = unknown_ ? std::nullopt : memory_in_the_bristle(result_, fit_))
      result_.effects.push_back(std::move(*memory));
    if (motor_presliding_m(data_.axis) == 0.0) result_.motor_presliding_m = motor_presliding_m(fit_.model.axis);
    auto ways = ways_of(fit_.model);
    if (result_.effects.empty()) ways.push_back(extended(found_.recalibrated.model)), ways.push_back(data_.axis);
    result_.updated = ways[closest(forward_, ways)].common;
    if (!anything_missing(result_)) result_.suspects = suspects(fitter_, found_, by_inverse_model_, progress_);
    result_.verdict = verdict_of(result_);
    result_.detection_limit_N = 0.2 * std::max(bar_for(data_.axis).force_N, found_.whitening.residual_rms(0));
    told_ = unknown_ ? only_what_the_force_does_not_show(result_, found_, fit_.model) : fit_.model;
  }

  void tell_what_is_unknown() {
    if (!unknown_ && !anything_missing(result_)) result_.unknown_reading = what_stands_out(model_, told_, progress_);
    if (result_.unknown_reading) {
      result_.verdict = "unknown";
      result_.updated = with_reading(forward_, told_, *result_.unknown_reading, result_.updated);
      return result_.suspects.clear();
    }
    Learned learned = learn_remainder(model_, told_);
    if (!unknown_ && laws_of_speed_fall_short(result_.effects, learned)) {
      unknown_ = true, told_ = only_what_the_force_does_not_show(result_, found_, told_);
      learned = learn_remainder(model_, told_);
    }
    progress_(in_words(learned));
    if (!unknown_ && (!repeats(learned) || anything_missing(result_))) return;
    result_.suspects.clear();
    if (result_.effects.empty())
      found_.recalibrated.model = polished_if_closer(forward_, fitter_, found_.recalibrated.model);
    take_as_unknown(learned);
  }

  void take_as_unknown(const Learned& learned) {
    result_.verdict = "unknown";
    result_.unknown = learned;
    if (unknown_) tell_its_frequency(fitter_, told_, *result_.unknown);
    result_.updated = result_.unknown->mode ? with_mode(forward_, fitter_, told_, *result_.unknown)
                                            : with_table(forward_, fitter_, told_, learned);
  }

  /// Figures, pictures and energies on what the fit did not see.
  void show() {
    progress_("figures on what the fit did not see");
    const auto& unseen = data_.holdout.empty() ? data_.fit : data_.holdout;
    const InverseModel held_out(make_tracks(unseen, data_.axis, as_read_), data_.axis);
    const Candidate told_unseen = for_unseen(held_out, found_.whitening, told_);
    forward_.learn_meter_noise(with_phases_of(told_, result_.updated));
    ForwardModel simulated(unseen, data_);
    simulated.take_meter_from(forward_);
    const Candidate& recalibrated_only = found_.recalibrated.model;
    const Candidate given{data_.axis, {}};
    const AxisByRun updated_unseen = with_phases_of(told_unseen, result_.updated);
    const auto as_given = followed(held_out, given), as_recalibrated = followed(held_out, recalibrated_only),
               as_told = followed(held_out, told_unseen);
    result_.holdout_inverse = figures(as_given, as_recalibrated, as_told);
    result_.force_error = force_errors(as_given, as_recalibrated, as_told);
    result_.holdout = figures(simulated, data_.axis, extended(recalibrated_only), updated_unseen);
    result_.pictures =
        pictures(simulated, held_out.tracks(), {data_.axis, extended(recalibrated_only), updated_unseen}, result_.effects);
    result_.energy_before = energy(as_given);
    result_.energy_after = energy(as_told);
  }

  /// What was named for want of better, and unseen runs deny, may be none of the catalogue.
  void ask_what_was_denied() {
    told_ = found_.recalibrated.model;
    unknown_ = is_unknown(forward_, fitter_, found_, told_, progress_);
    if (unknown_) take_as_unknown(learn_remainder(model_, told_));
    tell_the_numbers_alone();
  }

  void tell_the_numbers_alone() {
    told_ = found_.recalibrated.model;
    result_.recalibrated =
        recalibrated(fitter_, found_.recalibrated, covariance_by_what_is_left(model_, found_.recalibrated));
    if (result_.motor_presliding_m > 0.0) result_.motor_presliding_m = motor_presliding_m(told_.axis);
    show();
  }

  const std::function<void(std::string_view)>& progress_;
  Diagnosis result_;
  Case data_;
  const TrackSettings as_read_;
  const InverseModel model_;
  Fitter fitter_;
  ForwardModel forward_;
  SearchResult found_;
  Fit fit_, by_inverse_model_;
  std::optional<Ruling> settled_;  ///< as the closed loop has it, where it was asked
  Candidate told_;                 ///< what is told of it
  Eigen::MatrixXd covariance_;
  bool unknown_ = false;
};

}  // namespace

Diagnosis diagnose(const Case& given, const std::function<void(std::string_view)>& progress) {
  Diagnosis told = Diagnosing(given, progress).run();
  const auto by_torque = lead_by_torque(told), by_numbers = lead_by_numbers(told);
  const auto& lead = by_torque ? by_torque : by_numbers;
  if (!lead) return told;
  progress(lead->sentence);
  return Diagnosing(with_lead(given, *lead), progress, {*lead}).run();
}

}  // namespace feedtwin::tools::diagnosis
