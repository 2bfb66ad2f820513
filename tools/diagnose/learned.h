#pragma once
// What no hypothesis explains: does it repeat over position, speed or time since reversal, and with what force? A table
// learned on some of the runs to learn from and judged on the others in turn, so that a disturbance that never comes back
// teaches nothing, and the held-out runs have no say.

#include <optional>
#include <string>
#include <vector>

#include "tools/diagnose/dropouts.h"
#include "tools/diagnose/fit.h"
#include "tools/diagnose/ringing.h"
#include "tools/diagnose/sweep.h"
#include "tools/diagnose/switching.h"

namespace feedtwin::tools::diagnosis {

struct Learned {
  Where axis = Where::position;
  std::vector<double> points, force_pos_N, force_neg_N;            ///< against positive motion
  std::vector<double> damping_pos_Ns_per_m, damping_neg_Ns_per_m;  ///< times the speed, more; empty: none
  double share_unseen = 0.0;                                       ///< of the remainder on runs that it was not learned from
  double remainder_N = 0.0;                                        ///< RMS of the remainder there
  double low = 0.0, high = 0.0;                                    ///< where most of it acts
  double newton = 1.0;                                             ///< what stands for one on this axis (size_of_axis.h)
  bool on_the_table = false;                                       ///< of what the table's own force sensor shows
  std::optional<Mode> mode;                                        ///< a part that rings, in place of the table
  std::optional<Sweep> sweep;                                      ///< a frequency that runs up or down, likewise
  std::optional<Dropouts> dropouts;                                ///< moments at which the torque fails, likewise
  std::optional<Switching> switching;                              ///< a force that is on or off, likewise
};

/// The axis that explains most of runs that it was not learned from; of a single run, of every other second. Learned from
/// the sum of the forces, or from the table's own where those hold more: a noisy motor hides what acts on the table.
[[nodiscard]] Learned learn_remainder(const InverseModel& model, const Candidate& at);

[[nodiscard]] std::string in_words(const Learned& learned);

/// The plant's own term for it.
void extend(plant::AxisParameters& axis, const Learned& learned);

}  // namespace feedtwin::tools::diagnosis
