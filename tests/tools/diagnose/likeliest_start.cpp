// Flanks that swing in the simulation and not on the machine hide a gap: they start with the damping that is likeliest.

#include "tools/diagnose/forward/likeliest_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/made_case.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

TEST(LikeliestStart, TakesTheDampingThatTheFlanksHave) {
  const auto& gap = hypothesis("backlash");
  for (const double damping_Ns_per_m : {2e3, 3e4}) {
    auto truth = plant::source_axis();
    truth.effects = {
        tests::effect("backlash", {{"gap_m", 3e-6}, {"stiffness_N_per_m", 6e7}, {"damping_Ns_per_m", damping_Ns_per_m}})};
    tools::Case data = tests::short_case(truth, plant::source_axis());
    data.fit = {tests::make_recording(truth, {.motion = "sine", .duration_s = 2.0, .force_noise_N = 0.05})};
    const ForwardModel forward(data.fit, data);
    const Candidate given{data.axis, {{&gap, {3e-6, 1.0 / 6e7, std::log(2e3)}}}};
    const Candidate start = at_likeliest_start(forward, given);
    ASSERT_EQ(start.effects.size(), 1U);
    const auto &q = start.effects.front().q, &as_given = given.effects.front().q;
    EXPECT_EQ(q[0], as_given[0]);
    EXPECT_EQ(q[1], as_given[1]);
    if (damping_Ns_per_m < 1e4)
      EXPECT_EQ(q[2], as_given[2]);
    else
      EXPECT_NEAR(q[2], std::log(damping_Ns_per_m), 1.0);
  }
}

}  // namespace
}  // namespace feedtwin
