#pragma once
// What the staged procedure found, for people: loss curve, Stribeck curves, hysteresis.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "tools/identify/stages/staged.h"
#include "tools/report/figure.h"

namespace feedtwin::tools {

/// Values by key, and why a stage found nothing.
[[nodiscard]] nlohmann::json to_json(const StagedFit& fit);

/// @param axis whose curves are drawn beside the stages' points: what was identified in the end
[[nodiscard]] std::vector<Figure> figures_of(const StagedFit& fit, std::span<const Recording> recordings,
                                             const plant::AxisParameters& axis);

}  // namespace feedtwin::tools
