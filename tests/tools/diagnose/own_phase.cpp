// A line's phase: shared by all runs, or each run's own.

#include "tools/diagnose/own_phase.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double shaking_m_per_s2 = 2.0, frequency_Hz = 23.0;

tools::Recording shaken(double phase_rad, unsigned seed) {
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect(
      "floor_vibration",
      {{"acceleration_m_per_s2", shaking_m_per_s2}, {"frequency_Hz", frequency_Hz}, {"phase_rad", phase_rad}}));
  return tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0, .seed = seed});
}

struct Shaken {
  plant::AxisParameters nominal = plant::source_axis();
  tools::Case data;
  InverseModel model, unseen;
  Fitter fitter{model, nominal};
  Whitening whitening = Whitening::estimate(model, model.residual(nominal, {}));
  Candidate fitted;

  explicit Shaken(std::vector<double> phases_rad, double unseen_rad)
      : data(tests::short_case(nominal, nominal)),
        model(make_tracks(runs_with(phases_rad), nominal), nominal),
        unseen(make_tracks({shaken(unseen_rad, 9)}, nominal), nominal) {
    Active line{&hypothesis("floor_vibration"), std::vector<double>(2 * line_runs + 1, 0.0)};
    line.q.back() = frequency_Hz + 0.01;
    fitted = fitter.fit({nominal, {line}}, whitening, 6).model;
  }
  std::vector<tools::Recording> runs_with(const std::vector<double>& phases_rad) {
    std::vector<tools::Recording> runs;
    for (const double phase_rad : phases_rad) runs.push_back(shaken(phase_rad, static_cast<unsigned>(runs.size()) + 1));
    data.fit = runs;
    return runs;
  }
  [[nodiscard]] double phase_rad(const Candidate& candidate, std::size_t run) const {
    const Active& line = candidate.effects.front();
    return std::arg(line.hypothesis->line_of(line.q, run));
  }
};

TEST(OwnPhase, OneThatAllRunsShareIsTheUnseenRunsToo) {
  const Shaken made({1.1, 1.1}, -2.0);  // the unseen run does not keep to it, and is not asked
  ASSERT_TRUE(phases_agree(made.fitted.effects.front()));
  EXPECT_NEAR(std::arg(common_line(made.fitted.effects.front())), 1.1, 0.05);
  EXPECT_NEAR(made.phase_rad(for_unseen(made.unseen, made.whitening, made.fitted), 0), 1.1, 0.05);
}

TEST(OwnPhase, NearlyAlikeByChanceIsNotShared) {
  const auto line = [](std::initializer_list<double> phases_rad) {
    const Hypothesis& process = hypothesis("process_force");
    Active one{&process, std::vector<double>(process.parameters.size(), 0.0)};
    std::size_t at = 0;
    for (const double phase_rad : phases_rad) {
      one.q[at++] = 30.0 * std::cos(phase_rad);
      one.q[at++] = 30.0 * std::sin(phase_rad);
    }
    return one;
  };
  EXPECT_TRUE(phases_agree(line({0.26, 0.30, 0.22})));
  EXPECT_FALSE(phases_agree(line({0.26, 0.38, -0.29})));
}

TEST(OwnPhase, WhereEachRunHasItsOwnTheUnseenRunIsAsked) {
  const Shaken made({0.4, -1.9}, 2.5);
  ASSERT_FALSE(phases_agree(made.fitted.effects.front()));
  EXPECT_NEAR(made.phase_rad(made.fitted, 0), 0.4, 0.05);
  EXPECT_NEAR(made.phase_rad(made.fitted, 1), -1.9, 0.05);
  EXPECT_NEAR(made.phase_rad(for_unseen(made.unseen, made.whitening, made.fitted), 0), 2.5, 0.05);
}

TEST(OwnPhase, TheClosedLoopSimulatesEachRunWithItsOwn) {
  const Shaken made({0.4, -1.9}, 2.5);
  const ForwardModel forward(made.data.fit, made.data);
  const auto own = extended(made.fitted);
  const double force = forward.nrmse(own).at("force_sensor_N"), shared = forward.nrmse(own.of(0)).at("force_sensor_N");
  EXPECT_LT(force, 0.1 * shared);
}

}  // namespace
}  // namespace feedtwin
