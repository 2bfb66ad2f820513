#pragma once
// What a channel shows and the axis does not do, as a table that the plant can run (plant/effects/learned_reading.h,
// learned_command.h): over what is read, position, velocity or time, judged on seconds - by the clock: on
// runs - that it was not learned from.

#include <optional>
#include <string_view>
#include <vector>

#include "plant/parameters.h"
#include "tools/diagnose/reading_rows.h"

namespace feedtwin::tools::diagnosis {

struct LearnedReading {
  std::string_view channel;
  Follows over = Follows::reading;    ///< reading, place, speed or time
  double period = 0.0;                ///< in the points' unit; 0: none
  std::vector<double> points, added;  ///< added to what is true, for a command to what is told; in the channel's unit
  double share_unseen = 0.0;          ///< of the misfit, where it was not learned
};

/// The best of the tables; none where all are of no use where they were not learned.
/// @param misfit what the channel shows more than the model, row by row, in the rows' unit
/// @param step,cycle_s after which it comes over and over; 0: it does not
[[nodiscard]] std::optional<LearnedReading> learn_reading(const ReadingRows& rows, const Vector& misfit, double step,
                                                          double cycle_s);

/// The plant's own term for it.
void extend(plant::AxisParameters& axis, const LearnedReading& learned);

}  // namespace feedtwin::tools::diagnosis
