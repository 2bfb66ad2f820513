#pragma once
// An effect with a whole number in its law - an order, a flank - is refitted with the number that the screen liked best.
// Rows four samples apart show one order as another; which it is, stretches say that neither was fitted to.

#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// The model with this effect more, at the end; with the one of `more.also` that does clearly better on unseen
/// stretches, where there is one.
/// @param without the fit that does without it, under the same whitening
[[nodiscard]] Fit fit_with_whole_number(const Fitter& fitter, const Fit& without, Score more, const Whitening& whitening,
                                        const Bar& bar, int iterations);

}  // namespace feedtwin::tools::diagnosis
