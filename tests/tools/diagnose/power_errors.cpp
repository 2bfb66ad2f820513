// What a power meter's noise is in proportion to decides what its readings say in closed loop.

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/likelihood.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

// A loss that goes with force squared shows in the largest readings: weighed by what they read they say less than they do.
TEST(PowerErrors, WhereTheyAreAlikeLargeReadingsCountInFull) {
  auto truth = plant::source_axis();
  const auto nominal = truth;
  truth.effects.push_back(tests::effect("copper_loss", {{"coefficient_W_per_Nm2", 20.0}}));
  double nats[2] = {0.0, 0.0};
  for (const bool alike : {false, true}) {
    tools::Case data;
    data.axis = nominal;
    for (const double speed : {0.02, 0.25})
      data.fit.push_back(tests::make_recording(truth, {.motion = "triangle",
                                                       .settings = {.amplitude_m = 0.03, .speed_m_per_s = speed},
                                                       .duration_s = 8.0,
                                                       .power_noise_W = 1.0}));
    for (auto& run : data.fit) run.meter = {.instants = false, .errors_alike = alike};
    const ForwardModel forward(data.fit, data);
    nats[alike] = compared(likelihood(forward, truth), likelihood(forward, nominal)).nats;
  }
  EXPECT_GT(nats[1], 5.0);
  EXPECT_GT(nats[1], 10.0 + nats[0]) << "by readings they say " << nats[0];
}

}  // namespace
}  // namespace feedtwin
