#pragma once
// The cascade of the source's controller (Fig. 1; Turbo PMAC): position P, velocity PI with feed-forward, current loop.

#include "controllers/cascade_law.h"
#include "controllers/controller.h"
#include "plant/realtime.h"

namespace feedtwin::controllers {

class Cascade final : public Controller {
 public:
  explicit Cascade(const CascadeGains& gains) noexcept : law_(gains) {}
  [[nodiscard]] double torque_Nm(const Reference& reference, double position_m,
                                 double tick_s) noexcept FEEDTWIN_REALTIME override;
  void reset(double position_m) noexcept FEEDTWIN_REALTIME override;

 private:
  CascadeLaw<double> law_;
};

}  // namespace feedtwin::controllers
