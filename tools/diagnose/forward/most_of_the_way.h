#pragma once
// How far names bring the closed loop on its way from the recalibrated numbers to what a model leaves that has made the
// recordings itself.

#include <functional>
#include <string_view>

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// The share of the way, channel by channel: of those that the numbers alone leave off beyond noise.
/// @param without, with, floor errors by the numbers alone, with the names, and of a model on what it made
/// @return their mean; 0 where there is none
[[nodiscard]] double share_of_the_way(const Nrmse& without, const Nrmse& with, const Nrmse& floor);

/// Do names that rest on a force go about half of it or more? Structure that they leave is then what their law simplifies,
/// or the contact beside them, and none of the unknown. A load's friction on a contact of eight elements went 0.55 of it and
/// left 0.38 N of 0.6 N; false names, of ten in 48 cases outside the catalogue, 0.32 at most.
/// @param numbers the recalibrated numbers alone
[[nodiscard]] bool names_go_most_of_the_way(const ForwardModel& forward, const Fitter& fitter, const Candidate& numbers,
                                            const Candidate& named, const std::function<void(std::string_view)>& progress);

/// The model without the names that rest on a force, refitted. What it has beside them, as a screw that yields too little to
/// be named, brings the closed loop nearer whatever they are: of the 55 % that a damaged spot and such a screw went where a
/// washboard was hidden, the spot went 8.
[[nodiscard]] Candidate beside_the_names(const Fitter& fitter, const SearchResult& found, const Candidate& model);

/// How many times its noise the worst channel is off by.
[[nodiscard]] double times_noise(const Nrmse& error, const Nrmse& floor);

/// Do the recalibrated numbers alone bring every channel near what they would leave of recordings that they had made? Then
/// nothing is left that a force could make, whatever the inverse model sees, which knows a yielding screw by halves. Of a
/// machine with a weight of 3 N and 78 N/um it was 2.1 times noise at most; of 22 outside the catalogue 5.4 and more.
/// @param numbers the recalibrated numbers alone
[[nodiscard]] bool numbers_reach_noise(const ForwardModel& forward, const Fitter& fitter, const Candidate& numbers,
                                       const std::function<void(std::string_view)>& progress);

/// Is what a model leaves over beyond the catalogue, in the closed loop too, and more than its names do?
[[nodiscard]] bool is_unknown(const ForwardModel& forward, const Fitter& fitter, const SearchResult& found,
                              const Candidate& model, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
