#pragma once
// What takes the controller's place where a record names none: it follows the recorded motion tightly.
//
//   u = u_recorded + (K_p e + K_d de/dt) p_b / 2 pi,   e = q_recorded - q_simulated
//   K_p = M omega^2,  K_d = 2 zeta M omega,  de/dt through a first-order low-pass at `filter_rad_per_s`
//
// With the right model e is what the encoder rounds away, and u the recorded command; any missing or wrong force shows in
// u - u_recorded, seen through a closed loop of bandwidth omega. It also keeps the simulation beside the record from sample
// to sample, which is what multiple shooting is for: there is nothing to start again from.

namespace feedtwin::tools {

struct StandInSettings {
  double bandwidth_rad_per_s = 150.0;
  double damping_ratio = 0.9;
  double filter_rad_per_s = 1000.0;
};

template <class Real>
class StandIn {
 public:
  StandIn(const StandInSettings& settings, double mass_kg, double tick_s) noexcept
      : proportional_N_per_m_(mass_kg * settings.bandwidth_rad_per_s * settings.bandwidth_rad_per_s),
        derivative_Ns_per_m_(2.0 * settings.damping_ratio * mass_kg * settings.bandwidth_rad_per_s),
        share_(settings.filter_rad_per_s * tick_s / (1.0 + settings.filter_rad_per_s * tick_s)),
        per_tick_Hz_(1.0 / tick_s) {}

  /// Force to add to the recorded command. Wait-free.
  [[nodiscard]] Real correction_N(Real error_m) noexcept {
    rate_m_per_s_ += ((error_m - last_error_m_) * per_tick_Hz_ - rate_m_per_s_) * share_;
    last_error_m_ = error_m;
    return error_m * proportional_N_per_m_ + rate_m_per_s_ * derivative_Ns_per_m_;
  }
  [[nodiscard]] double proportional_N_per_m() const noexcept { return proportional_N_per_m_; }

 private:
  double proportional_N_per_m_, derivative_Ns_per_m_, share_, per_tick_Hz_;
  Real last_error_m_{}, rate_m_per_s_{};
};

}  // namespace feedtwin::tools
