// Drag with the square of speed.

#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  const Vector v = about_sample(view.track.table_velocity_m_per_s);
  add(sum.guide_N, q[0] * v.cwiseProduct(v.cwiseAbs()));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"coefficient_Ns2_per_m2", q[0]}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 0.0;
}

}  // namespace

Hypothesis quadratic_drag() {
  return {.id = "quadratic_drag",
          .component = "guide",
          .channel = "force_sensor_N",
          .where = Where::velocity,
          .parameters = {{"coefficient_Ns2_per_m2", Kind::amplitude, 10.0}},
          .shapes = {{}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "a drag grows with the square of speed: {coefficient_Ns2_per_m2} N s^2/m^2",

          .law_of_speed = true,
          .follows_any_law = true,
          .least_deviations = deviations_of_numbers,
          .law_error = 0.01,
          .confused_with = {"sublinear_viscous"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
