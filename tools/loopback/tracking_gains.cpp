#include "tools/loopback/tracking_gains.h"

#include "plant/axis_model.h"
#include "tools/identify/stand_in.h"
#include "tools/loopback/recorded_path.h"

namespace feedtwin::tools {

controllers::CascadeGains tracking_gains(const plant::AxisParameters& axis) {
  const double mass_kg = plant::make_axis_model(axis).mass_kg;
  controllers::CascadeGains gains;
  gains.position_per_s = 60.0;
  gains.velocity_Ns_per_m = 120.0 * mass_kg;
  gains.velocity_integral_N_per_m = 120.0 * 100.0 * mass_kg;
  gains.velocity_feedforward = 1.0;
  gains.acceleration_feedforward_kg = mass_kg;
  gains.torque_limit_Nm = axis.axis.torque_limit_Nm;
  gains.lead_m = axis.axis.lead_m;
  return gains;
}

controllers::CascadeGains stand_in_gains(const plant::AxisParameters& axis) {
  const StandInSettings like;
  controllers::CascadeGains gains = tracking_gains(axis);
  gains.position_per_s = 0.5 * like.bandwidth_rad_per_s / like.damping_ratio;
  gains.velocity_Ns_per_m = 2.0 * like.damping_ratio * like.bandwidth_rad_per_s * plant::make_axis_model(axis).mass_kg;
  gains.velocity_integral_N_per_m = 0.0;
  gains.acceleration_feedforward_kg = 0.0;
  gains.velocity_window_samples = stand_in_window_samples;
  return gains;
}

}  // namespace feedtwin::tools
