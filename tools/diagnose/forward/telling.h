#pragma once
// When one effect more, asked about in closed loop, is told: what a channel must come closer by, or the runs be likelier by.

#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

/// The closed loop with an effect, beside without.
struct Answered {
  double nats = 0.0, deviations = 0.0;  ///< how much likelier the runs are, and beyond the scatter of their stretches
  double nearer_nominal = 0.0;          ///< squared tolerances
  double ratio = 1.0, share = 0.0;      ///< how many times as close a channel comes, and of what was beyond noise
  bool slight = false;                  ///< of a size that the runs alone may tell
};

enum class Telling { nothing, by_channel, by_runs_alone };

/// What a channel's coming closer must bring.
inline constexpr double least_nats_by_channel = 100.0;

/// Does a channel come nearly all of its way? That is no chance, though a stretch or two disagree.
[[nodiscard]] bool all_of_its_way(const Answered& answered);
[[nodiscard]] Telling telling_of(const Hypothesis& hypothesis, const Answered& answered);

}  // namespace feedtwin::tools::diagnosis
