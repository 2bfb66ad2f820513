#pragma once
// Is a recording fit to learn from? What makes it unusable is an error; what one should know is a remark.

#include <string>
#include <vector>

#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// The shortest run that identification takes.
inline constexpr double shortest_run_s = 0.2;

/// Throws InputError for: too few samples, time unsorted or twice, gaps, another sample rate than `sample_rate_Hz`, a dead
/// (constant) channel.
void check_time_and_life(const Recording& recording, double sample_rate_Hz);

/// Throws InputError where a channel is about 1000 times what the axis and the other channels say it should be.
void check_units(const Recording& recording, const plant::AxisParameters& axis);

/// What one channel looks like.
struct ChannelQuality {
  double lowest = 0.0, highest = 0.0;
  double resolution = 0.0;       ///< smallest step between two samples; 0 where every step is different
  double saturated_share = 0.0;  ///< of the samples, at the extreme values
};

[[nodiscard]] ChannelQuality channel_quality(std::span<const double> values);

/// Sampling jitter, saturation of the command, grid coarser than the encoder's, travel beyond the stroke, columns not used.
[[nodiscard]] std::vector<std::string> recording_remarks(const Recording& recording, const plant::AxisParameters& axis);

}  // namespace feedtwin::tools
