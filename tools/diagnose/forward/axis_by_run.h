#pragma once
// An axis that is the same in every run but for the phases of its lines: no run starts when the floor does.

#include <algorithm>
#include <utility>
#include <vector>

#include "plant/parameters.h"

namespace feedtwin::tools::diagnosis {

struct AxisByRun {
  AxisByRun(plant::AxisParameters axis) : common(std::move(axis)) {}  // NOLINT(google-explicit-constructor): the usual case

  plant::AxisParameters common;             ///< as it is handed on: the phase that the runs share, or their mean
  std::vector<plant::AxisParameters> runs;  ///< empty where they do not differ; else any further run is as the last

  [[nodiscard]] const plant::AxisParameters& of(std::size_t run) const {
    return runs.empty() ? common : runs[std::min(run, runs.size() - 1)];
  }
};

}  // namespace feedtwin::tools::diagnosis
