#pragma once
// What the source's Figs. 7-9 and 11 show, as figures in the verb's JSON (tools/report/figure.h); `feedtwin report` draws
// them.

#include <string>
#include <vector>

#include "tools/machine/machine_run.h"
#include "tools/machine/sweep.h"
#include "tools/report/figure.h"

namespace feedtwin::tools {

/// Position, cutting force, contour error, power and energy over time. @param prefix goes before each title
[[nodiscard]] std::vector<Figure> machine_figures(const MachineResult& result, const std::string& prefix = "");

/// Specific energy over removal rate with its fit; empty where nothing was removed.
[[nodiscard]] std::vector<Figure> sweep_figures(const std::vector<SweepPoint>& points, const SpecificEnergyFit& fit);

}  // namespace feedtwin::tools
