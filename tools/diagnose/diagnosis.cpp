#include "tools/diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/diagnose/by_direction.h"
#include "tools/diagnose/denied.h"
#include "tools/diagnose/denied_numbers.h"
#include "tools/diagnose/fast_lines.h"
#include "tools/diagnose/finding.h"
#include "tools/diagnose/forward/closest.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/most_of_the_way.h"
#include "tools/diagnose/forward/pictures.h"
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
  Diagnosing(const Case& given, const Progress& progress, std::vector<SetupFault> known = {})
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
    finding_ = find(fitter_, forward_, data_.axis, progress_);
    result_.cut_short = finding_.cut_short;
    tell();
    tell_what_is_unknown();
    show();
    if (taken_back_if_denied(result_, finding_.found)) ask_what_was_denied();
    if (left_out_if_of_harm(result_, finding_.found)) tell_the_numbers_alone();
    if (!data_.holdout.empty() && numbers_are_denied(result_)) keep_the_files_numbers();
    plan_next(result_, {data_, forward_, fitter_, finding_.found.whitening, told_}, progress_);
    show_mended(result_.updated, result_.setup);
    result_.summary = summary_of(result_);
    result_.simulated_samples = forward_.simulated_samples();
    return std::move(result_);
  }

 private:
  /// Names, numbers and the axis that holds them.
  void tell() {
    const Fit& fit = finding_.fit;
    for (const auto& one : finding_.found.found) {
      const auto now = std::ranges::find(fit.model.effects, one.effect.hypothesis, &Active::hypothesis);
      if (now == fit.model.effects.end()) continue;
      if (worth_telling(*now, fit.model.axis, data_.axis))
        result_.effects.push_back(named_effect(one, fit, finding_.covariance, model_));
      else
        progress_(fmt::format("{} is of a size that other physics has too: not named", in_words(*now, fit.model.axis)));
    }
    tell_as_one(result_, data_.fit.front().duration_s());
    if (auto difference = finding_.unknown ? std::nullopt : difference_by_direction(fitter_, fit, finding_.covariance))
      result_.effects.push_back(std::move(*difference));
    if (!finding_.unknown) tell_load(result_, fitter_, fit, finding_.covariance);
    result_.recalibrated = recalibrated(fitter_, fit, finding_.covariance);
    if (auto memory = finding_.unknown ? std::nullopt : memory_in_the_bristle(result_, fit))
      result_.effects.push_back(std::move(*memory));
    if (motor_presliding_m(data_.axis) == 0.0) result_.motor_presliding_m = motor_presliding_m(fit.model.axis);
    auto ways = ways_of(fit.model);
    if (result_.effects.empty()) ways.push_back(extended(finding_.found.recalibrated.model)), ways.push_back(data_.axis);
    result_.updated = ways[closest(forward_, ways)].common;
    if (!anything_missing(result_))
      result_.suspects = suspects(fitter_, finding_.found, finding_.by_inverse_model, progress_);
    result_.verdict = verdict_of(result_);
    result_.detection_limit_N = 0.2 * std::max(bar_for(data_.axis).force_N, finding_.found.whitening.residual_rms(0));
    told_ = finding_.unknown ? only_what_the_force_does_not_show(result_, finding_.found, fit.model) : fit.model;
  }

  void tell_what_is_unknown() {
    if (!finding_.unknown && !anything_missing(result_)) result_.unknown_reading = what_stands_out(model_, told_, progress_);
    if (result_.unknown_reading) {
      result_.verdict = "unknown";
      result_.updated = with_reading(forward_, told_, *result_.unknown_reading, result_.updated);
      return result_.suspects.clear();
    }
    Learned learned = learn_remainder(model_, told_);
    if (!finding_.unknown && laws_of_speed_fall_short(result_.effects, learned)) {
      finding_.unknown = true, told_ = only_what_the_force_does_not_show(result_, finding_.found, told_);
      learned = learn_remainder(model_, told_);
    }
    progress_(in_words(learned));
    if (!finding_.unknown && (!repeats(learned) || anything_missing(result_))) return;
    result_.suspects.clear();
    if (result_.effects.empty())
      finding_.found.recalibrated.model = polished_if_closer(forward_, fitter_, finding_.found.recalibrated.model);
    take_as_unknown(learned);
  }

  void take_as_unknown(const Learned& learned) {
    result_.verdict = "unknown";
    result_.unknown = learned;
    if (finding_.unknown) tell_what_no_table_holds(fitter_, told_, *result_.unknown);
    result_.updated = result_.unknown->mode ? with_mode(forward_, fitter_, told_, *result_.unknown)
                                            : with_table(forward_, fitter_, told_, learned);
  }

  /// Figures, pictures and energies on what the fit did not see.
  void show() {
    progress_("figures on what the fit did not see");
    const auto& unseen = data_.holdout.empty() ? data_.fit : data_.holdout;
    const InverseModel held_out(make_tracks(unseen, data_.axis, as_read_), data_.axis);
    const Candidate told_unseen = for_unseen(held_out, finding_.found.whitening, told_);
    forward_.learn_meter_noise(with_phases_of(told_, result_.updated));
    ForwardModel simulated(unseen, data_);
    simulated.take_meter_from(forward_);
    const Candidate& recalibrated_only = finding_.found.recalibrated.model;
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
    told_ = finding_.found.recalibrated.model;
    finding_.unknown = is_unknown(forward_, fitter_, finding_.found, told_, progress_);
    if (finding_.unknown) take_as_unknown(learn_remainder(model_, told_));
    tell_the_numbers_alone();
  }

  void tell_the_numbers_alone() {
    told_ = finding_.found.recalibrated.model;
    result_.recalibrated =
        recalibrated(fitter_, finding_.found.recalibrated, covariance_by_what_is_left(model_, finding_.found.recalibrated));
    if (result_.motor_presliding_m > 0.0) result_.motor_presliding_m = motor_presliding_m(told_.axis);
    show();
  }

  /// Recalibrated numbers that bring no unseen run closer stand for something else, or for chance.
  void keep_the_files_numbers() {
    const Diagnosis as_recalibrated = result_;
    const Candidate told = std::exchange(told_, only_told(told_, result_.effects));
    told_.axis = data_.axis;
    if (numbers_stand_for_the_unknown(result_)) {
      result_.suspects.clear();
      result_.verdict = "unknown";
      result_.unknown = learn_remainder(model_, told);
    }
    take_the_files_numbers(result_, extended(told_).common);
    show();
    if (still_denied(result_)) result_ = as_recalibrated, told_ = told;
  }

  const Progress& progress_;
  Diagnosis result_;
  Case data_;
  const TrackSettings as_read_;
  const InverseModel model_;
  Fitter fitter_;
  ForwardModel forward_;
  Finding finding_;
  Candidate told_;  ///< what is told of it
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
