#include "tools/identify/contour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tools/config/input_error.h"

namespace feedtwin::tools {
namespace {

double distance_to_piece_m(const PlanarPath& path, std::size_t piece, double x, double y) {
  const double ax = path.x_m[piece], ay = path.y_m[piece];
  const double dx = path.x_m[piece + 1] - ax, dy = path.y_m[piece + 1] - ay, square = dx * dx + dy * dy;
  const double along = square > 0.0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x - ax - along * dx, y - ay - along * dy);
}

TrackingError peak_and_rms(std::span<const double> errors_m) {
  TrackingError error;
  double squares = 0.0;
  for (const double e : errors_m) {
    error.peak_m = std::max(error.peak_m, e);
    squares += e * e;
  }
  error.rms_m = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(errors_m.size(), 1)));
  return error;
}

}  // namespace

std::vector<double> contour_errors_m(const PlanarPath& reference, const PlanarPath& actual, std::size_t reach) {
  const std::size_t n = actual.x_m.size(), pieces = reference.x_m.empty() ? 0 : reference.x_m.size() - 1;
  std::vector<double> errors(n, 0.0);
  for (std::size_t i = 0; i < n && pieces > 0; ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t first = i > reach ? i - reach : 0, last = std::min(pieces, i + reach);
    for (std::size_t piece = std::min(first, pieces - 1); piece < std::max(last, std::size_t{1}); ++piece)
      nearest = std::min(nearest, distance_to_piece_m(reference, piece, actual.x_m[i], actual.y_m[i]));
    errors[i] = nearest;
  }
  return errors;
}

std::vector<ContourComparison> compare_contours(const CaseComparison& x, const CaseComparison& y) {
  if (x.runs.size() != y.runs.size()) {
    throw InputError(fmt::format("the two axes' cases hold {} and {} runs; expected as many, in the same order",
                                 x.runs.size(), y.runs.size()));
  }
  std::vector<ContourComparison> contours;
  for (std::size_t i = 0; i < x.runs.size(); ++i) {
    const Recording &rx = *x.runs[i].recording, &ry = *y.runs[i].recording;
    for (const auto* r : {&rx, &ry}) {
      if (!r->has(channel::reference_m)) throw InputError(r->file, 0, "reference_m", "missing; a contour error needs it");
    }
    if (rx.size() != ry.size() || rx.at(channel::time_s)[0] != ry.at(channel::time_s)[0])
      throw InputError(ry.file, 0, "", fmt::format("expected the {} rows and times of {}", rx.size(), rx.file));
    const PlanarPath path{rx.at(channel::reference_m), ry.at(channel::reference_m)};
    contours.push_back(
        {rx.file, ry.file, peak_and_rms(contour_errors_m(path, {rx.at(channel::position_m), ry.at(channel::position_m)})),
         peak_and_rms(contour_errors_m(path, {x.runs[i].simulated.position_m, y.runs[i].simulated.position_m}))});
  }
  return contours;
}

nlohmann::json to_json(const std::vector<ContourComparison>& contours) {
  auto out = nlohmann::json::array();
  const auto numbers = [](const TrackingError& e) { return nlohmann::json{{"peak", e.peak_m}, {"rms", e.rms_m}}; };
  for (const auto& c : contours) {
    out.push_back({{"files", {c.file_x, c.file_y}}, {"recorded", numbers(c.recorded)}, {"simulated", numbers(c.simulated)}});
  }
  return out;
}

std::string to_text(const std::vector<ContourComparison>& contours) {
  std::string out;
  for (const auto& c : contours) {
    out += fmt::format(
        "contour error in um, {} with {}: recorded peak {:.2f}, rms {:.2f}; simulated peak {:.2f}, rms {:.2f}\n", c.file_x,
        c.file_y, 1e6 * c.recorded.peak_m, 1e6 * c.recorded.rms_m, 1e6 * c.simulated.peak_m, 1e6 * c.simulated.rms_m);
  }
  return out;
}

}  // namespace feedtwin::tools
