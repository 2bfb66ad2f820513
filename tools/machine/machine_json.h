#pragma once
// The machine verb's numbers as JSON, and as text for the terminal.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/machine/machine_run.h"
#include "tools/machine/sweep.h"

namespace feedtwin::tools {

/// By component and by group, J.
[[nodiscard]] nlohmann::json machine_energy_json(const plant::MachineEnergy& energy);
[[nodiscard]] nlohmann::json to_json(const MachineTotals& result);
[[nodiscard]] nlohmann::json to_json(const SpecificEnergyFit& fit);
[[nodiscard]] nlohmann::json to_json(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points);

void print(const std::string& name, const MachineResult& result);
/// Two results side by side, component by component, in joules and seconds.
void print_comparison(const std::string& name_a, const MachineResult& a, const std::string& name_b, const MachineResult& b);

}  // namespace feedtwin::tools
