#pragma once
// Simulation against recording, run by run and channel by channel: closed loop and inverse model apart.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/identify/closed_loop.h"
#include "tools/identify/component_energy.h"
#include "tools/identify/metrics.h"
#include "tools/report/figure.h"

namespace feedtwin::tools {

using MetricsByChannel = std::map<std::string, ChannelMetrics, std::less<>>;

/// Deviation from the reference, as in the paper's Table 3.
struct TrackingError {
  double peak_m = 0.0, rms_m = 0.0;
};

struct RunComparison {
  const Recording* recording = nullptr;
  bool holdout = false;
  MetricsByChannel closed_loop, inverse_model;
  std::optional<TrackingError> tracking_recorded, tracking_simulated;
  ComponentEnergy energy_recorded, energy_simulated;
  Simulated simulated;                                                          ///< power as the record's meter shows it
  std::vector<double> inverse_time_s, inverse_recorded_N, inverse_simulated_N;  ///< after decimation
};

struct CaseComparison {
  std::vector<RunComparison> runs;
  MetricsByChannel closed_loop, inverse_model;  ///< over all runs
};

/// @param axis what is simulated; the case's own, or an identified one
[[nodiscard]] CaseComparison compare_case(const Case& recordings, const plant::AxisParameters& axis);

/// The figures of a comparison (contract of `compare --json`), without the head.
[[nodiscard]] nlohmann::json to_json(const CaseComparison& comparison);
[[nodiscard]] std::vector<Figure> figures_of(const CaseComparison& comparison, const plant::AxisParameters& axis);
/// A table for people.
[[nodiscard]] std::string to_text(const CaseComparison& comparison);

}  // namespace feedtwin::tools
