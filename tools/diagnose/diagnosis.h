#pragma once
// The whole of a diagnosis: what was found in a case and how well it is known, ready to be told.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plant/parameters.h"
#include "tools/diagnose/figures.h"
#include "tools/diagnose/learned.h"
#include "tools/diagnose/planning/next_experiment.h"
#include "tools/diagnose/reading_structure.h"
#include "tools/diagnose/search.h"
#include "tools/diagnose/setup_checks.h"
#include "tools/diagnose/suspects.h"
#include "tools/recording/case.h"
#include "tools/report/figure.h"

namespace feedtwin::tools::diagnosis {

struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;  ///< with its 90 % interval
};

struct NamedEffect {
  const Hypothesis* hypothesis = nullptr;
  std::string_view component, channel;  ///< where it acts, and shows
  std::string sentence;
  std::vector<std::pair<std::string, Estimate>> parameters;
  std::vector<std::pair<double, double>> intervals;  ///< where it acts
  double share = 0.0, p_false_alarm = 1.0;
  std::vector<std::string> alternatives;
  bool by_closed_loop = false;   ///< told by the simulated motion: in the inverse model the numbers take it up
  bool by_common_shift = false;  ///< in both models the numbers take it up, all off by the same share
};

struct Recalibrated {
  std::string key;
  double was = 0.0;
  Estimate now;
};

struct ChannelFigures {
  double before = 0.0, recalibrated = 0.0, after = 0.0, floor = 0.0;
  double by_effects = 0.0;  ///< how far the effects move it, the numbers as they are; the inverse model alone says so
};

struct Diagnosis {
  std::string verdict, summary;
  std::vector<SetupFault> setup;
  std::vector<NamedEffect> effects;
  std::optional<Learned> unknown;                   ///< structure that no hypothesis explains
  std::optional<ReadingStructure> unknown_reading;  ///< the same of what a channel shows and the axis does not do
  std::vector<Recalibrated> recalibrated;
  std::map<std::string, ChannelFigures> holdout;          ///< by closed-loop simulation
  std::map<std::string, ChannelFigures> holdout_inverse;  ///< by the inverse model, through its low pass
  ChannelFigures force_error;                             ///< of the inverse model, |f - m| / |f| below 40 Hz; has no floor
  Energy energy_before, energy_after;
  std::vector<Suspect> suspects;  ///< beyond chance, too weak to be named or denied by unseen runs
  double denied_by_unseen = 0.0;  ///< the suspects had been named, but left unseen runs so many times as far off; 0: not so
  double numbers_denied_by_unseen = 0.0;  ///< recalibrated numbers left unseen runs so many times as far off as the file's
  NextExperiment next;
  double detection_limit_N = 0.0;  ///< RMS of the weakest effect that would have been named
  bool cut_short = false;  ///< the closed loop had simulated as much as it may: what it would still have asked is left out
  std::uint64_t simulated_samples = 0;  ///< by the closed loop: what the answer has cost, the same on every machine
  bool power_of_command = false;        ///< the power meter's readings are computed from the command
  double motor_presliding_m = 0.0;      ///< path over which the motor's friction sets in, where it was found; 0: at once
  plant::AxisParameters updated;        ///< recalibrated and extended
  std::vector<Figure> pictures;         ///< where the mismatch lives, before and after, on held-out runs
};

/// @param progress called with what is being done
[[nodiscard]] Diagnosis diagnose(const Case& data, const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
