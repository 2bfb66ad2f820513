#pragma once
// What is told where the catalogue does not reach: no name that rests on the force, and a table of what repeats.

#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/structure.h"

namespace feedtwin::tools::diagnosis {

/// Takes back the names that rest on the force; what is left of the model.
[[nodiscard]] Candidate only_what_the_force_does_not_show(Diagnosis& result, const SearchResult& found,
                                                          const Candidate& final);

/// Is it more than a table of use: a finding of its own?
[[nodiscard]] bool repeats(const Learned& learned);

/// Two laws of speed that together leave a table over speed are no law of it: a third is.
[[nodiscard]] bool laws_of_speed_fall_short(const std::vector<NamedEffect>& named, const Learned& learned);

/// Where a part that rings is most of it, it acts at that part's frequency, where a frequency runs up or down, along that,
/// and where the torque fails for moments or a force is on or off, at these.
void tell_what_no_table_holds(const Fitter& fitter, const Candidate& told, Learned& learned);

/// The model as the closed loop has its numbers, with the table where that brings the runs of the fit closer; without one
/// that is of no use.
[[nodiscard]] plant::AxisParameters with_table(const ForwardModel& forward, const Fitter& fitter, const Candidate& told,
                                               const Learned& learned);

/// The axis with the table of what a channel shows, where that brings the runs of the fit closer.
[[nodiscard]] plant::AxisParameters with_reading(const ForwardModel& forward, const Candidate& told,
                                                 ReadingStructure& reading, const plant::AxisParameters& axis);

}  // namespace feedtwin::tools::diagnosis
