#pragma once
// How well a simulated channel follows a recorded one.

#include <span>
#include <vector>

namespace feedtwin::tools {

/// y recorded, s simulated, in the channel's unit where not said otherwise.
struct ChannelMetrics {
  double peak = 0.0;         ///< max |y - s|
  double rms = 0.0;          ///< of y - s
  double rel_error = 0.0;    ///< |y - s| / |y|, 2-norms over the run
  double nrmse = 0.0;        ///< |y - s| / |y - mean y|
  double correlation = 0.0;  ///< of y and s, without their means
  double delay_s = 0.0;      ///< by which s comes late; 0 where the correlation has no peak nearby
  double recorded_peak = 0.0, recorded_rms = 0.0;
  std::size_t samples = 0;
};

/// @param sample_s for the delay; 0: not asked for
[[nodiscard]] ChannelMetrics channel_metrics(std::span<const double> recorded, std::span<const double> simulated,
                                             double sample_s);

/// One figure for several runs of the same channel: norms over all of them, delay and correlation weighed by their samples.
[[nodiscard]] ChannelMetrics pooled(std::span<const ChannelMetrics> runs);

}  // namespace feedtwin::tools
