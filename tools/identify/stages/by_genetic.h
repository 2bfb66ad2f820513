#pragma once
// Stages (c) and (d) as the source does them: the same curves, every parameter searched for by its genetic algorithm,
// nothing in closed form. The reference that the projected fits are measured against.

#include "tools/identify/population/genetic.h"
#include "tools/identify/stages/hysteresis.h"
#include "tools/identify/stages/stribeck_curve.h"

namespace feedtwin::tools {

[[nodiscard]] std::optional<StribeckFit> fit_stribeck_curve_by_genetic(const StribeckCurve& curve,
                                                                       const GeneticSettings& settings = {});

/// Within a factor of 30 either way of the friction's stiffness and damping.
[[nodiscard]] std::optional<HysteresisFit> fit_hysteresis_by_genetic(std::span<const ComponentForces> runs,
                                                                     std::vector<double> ComponentForces::* component,
                                                                     double mass_kg, const plant::LugreParameters& friction,
                                                                     const GeneticSettings& settings = {});

}  // namespace feedtwin::tools
