#pragma once
// Shapes that several hypotheses share.

#include <numbers>
#include <vector>

#include "tools/diagnose/hypothesis.h"

namespace feedtwin::tools::diagnosis {

/// `least_deviations` of what the numbers could do, or what any smooth change of friction looks like: of 283 names in seven
/// sets true ones had 16 and more, but for a warm-up of 6; false ones 1.6 to 9.8.
inline constexpr double deviations_of_numbers = 10.0;
/// And of what comes late, as the first moment of any other law's friction does, and all friction on an axis that a large
/// force disturbs: true ones 15 and more, false ones 5 to 13.
inline constexpr double deviations_of_lags = 14.0;

/// 2 pi / lead.
[[nodiscard]] inline double per_lead(const plant::TransmissionParameters& transmission) {
  return 2.0 * std::numbers::pi / transmission.lead_m;
}

/// Of both directions.
[[nodiscard]] inline double mean(const plant::Directional& both) {
  return 0.5 * (both.pos + both.neg);
}

/// What laws of friction change: factors and resistance of the ball screw, or of the guide where the axis says so.
struct OfLaws {
  OfLaws(const View& view, Contribution& sum)
      : sliding(view.laws_on_guide() ? sum.guide_sliding : sum.screw_sliding),
        viscous(view.laws_on_guide() ? sum.guide_viscous : sum.screw_viscous),
        resists_N(view.laws_on_guide() ? sum.guide_N : sum.screw_N) {}
  Vector &sliding, &viscous, &resists_N;
};

/// sine sin(2 pi n x / period) + cosine cos(...)
[[nodiscard]] Vector wave(const Vector& x, double period, double order, double sine, double cosine);
/// What screw and table press on each other with, N: as the force sensor shows it, otherwise as the model has it.
[[nodiscard]] Vector force_on_table(const View& view);
/// Later by a number of samples, which need not be whole; linear between samples. Negative: earlier.
[[nodiscard]] Vector delayed(const Vector& values, double samples);
/// First-order lag of a number of samples.
[[nodiscard]] Vector lagged(const Vector& values, double samples);
/// Does a reading that wavers along each revolution stay next to straight? Its slope varies by less than a tenth; of true
/// ones by up to 0.0087. More is a force of that period that nothing else explains (0.8 was 21 mm of a belt's 168 a turn).
[[nodiscard]] bool wavers_little(double amplitude_m, double cycles_per_rev,
                                 const plant::TransmissionParameters& transmission);
/// Of a delay or a time constant: what it leaves of a step is gone at the next sample (e^-5), and until then a lag takes
/// as much from the mean torque as a delay.
[[nodiscard]] bool gone_within_a_sample(std::span<const double> q, double sample_s);

/// Of the same: less is how two models of one axis differ, in where within a sample friction and torque stand, and what any
/// drive's current loop takes (one of 50 us looked 70 us late).
[[nodiscard]] bool late_beyond_a_model(std::span<const double> q, const plant::AxisParameters& axis);

/// A force that waves with a phase of its own in each of up to four runs: sine and cosine of each run, and how often.
[[nodiscard]] std::vector<WorkingParameter> line_parameters(const WorkingParameter& often);
void add_line(const Track& track, std::span<const double> q, Vector& force_N);
/// How often it waves, cycles a revolution or hertz.
[[nodiscard]] double rate_of_line(std::span<const double> q);
/// Its amplitude and phase in a run, see Hypothesis::line_of.
[[nodiscard]] std::complex<double> line_of_run(std::span<const double> q, std::size_t run);
/// Has this run a line? Of a run that is not there only what differences left.
[[nodiscard]] bool has_line(std::span<const double> q, std::size_t run);
/// Root mean square of the runs' amplitudes.
[[nodiscard]] double line_amplitude(std::span<const double> q);

/// What each of up to four runs begins with, the first one's fixed at none: see Hypothesis::state.
[[nodiscard]] std::vector<WorkingParameter> with_states(std::vector<WorkingParameter> parameters, double step, double lowest,
                                                        double highest);
/// Where a run's stands among the working parameters.
[[nodiscard]] std::size_t state_of_run(std::size_t first_state, std::size_t run);
/// Of the runs that have one, as it is handed on.
[[nodiscard]] double mean_state(const Active& active);
/// Least and largest of them.
[[nodiscard]] std::pair<double, double> states_from_to(const Active& active);
/// Do the runs begin in states that differ, by more than a share of the change that goes with them, or by a clear step?
[[nodiscard]] bool states_differ(const Active& active);

/// Grids of shape parameters.
using Grid = std::vector<std::vector<double>>;
[[nodiscard]] Grid whole_orders(int first, int last);
[[nodiscard]] Grid ripple_orders();  ///< one and two a revolution, and everything between that is not whole
[[nodiscard]] Grid frequencies(double low_Hz, double high_Hz);

}  // namespace feedtwin::tools::diagnosis
