#pragma once
// Low-pass filters without delay, as inverse models are fed: forwards, then backwards over the record.
//
// Conventions are MATLAB's (filtfilt's edges, decimate's filter and first sample), because published results depend on them
// in the third digit.

#include <span>
#include <vector>

namespace feedtwin::tools {

/// Transfer function of a digital filter, highest power first; denominator[0] is 1.
struct DigitalFilter {
  std::vector<double> numerator, denominator;
};

/// @param cutoff as a share of the Nyquist frequency, above 0 and below 1
[[nodiscard]] DigitalFilter butterworth(int order, double cutoff);
/// Chebyshev type I with the given ripple in the pass band.
[[nodiscard]] DigitalFilter chebyshev(int order, double ripple_dB, double cutoff);

/// Both ways; the record is continued at either end by its own reflection through the end point. Records shorter than three
/// times the order come back as they are.
[[nodiscard]] std::vector<double> filter_both_ways(const DigitalFilter& filter, std::span<const double> values);

/// Every `factor`-th sample, the last one among them, after an order-8 Chebyshev low-pass at 0.8 of the new Nyquist
/// frequency.
[[nodiscard]] std::vector<double> decimated(std::span<const double> values, int factor);

/// The factor at which `decimated` keeps a band; 1 at least.
[[nodiscard]] int decimation_keeping(double band_Hz, double sample_s);

/// Central differences; one-sided at the ends.
[[nodiscard]] std::vector<double> central_difference(std::span<const double> values, double step);

}  // namespace feedtwin::tools
