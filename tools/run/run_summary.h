#pragma once
// What a run of `serve` or `simulate` says at its end: on the terminal and as JSON (contract: serve and simulate).

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plant/feed_axis.h"
#include "plant/machine/machine.h"
#include "rt/plant_loop.h"
#include "rt/rt_setup.h"
#include "rt/run_verdict.h"

namespace feedtwin::tools {

/// Of a run of a whole machine tool.
struct MachineFacts {
  plant::MachineEnergy energy;
  std::optional<double> contour_peak_m;  ///< where the program runs inside
};

struct RunSummary {
  std::string verb, source, controller;
  double tick_s = 1e-3;
  const rt::TickStats* stats = nullptr;
  std::vector<rt::SettingReport> settings;
  rt::RunVerdict verdict;
  std::vector<plant::AxisEnergy> energy;  ///< by axis
  std::optional<MachineFacts> machine;
  std::string parameter_hash;
  std::vector<std::string> files;
};

[[nodiscard]] nlohmann::json to_json(const RunSummary& summary);
/// The same for people, on standard output.
void print(const RunSummary& summary);

/// 16 hexadecimal digits over every parameter of every axis (FNV-1a).
[[nodiscard]] std::string parameter_hash(std::vector<plant::AxisParameters> axes);

}  // namespace feedtwin::tools
