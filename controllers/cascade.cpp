#include "controllers/cascade.h"

namespace feedtwin::controllers {

void Cascade::reset(double position_m) noexcept FEEDTWIN_REALTIME {
  law_.reset(position_m);
}

double Cascade::torque_Nm(const Reference& reference, double position_m, double tick_s) noexcept FEEDTWIN_REALTIME {
  return law_.torque_Nm(reference, position_m, tick_s);
}

}  // namespace feedtwin::controllers
