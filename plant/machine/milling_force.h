#pragma once
// Milling force of an end mill, mean over a tick: Altintas, Manufacturing Automation (2nd ed. 2012), sections 2.7 and 2.8.
//
// On tooth j at the immersion angle phi, over the axial depth dz:
//   h    = dx sin phi + dy cos phi + dr_j          chip thickness, >= 0
//   dF_t = (K_tc h + K_te) dz    dF_r = (K_rc h + K_re) dz    dF_a = (K_ac h + K_ae) dz
//   F_x  = -F_t cos phi - F_r sin phi    F_y = F_t sin phi - F_r cos phi    T = F_t D / 2        on the tool
// x the feed direction, y to its left; (dx, dy) what the tool has moved against the workpiece in one tooth period, dr_j what
// run-out makes this tooth stand further out than the one before it. A helix lags by 2 z tan(beta) / D at the height z.
//
// Teeth pass within a few ticks, so the force is not sampled: over the angle that each tooth turns in the tick the terms are
// integrated in closed form, clipped to where the tooth meets material and the chip is thicker than nothing. Energy is thus
// right at any ratio of tick to tooth period.

#include <array>

#include "plant/machine/engagement.h"
#include "plant/realtime.h"

namespace feedtwin::plant {

/// The cutter.
struct ToolParameters {
  double diameter_m = 4e-3;
  int teeth = 2;
  double helix_rad = 0.0;
  double runout_m = 0.0;  ///< radial offset of the cutter's axis
  double runout_angle_rad = 0.0;
};

/// Cutting (c) and edge (e) coefficients, tangential, radial, axial.
struct CuttingCoefficients {
  double Ktc_N_per_m2 = 0.0, Krc_N_per_m2 = 0.0, Kac_N_per_m2 = 0.0;
  double Kte_N_per_m = 0.0, Kre_N_per_m = 0.0, Kae_N_per_m = 0.0;
};

/// What acts on the tool, mean over a tick.
struct MillingLoad {
  double force_x_N = 0.0, force_y_N = 0.0, force_z_N = 0.0;  ///< in the machine's axes
  double torque_Nm = 0.0;                                    ///< against the spindle's rotation
  double removal_rate_m3_per_s = 0.0;
};

class MillingForce {
 public:
  MillingForce(const ToolParameters& tool, const CuttingCoefficients& coefficients);

  /// The load over a tick in which the tool turns from `angle_rad` by `turn_rad` (both clockwise positive; a negative turn
  /// is counterclockwise) and moves (dx, dy) a tooth period against the workpiece, in the machine's axes.
  /// Wait-free: at most 4 immersions x teeth x discs closed-form pieces.
  [[nodiscard]] MillingLoad over(double angle_rad, double turn_rad, double dx_m, double dy_m,
                                 const Engagement& engagement) const noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] const ToolParameters& tool() const noexcept { return tool_; }
  static constexpr int most_teeth = 16, most_discs = 16;

 private:
  struct Sums {
    double along_N = 0.0, left_N = 0.0, axial_N = 0.0, tangential_N = 0.0;  // integrals over angle
  };
  void add_piece(double from_rad, double to_rad, double ahead_m, double left_m, double stand_out_m, double dz_m,
                 Sums& sums) const noexcept;
  void add_tooth(double phi_rad, double turn_rad, const Immersion& immersion, double ahead_m, double left_m,
                 double stand_out_m, double dz_m, Sums& sums) const noexcept;

  ToolParameters tool_;
  CuttingCoefficients k_;
  std::array<double, most_teeth> stand_out_m_{};
};

}  // namespace feedtwin::plant
