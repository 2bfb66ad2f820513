#pragma once
// A position controller of one axis: reference and measured position in, torque command out, once a tick.

#include "controllers/reference.h"

namespace feedtwin::controllers {

class Controller {
 public:
  virtual ~Controller() = default;
  /// Wait-free. @param position_m as the encoder gives it; @param tick_s since the last call
  [[nodiscard]] virtual double torque_Nm(const Reference& reference, double position_m, double tick_s) noexcept = 0;
  /// Start afresh from this position.
  virtual void reset(double position_m) noexcept = 0;
};

}  // namespace feedtwin::controllers
