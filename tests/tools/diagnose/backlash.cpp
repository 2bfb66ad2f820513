// Which flank bears: the force between nut and table tells, whether a sensor shows it or the model has it.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypotheses/registry.h"
#include "tools/diagnose/inverse_model.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Rms of the scale's equation.
double slip_rms_m(const InverseModel& model, const std::vector<Active>& effects) {
  const Vector residual = model.residual(plant::source_axis(), effects);
  double squares = 0.0, rows = 0.0;
  for (const auto& s : model.segments())
    if (model.equations()[s.equation].slip)
      squares += residual.segment(s.start, s.size).squaredNorm(), rows += static_cast<double>(s.size);
  return std::sqrt(squares / rows);
}

// A heavy table that brakes presses on the other flank long before it turns.
TEST(Backlash, TheFlankThatBearsIsTheForcesAndNotTheMotions) {
  auto truth = plant::source_axis();
  truth.effects.push_back(
      tests::effect("backlash", {{"gap_m", 6e-6}, {"stiffness_N_per_m", 6e7}, {"damping_Ns_per_m", 2e4}}));
  auto run = tests::make_recording(truth, {.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.2}, .scale_at_table = true});
  for (const bool sensor : {true, false}) {
    if (!sensor) run.channels.erase(std::string(tools::channel::force_sensor_N));
    const InverseModel model(make_tracks({run}, plant::source_axis()), plant::source_axis());
    const Active gap{&hypothesis("backlash"), {6e-6, 1.0 / 6e7, std::log(2e4)}};
    EXPECT_LT(slip_rms_m(model, {gap}), 0.25 * slip_rms_m(model, {})) << (sensor ? "felt" : "by the model");
  }
}

TEST(Backlash, AStifferFlankRingsNoLongerForIt) {
  const auto& gap = hypothesis("backlash");
  const auto damping_ratio = [&](double stiffness_N_per_m) {  // but for a factor
    const auto values =
        gap.named(std::vector{5e-6, 1.0 / stiffness_N_per_m, gap.shapes.front().back()}, plant::source_axis());
    EXPECT_EQ(values.back().name, "damping_Ns_per_m");
    return values.back().value / std::sqrt(stiffness_N_per_m);
  };
  EXPECT_NEAR(damping_ratio(1e9) / damping_ratio(6e7), 1.0, 1e-9);
}

}  // namespace
}  // namespace feedtwin
