#include "tools/identify/innovations.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace feedtwin::tools {
namespace {

constexpr double freedom_of_t = 4.0;
constexpr double by_far = 4.0;  // scales
constexpr int rounds = 3;       // of colour and cleaning

using Stretches = std::vector<std::vector<double>>;

/// Most likely scale of Student's t for these values (Lange, Little, Taylor 1989).
double scale_of_t(const Stretches& stretches) {
  constexpr int steps = 20;
  double squares = 1.0;
  for (int step = 0; step < steps; ++step) {
    double sum = 0.0, count = 1e-12;
    for (const auto& stretch : stretches) {
      for (const double e : stretch) sum += e * e * (freedom_of_t + 1.0) / (freedom_of_t + e * e / squares);
      count += static_cast<double>(stretch.size());
    }
    squares = std::max(sum / count, 1e-9);
  }
  return std::sqrt(squares);
}

double foreseen_from(const std::vector<double>& coefficients, const std::vector<double>& past, std::size_t k) {
  double foreseen = 0.0;
  for (std::size_t i = 0; i < std::min(k, coefficients.size()); ++i) foreseen += coefficients[i] * past[k - 1 - i];
  return foreseen;
}

/// Innovations of a stretch in units of the whitening's sigma, each against the cleaned values before it. Where several of
/// these were cut, and the values as they are foretell what comes while the cleaned ones do not, these have lost the track,
/// as after a burst: they begin anew from the others. Without that a stretch whose next value is foretold closely never came
/// back to it, and of two models that were the same to the last digit one was 100000 nats likelier.
void clean(const Whitening& whitening, double limit, const std::vector<double>& stretch, std::vector<double>& cleaned,
           std::vector<double>& innovations) {
  constexpr std::size_t several = 5;  // within the past that foretells; a tick and what follows it by chance are fewer
  const auto& a = whitening.coefficients;
  std::vector<bool> cut(stretch.size(), false);
  std::size_t cuts = 0;
  for (std::size_t k = 0; k < stretch.size(); ++k) {
    const std::size_t first = k - std::min(k, a.size());
    const double foreseen = foreseen_from(a, cleaned, k);
    double e = (stretch[k] - foreseen) / whitening.sigma;
    cleaned[k] = stretch[k];
    if (std::abs(e) > limit) {
      const double as_it_is = (stretch[k] - foreseen_from(a, stretch, k)) / whitening.sigma;
      if (cuts >= several && std::abs(as_it_is) <= limit) {
        const auto row = [](auto& of, std::size_t i) { return of.begin() + static_cast<std::ptrdiff_t>(i); };
        std::copy(row(stretch, first), row(stretch, k), row(cleaned, first));
        std::fill(row(cut, first), row(cut, k), false);
        cuts = 0;
        e = as_it_is;
      } else {
        cleaned[k] = foreseen + std::copysign(limit * whitening.sigma, e);
        cut[k] = true;
      }
    }
    innovations[k] = e;
    cuts += cut[k];
    if (k >= a.size()) cuts -= cut[first];
  }
}

}  // namespace

double Innovations::log_density(double value) const {
  return -std::log(scale) - 0.5 * (freedom_of_t + 1.0) * std::log1p(value * value / freedom_of_t);
}

Innovations innovations_of(const Stretches& residuals, std::size_t highest_order, double smallest_sigma) {
  Stretches cleaned = residuals;
  Innovations found{residuals, 1.0, {}};
  double limit = std::numeric_limits<double>::infinity();
  for (int round = 0; round <= rounds; ++round) {
    found.colour = fit_whitening(cleaned, highest_order, smallest_sigma);
    for (std::size_t r = 0; r < residuals.size(); ++r) clean(found.colour, limit, residuals[r], cleaned[r], found.values[r]);
    const double scale = scale_of_t(found.values);
    limit = by_far * scale;
    found.scale = found.colour.sigma * scale;
    if (round < rounds)
      for (std::size_t r = 0; r < residuals.size(); ++r)
        clean(found.colour, limit, residuals[r], cleaned[r], found.values[r]);
  }
  for (auto& stretch : found.values)
    for (double& e : stretch) e *= found.colour.sigma / found.scale;
  return found;
}

}  // namespace feedtwin::tools
