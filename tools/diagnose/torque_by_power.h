#pragma once
// What a measured power alone tells of the torque constant, P = k_e0 + k_e1 |v| + k_e2 v^2 + (1 + g) u v with all losses
// free: no friction, mass or sensor has a say in it. Where friction is not the model's, the forces ask for a constant that
// is not.

#include <optional>

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

struct TorqueByPower {
  double relative_error = 0.0, deviation = 0.0;  ///< g
};

/// @param model without the torque constant's error, with what else was named
/// @return nothing without a power that was measured
[[nodiscard]] std::optional<TorqueByPower> torque_by_power(const Fitter& fitter, const Candidate& model);

/// Does the power say clearly otherwise than a torque constant's error that was found?
[[nodiscard]] bool denied_by_power(const Fitter& fitter, const Candidate& model, std::size_t effect);

}  // namespace feedtwin::tools::diagnosis
