#include "tools/identify/metrics.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools {
namespace {

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// The shift of s that fits y best near zero: Gauss-Newton on y(t) = s(t + delay), with the slope of s.
double delay_between(std::span<const double> y, std::span<const double> s, double sample_s) {
  double slope_slope = 0.0, slope_error = 0.0;
  for (std::size_t i = 1; i + 1 < s.size(); ++i) {
    const double slope = (s[i + 1] - s[i - 1]) / (2.0 * sample_s);
    slope_slope += slope * slope;
    slope_error += slope * (y[i] - s[i]);
  }
  return slope_slope > 0.0 ? slope_error / slope_slope : 0.0;
}

}  // namespace

ChannelMetrics channel_metrics(std::span<const double> recorded, std::span<const double> simulated, double sample_s) {
  ChannelMetrics m;
  m.samples = std::min(recorded.size(), simulated.size());
  if (m.samples == 0) return m;
  const auto y = recorded.first(m.samples), s = simulated.first(m.samples);
  const double y_mean = mean_of(y), s_mean = mean_of(s);
  double yy = 0.0, yy0 = 0.0, ss0 = 0.0, ys0 = 0.0, ee = 0.0;
  for (std::size_t i = 0; i < m.samples; ++i) {
    const double error = y[i] - s[i];
    m.peak = std::max(m.peak, std::abs(error));
    m.recorded_peak = std::max(m.recorded_peak, std::abs(y[i]));
    ee += error * error;
    yy += y[i] * y[i];
    yy0 += (y[i] - y_mean) * (y[i] - y_mean);
    ss0 += (s[i] - s_mean) * (s[i] - s_mean);
    ys0 += (y[i] - y_mean) * (s[i] - s_mean);
  }
  const auto n = static_cast<double>(m.samples);
  m.rms = std::sqrt(ee / n);
  m.recorded_rms = std::sqrt(yy / n);
  m.rel_error = yy > 0.0 ? std::sqrt(ee / yy) : 0.0;
  m.nrmse = yy0 > 0.0 ? std::sqrt(ee / yy0) : 0.0;
  m.correlation = yy0 > 0.0 && ss0 > 0.0 ? ys0 / std::sqrt(yy0 * ss0) : 0.0;
  m.delay_s = sample_s > 0.0 ? delay_between(y, s, sample_s) : 0.0;
  return m;
}

ChannelMetrics pooled(std::span<const ChannelMetrics> runs) {
  ChannelMetrics all;
  double ee = 0.0, yy = 0.0, yy0 = 0.0, n = 0.0;
  for (const auto& m : runs) {
    const auto samples = static_cast<double>(m.samples);
    const double square = m.rms * m.rms * samples;
    ee += square;
    yy += m.recorded_rms * m.recorded_rms * samples;
    yy0 += m.nrmse > 0.0 ? square / (m.nrmse * m.nrmse) : 0.0;
    n += samples;
    all.peak = std::max(all.peak, m.peak);
    all.recorded_peak = std::max(all.recorded_peak, m.recorded_peak);
    all.correlation += m.correlation * samples;
    all.delay_s += m.delay_s * samples;
    all.samples += m.samples;
  }
  if (n == 0.0) return all;
  all.rms = std::sqrt(ee / n);
  all.recorded_rms = std::sqrt(yy / n);
  all.rel_error = yy > 0.0 ? std::sqrt(ee / yy) : 0.0;
  all.nrmse = yy0 > 0.0 ? std::sqrt(ee / yy0) : 0.0;
  all.correlation /= n;
  all.delay_s /= n;
  return all;
}

}  // namespace feedtwin::tools
