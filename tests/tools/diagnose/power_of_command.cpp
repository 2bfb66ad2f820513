// A drive that reports what it computes from its command: what acts between command and shaft is found all the same.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/fit.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/hypotheses/registry.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tools::Case;

constexpr double relative = 0.05, order = 2.0;

/// Runs with a ripple of the torque, whose power is by the command that they record.
std::vector<tools::Recording> rippled_runs() {
  const auto axis = plant::source_axis();
  auto truth = axis;
  truth.effects = {
      tests::effect("torque_ripple", {{"relative_amplitude", relative}, {"cycles_per_rev", order}, {"phase_rad", 0.0}})};
  std::vector<tools::Recording> runs;
  for (const double speed : {0.03, 0.11}) {
    runs.push_back(tests::make_recording(truth, {.motion = "sine",
                                                 .settings = {.amplitude_m = 0.02, .speed_m_per_s = speed},
                                                 .duration_s = 4.0,
                                                 .sensors = true,
                                                 .quantised = false}));
  }
  tests::compute_power_from_command(runs, axis);
  return runs;
}

TEST(PowerOfCommand, ForbidsNoRippleOfTheTorque) {
  auto runs = rippled_runs();
  const auto nominal = plant::source_axis();
  for (const bool known : {true, false}) {
    for (auto& run : runs) run.meter.of_command = known;
    const InverseModel model(make_tracks(runs, nominal), nominal);
    const Fitter fitter(model, nominal);
    tools::diagnosis::Whitening colour = fitter.colour_of(model.residual(nominal, {}));
    const Fit fit = fitter.fit_with_colour({nominal, {{&hypothesis("torque_ripple"), {0.0, 0.0, order}}}}, colour, 2, 10);
    const double found = std::hypot(fit.model.effects[0].q[0], fit.model.effects[0].q[1]);
    if (known)
      EXPECT_NEAR(found, relative, 0.03 * relative);
    else
      EXPECT_LT(found, 0.75 * relative) << "a measured power would have shown it";
  }
}

TEST(PowerOfCommand, IsWhatTheClosedLoopShows) {
  Case data;
  data.axis = plant::source_axis();
  data.fit = rippled_runs();
  Candidate truth{plant::source_axis(), {{&hypothesis("torque_ripple"), {relative, 0.0, order}}}};
  std::array<double, 2> power{};
  for (const bool known : {false, true}) {
    for (auto& run : data.fit) run.meter.of_command = known;
    const ForwardModel forward(data.fit, data);
    power[known] = forward.nrmse(extended(truth)).at("power_W");
  }
  EXPECT_LT(power[true], 1e-3);
  EXPECT_GT(power[false], 5.0 * power[true]);
}

}  // namespace
}  // namespace feedtwin
