#pragma once
// Stage (a): the electrical loss coefficients of Eq. 7 from the power meter.
//
//   P_M1 = P_I - k v T_C = k_e0 + k_e1 |v| + k_e2 v^2            Eqs. 7, 11; k_e1 and k_e2 by direction
//
// Taken as means over each of the meter's windows, where the law stays linear in its coefficients: constant speeds, as in
// the source's loss-speed curve, are not needed, and a window across a reversal counts too.

#include <optional>
#include <span>
#include <vector>

#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

struct ElectricalLossFit {
  double idle_W = 0.0;
  plant::Directional linear_Ws_per_m, quadratic_Ws2_per_m2;
  double rms_W = 0.0;                                         ///< of what is left
  std::vector<double> velocity_m_per_s, measured_W, model_W;  ///< of the windows that know one direction only
};

/// Nothing where no recording has a power meter, or where the windows do not tell the five apart.
[[nodiscard]] std::optional<ElectricalLossFit> fit_electrical_loss(std::span<const Recording> recordings,
                                                                   const plant::AxisParameters& axis);

}  // namespace feedtwin::tools
