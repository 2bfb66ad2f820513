// Axial compliance: scale - encoder = -F / k, F the force on the table.

#include <algorithm>
#include <cmath>

#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {
namespace {

void apply(const View& view, std::span<const double> q, Contribution& sum) {
  add(sum.slip_m, -q[0] * force_on_table(view));
}

std::vector<NamedValue> named(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return {{"stiffness_N_per_m", 1.0 / std::max(q[0], 1e-12)}, {"damping_Ns_per_m", std::exp(q[1])}};
}

bool possible(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 3e-9;
}

/// Stiffer than 100 N/um is no finding.
bool finding(std::span<const double> q, const plant::AxisParameters& /*axis*/) {
  return q[0] > 1e-8;
}

}  // namespace

Hypothesis screw_compliance() {
  return {.id = "screw_compliance",
          .component = "ball_screw",
          .channel = "scale_position_m",
          .where = Where::time,
          .parameters = {{"compliance_m_per_N", Kind::amplitude, 1e-9, 0.0, 1.2e-7},
                         {"log_damping", Kind::simulated, 1e-2, std::log(1e2), std::log(1e5)}},
          .shapes = {{std::log(screw_damping_Ns_per_m)}},
          .apply = apply,
          .named = named,
          .admissible = possible,
          .sentence = "screw, nut and bearing yield: {stiffness_N_per_m} N/m between motor and table",

          .law_error = 0.01,
          .finding = finding,
          .confused_with = {"backlash", "lead_error"},
          .friction = false};
}

}  // namespace feedtwin::tools::diagnosis
