#pragma once
// Is what a model leaves over still structure? A general additive model of the force remainder - tables over place, speed,
// time since reversal and acceleration, speed-weighted place, the acceleration's past, friction that beats - learned on
// three quarters of the seconds and judged on the fourth, in turn.

#include "tools/diagnose/fit.h"

namespace feedtwin::tools::diagnosis {

struct Structure {
  double remainder_N = 0.0;  ///< rms of the remainder where the axis has settled
  double share = 0.0;        ///< of its square that the additive model predicts on seconds it has not seen; may be negative
  [[nodiscard]] double structured_N() const;
};

[[nodiscard]] Structure remaining_structure(const InverseModel& model, const Candidate& at);

}  // namespace feedtwin::tools::diagnosis
