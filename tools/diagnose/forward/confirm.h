#pragma once
// Two engines must agree: an effect that the inverse model asked for is named only if the closed-loop simulation of runs
// that were not fitted comes closer to the recording with it than with the best model without it.

#include <functional>
#include <string_view>

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

struct Confirmation {
  std::string channel;       ///< that the effect helps most
  double error_ratio = 1.0;  ///< error without it over error with it, in that channel
  Fit without;               ///< the best model without it, by the inverse model
};

/// @param forward runs to judge by
/// @param model fitted by the inverse model, the effect among others in it
[[nodiscard]] Confirmation confirm(const ForwardModel& forward, const Fitter& fitter, const Whitening& whitening,
                                   const Candidate& model, std::size_t effect);

/// Drops what the second engine does not bear out. Numbers of the model are told by how far the others would have to move.
/// Nor is asked what the closed loop itself has named.
void keep_confirmed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit,
                    const std::function<void(std::string_view)>& progress);

/// Of what the inverse model's numbers do not miss: may both be polished, and asked again?
[[nodiscard]] bool asked_once_polished(const Found& named);

}  // namespace feedtwin::tools::diagnosis
