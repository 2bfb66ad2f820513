#pragma once
// Does a channel show what the axis does not do? What it shows more than the model, and less than the equation before it
// then has, predicted on seconds that were not learned from: by what is read, by where and how fast the axis runs, by the
// clock. A force that the model lacks is in one of the two equations; what a sensor adds is in both, turned round.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/diagnose/fit.h"
#include "tools/diagnose/learned_reading.h"
#include "tools/diagnose/reading_rows.h"

namespace feedtwin::tools::diagnosis {

struct ReadingStructure {
  std::string_view channel;
  Follows follows = Follows::reading;
  double remainder = 0.0;  ///< rms of the misfit less what numbers could take up, in the channel's unit
  double share = 0.0;      ///< of its square that is predicted on seconds that were not learned from; may be negative
  double every = 0.0;      ///< where it comes over and over: the time, s, or the step of what is read, in the channel's unit
  double per_newton = 0.0;  ///< the channel's unit in what stands for a newton (size_of_axis.h); 0: it is none of force
  double read = 0.0;        ///< rms of what is read, in the channel's unit; 0: that is of another unit
  double of_reading = 1.0;  ///< how much of what is predicted both equations have, turned round; 1: all
  std::optional<LearnedReading> table;  ///< that the plant can run, where it stands out and one is of use
  bool in_plant = false;                ///< the updated axis has it
  [[nodiscard]] double structured() const;
  /// Is it a finding of its own?
  [[nodiscard]] bool stands_out() const;
};

/// Channel by channel: sensors, command, scale, power.
[[nodiscard]] std::vector<ReadingStructure> structure_of_readings(const InverseModel& model, const Candidate& at);

/// The first that stands out, if any does: a sensor, which two equations tell, before the command, which shows in the power
/// too.
[[nodiscard]] std::optional<ReadingStructure> what_stands_out(const InverseModel& model, const Candidate& at,
                                                              const std::function<void(std::string_view)>& progress);

/// As in "72 % of it follows time, every 1.57 s".
[[nodiscard]] std::string what_it_follows(const ReadingStructure& reading);

}  // namespace feedtwin::tools::diagnosis
