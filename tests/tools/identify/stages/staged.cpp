#include "tools/identify/stages/staged.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "plant/parameter_table.h"
#include "tests/support/testbed.h"
#include "tools/identify/stages/sliding.h"
#include "tools/identify/stages/stage_report.h"

namespace feedtwin::tools {
namespace {

/// The source's testbed, with an axis file that is up to a quarter off.
const Case& testbed() {
  static const Case made = tests::testbed_case(plant::source_axis(), tests::Sensors::paper, 7, 0.25);
  return made;
}

double worst_share(const StagedFit& fit, std::string_view beginning) {
  auto found = fit.axis, truth = plant::source_axis();
  double worst = 0.0;
  for (const auto& entry : plant::parameter_table()) {
    if (entry.key.find(beginning) != std::string_view::npos)
      worst = std::max(worst, std::abs(entry.in(found) / entry.in(truth)-1.0));
  }
  return worst;
}

// Each stage from its own sensors alone: a start for the fit of everything together, so within a few per cent.
TEST(Stages, ComeNearTheSourcesTable2) {
  const auto fit = identify_by_stages(testbed().axis, testbed().fit);
  EXPECT_EQ(fit.notes, std::vector<std::string>{});
  EXPECT_LT(worst_share(fit, "motor.ke2"), 0.01);
  EXPECT_LT(worst_share(fit, "motor.coulomb"), 0.02);
  EXPECT_LT(worst_share(fit, "motor.damping"), 0.03);
  EXPECT_LT(worst_share(fit, "inertia"), 0.03);
  EXPECT_LT(worst_share(fit, "screw.coulomb"), 0.03);
  EXPECT_LT(worst_share(fit, "screw.viscous"), 0.03);
  EXPECT_LT(worst_share(fit, "guide.coulomb"), 0.05);
  EXPECT_LT(worst_share(fit, "static"), 0.05);
  EXPECT_LT(worst_share(fit, "stribeck"), 0.25);
  EXPECT_LT(worst_share(fit, "sigma0"), 0.25);
}

TEST(Stages, SayWhatHasNoSensor) {
  auto recordings = testbed().fit;
  for (auto& recording : recordings) {
    for (const char* sensor : {"torque_sensor_Nm", "force_sensor_N", "power_W"}) recording.channels.erase(sensor);
  }
  const auto fit = identify_by_stages(testbed().axis, recordings);
  ASSERT_EQ(fit.notes.size(), 1U);
  EXPECT_NE(fit.notes[0].find("(a)"), std::string::npos);
  // all of the friction as a whole is right, wherever it sits
  const auto total = [](const plant::AxisParameters& p) {
    return p.motor.coulomb_N.pos + p.ball_screw.coulomb_N.pos + p.guide.coulomb_N.pos;
  };
  EXPECT_NEAR(total(fit.axis), total(plant::source_axis()), 0.03 * total(plant::source_axis()));
  EXPECT_EQ(fit.axis.guide.coulomb_N.pos, testbed().axis.guide.coulomb_N.pos) << "stays as the axis file has it";
}

TEST(Stages, TakeAnyPartOfARecording) {
  for (const std::size_t rows : {200U, 250U, 1000U}) {
    auto recording = testbed().fit.front();
    for (auto& [name, values] : recording.channels) values.resize(rows);
    const auto fit = identify_by_stages(testbed().axis, std::vector{recording});
    auto axis = fit.axis;
    for (const auto& entry : plant::parameter_table()) {
      EXPECT_TRUE(std::isfinite(entry.in(axis))) << entry.key << ' ' << rows;
      EXPECT_GE(entry.in(axis), entry.lowest) << entry.key << ' ' << rows;
    }
  }
}

TEST(Stages, FiguresHoldTheCurves) {
  const auto fit = identify_by_stages(testbed().axis, testbed().fit);
  std::string titles;
  for (const auto& figure : figures_of(fit, testbed().fit, fit.axis)) {
    titles += figure.title + "\n";
    for (const auto& series : figure.series) {
      ASSERT_EQ(series.x.size(), series.y.size()) << figure.title;
      EXPECT_GT(series.x.size(), 10U) << figure.title << ' ' << series.name;
    }
  }
  for (const char* wanted : {"Electrical loss", "Stribeck curve: ball_screw", "Stribeck curve: guide",
                             "Hysteresis: ball_screw", "Hysteresis: guide"}) {
    EXPECT_NE(titles.find(wanted), std::string::npos) << wanted << " not in\n" << titles;
  }
  const auto json = to_json(fit);
  EXPECT_EQ(json["parameters"].size(), fit.keys.size());
}

TEST(Sliding, SolvesTheMotorsEquation) {
  ComponentForces run;
  run.sample_s = 1e-3;
  for (int i = 0; i < 4000; ++i) {
    const double t = 1e-3 * i, v = 0.05 * std::sin(3.0 * t) + 0.02 * std::sin(11.0 * t);
    const double a = 0.15 * std::cos(3.0 * t) + 0.22 * std::cos(11.0 * t);
    run.velocity_m_per_s.push_back(v);
    run.acceleration_m_per_s2.push_back(a);
    run.since_reversal_m.push_back(1.0);
    run.motor_N.push_back(63.0 * a + (v > 0.0 ? 36.0 + 750.0 * v : -16.0 + 520.0 * v));
  }
  const std::vector runs{run};
  const auto fit = fit_sliding(runs, &ComponentForces::motor_N, 2e-3, 0.0);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->mass_kg, 63.0, 1e-8);
  EXPECT_NEAR(fit->coulomb_N.pos, 36.0, 1e-8);
  EXPECT_NEAR(fit->coulomb_N.neg, 16.0, 1e-8);
  EXPECT_NEAR(fit->viscous_Ns_per_m.pos, 750.0, 1e-6);
  EXPECT_NEAR(fit->viscous_Ns_per_m.neg, 520.0, 1e-6);
  EXPECT_FALSE(fit_sliding(runs, &ComponentForces::motor_N, 1.0, 0.0)) << "nothing is that fast";
  EXPECT_FALSE(fit_sliding(runs, &ComponentForces::guide_N, 2e-3, 0.0)) << "no such sensor";
}

}  // namespace
}  // namespace feedtwin::tools
