// Lost counts: the encoder shows n counts less with every pass of a mark, and as many more with every pass back.

#include <cmath>
#include <numbers>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// What the reading lacks, sample by sample. The mark is passed at the shaft's true angle, reading and loss together: just
/// after a pass the reading repeats what it showed before it, and of two passes that fit the smoother motion is taken.
Vector lost(const Vector& shown_m, double per_pass_m, double lead_m, double mark_rev) {
  const auto passes_at = [&](double true_m) { return std::floor(true_m / lead_m - mark_rev) + 1.0; };
  Vector lost_m(shown_m.size());
  double before_m = shown_m[0], last_m = shown_m[0], passes = passes_at(shown_m[0]);
  for (Index k = 0; k < shown_m.size(); ++k) {
    const double expected_m = 2.0 * last_m - before_m;
    double best = passes, off_m = 1e300;
    for (const double tried : {passes, passes - 1.0, passes + 1.0}) {
      const double true_m = shown_m[k] + tried * per_pass_m;
      if (passes_at(true_m) == tried && std::abs(true_m - expected_m) < off_m)
        best = tried, off_m = std::abs(true_m - expected_m);
    }
    passes = off_m < 1e300 ? best : passes_at(shown_m[k] + passes * per_pass_m);
    lost_m[k] = passes * per_pass_m;
    before_m = k > 0 ? last_m : shown_m[k] + lost_m[k];
    last_m = shown_m[k] + lost_m[k];
  }
  return lost_m;
}

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Track& track = view.track;
  const double lead_m = view.transmission().lead_m, count_m = lead_m / view.transmission().encoder_counts_per_rev;
  const Vector lost_m = lost(track.shown_m, q[0] * count_m, lead_m, q[1] / (2.0 * std::numbers::pi));
  add(sum.slip_m, lost_m);
  Vector acceleration = Vector::Zero(track.size);  // that is not there
  const Index n = track.size;
  acceleration.segment(1, n - 2) =
      (lost_m.tail(n - 2) - 2.0 * lost_m.segment(1, n - 2) + lost_m.head(n - 2)) / (track.sample_s * track.sample_s);
  const double k = per_lead(view.transmission());
  add(sum.motor_N, view.axis().motor.inertia_kgm2 * k * k * acceleration);
  add(sum.screw_N, view.axis().ball_screw_inertia_kgm2 * k * k * acceleration);
  if (track.slip_m.size() == 0) add(sum.guide_N, view.axis().guide_mass_kg * acceleration);
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"counts_per_pass", std::round(q[0])}, {"angle_rad", q[1]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 2.0;
}

Grid angles() {
  Grid grid;
  for (int i = 0; i < 32; ++i) grid.push_back({2.0 * std::numbers::pi * i / 32.0});
  return grid;
}

}  // namespace

Hypothesis count_loss() {
  return {.id = "count_loss",
          .component = "sensors",
          .channel = "position_m",
          .where = Where::position,
          .parameters = {{"counts_per_pass", Kind::amplitude, 1.0, 0.0, 1e4}, {"angle_rad", Kind::shape, 0.02, -7.0, 7.0}},
          .shapes = angles(),
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "the encoder loses {counts_per_pass} counts at every turn, at {angle_rad} rad",
          .confused_with = {"lead_error", "cyclic_lead_error"},
          .jumps = true,
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
