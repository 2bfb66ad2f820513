#pragma once
// A line has one phase in all runs where the runs were started with it, as a trigger does, and otherwise one of its own in
// each. Then a run that was not fitted has a phase that nothing foretells: two numbers are taken from that run itself.

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

/// Do the runs that were fitted agree about the phase?
[[nodiscard]] bool phases_agree(const Active& line);
/// Sine and cosine of the line over all runs that were fitted.
[[nodiscard]] std::complex<double> common_line(const Active& line);
/// The model for runs that it was not fitted to: phases, and states that runs begin with, are theirs.
[[nodiscard]] Candidate for_unseen(const InverseModel& unseen, const Whitening& whitening, const Candidate& fitted);

}  // namespace feedtwin::tools::diagnosis
