#include "tools/identify/output_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/axis_model.h"
#include "plant/parameter_table.h"
#include "tests/support/testbed.h"
#include "tools/identify/axis_unknowns.h"
#include "tools/identify/identification.h"

namespace feedtwin::tools {
namespace {

/// Two short runs: what most tests here need.
Case short_case(unsigned seed, double off, bool sensors = true) {
  Case made = tests::testbed_case(plant::source_axis(), tests::Sensors::practice, seed, off);
  made.fit.erase(made.fit.begin() + 1, made.fit.begin() + 3);
  for (auto& recording : made.fit) {
    for (auto& [name, values] : recording.channels) values.resize(3000);
    if (sensors) continue;
    for (const char* sensor : {"torque_sensor_Nm", "force_sensor_N", "power_W"}) recording.channels.erase(sensor);
  }
  return made;
}

struct Fitted {
  std::vector<FitParameter> unknowns;
  OutputErrorFit fit;
};

Fitted fit_of(const Case& made, const OutputErrorSettings& settings = {}) {
  std::vector<ClosedLoopRun> runs;
  for (const auto& recording : made.fit) runs.emplace_back(recording, made.axis, made.controller);
  auto unknowns = axis_unknowns(made.axis, made.fit);
  const auto simulate = lane_simulator(made.axis, unknowns);
  return {unknowns, fit_output_error(runs, unknowns, simulate, settings)};
}

const FittedParameter& named(const OutputErrorFit& fit, std::string_view key) {
  return *std::ranges::find_if(fit.parameters, [key](const auto& p) { return p.parameter.key == key; });
}

TEST(OutputError, AnUnknownAtItsBoundButForRoundingHasAnInterval) {
  const Case made = short_case(3, 0.0);
  std::vector<ClosedLoopRun> runs;
  for (const auto& recording : made.fit) runs.emplace_back(recording, made.axis, made.controller);
  auto unknowns = axis_unknowns(made.axis, made.fit);
  auto& inertia = *std::ranges::find(unknowns, "motor.inertia_kgm2", [](const auto& p) { return p.key; });
  OutputErrorSettings settings;
  settings.most_iterations = 0;
  settings.encoder_grids = 0;
  const auto deviation = [&] {
    const auto simulate = lane_simulator(made.axis, unknowns);
    return named(fit_output_error(runs, unknowns, simulate, settings), "motor.inertia_kgm2").deviation;
  };
  const double free = deviation();
  inertia.lowest = std::nextafter(inertia.nominal, 0.0);
  EXPECT_NEAR(deviation(), free, 0.1 * free);
}

TEST(OutputError, FindsTheAxisThatMadeTheRecordings) {
  const auto [unknowns, fit] = fit_of(short_case(3, 0.1));
  EXPECT_TRUE(fit.converged);
  auto truth = plant::source_axis();
  for (const char* key : {"motor.inertia_kgm2", "motor.coulomb_pos_N", "motor.damping_neg_Nms", "ball_screw.coulomb_pos_N",
                          "ball_screw.viscous_neg_Ns_per_m", "guide.mass_kg", "guide.coulomb_neg_N"}) {
    const double right = plant::find_parameter(key)->in(truth);
    const auto& found = named(fit, key);
    EXPECT_TRUE(found.identifiable) << key;
    EXPECT_NEAR(found.value, right, 0.01 * right) << key;
    EXPECT_NEAR(found.value, right, 5.0 * found.deviation) << key;
    EXPECT_LT(found.deviation, 0.01 * right) << key;
  }
}

// Without a sensor between them, only sums are told: whose inertia it is does not show at the motor.
TEST(OutputError, SaysWhatTheDataCannotTellApart) {
  const auto [unknowns, fit] = fit_of(short_case(4, 0.1, false));
  for (const char* key : {"motor.inertia_kgm2", "guide.mass_kg", "motor.damping_pos_Nms"})
    EXPECT_FALSE(named(fit, key).identifiable) << key;
  EXPECT_FALSE(fit.trades.empty());
  const auto axis = axis_at(plant::source_axis(), unknowns, fit.point()).parameters, truth = plant::source_axis();
  const double right_kg = plant::make_axis_model(truth).mass_kg;
  EXPECT_NEAR(plant::make_axis_model(axis).mass_kg, right_kg, 0.01 * right_kg);
  const auto sum = [](const plant::AxisParameters& p) {
    return p.motor.coulomb_N.pos + p.ball_screw.coulomb_N.pos + p.guide.coulomb_N.pos;
  };
  EXPECT_NEAR(sum(axis), sum(truth), 0.01 * sum(truth));
}

TEST(OutputError, WiderNoiseGivesWiderIntervals) {
  Case quiet = short_case(5, 0.05), loud = quiet;
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise_N(0.0, 0.6);
  for (auto& recording : loud.fit) {
    for (double& value : recording.channels.at("force_sensor_N")) value += noise_N(random);
  }
  const auto narrow = fit_of(quiet).fit, wide = fit_of(loud).fit;
  const double ratio = named(wide, "guide.coulomb_pos_N").deviation / named(narrow, "guide.coulomb_pos_N").deviation;
  EXPECT_GT(ratio, 3.0);
  EXPECT_LT(ratio, 30.0);
}

// Four single readings of a hundred deviations among 6000: bounded, they move the numbers by a part of what they do squared.
TEST(OutputError, FewReadingsFarOffMoveLittleWhereEachIsBounded) {
  const Case calm = short_case(3, 0.05);
  Case disturbed = calm;
  for (auto& recording : disturbed.fit)
    for (const std::size_t row : {700U, 1900U}) recording.channels.at("force_sensor_N")[row] += 30.0;
  const auto moved = [&](double largest_deviations) {
    OutputErrorSettings settings;
    settings.largest_deviations = largest_deviations;
    const auto without = fit_of(calm, settings).fit, with = fit_of(disturbed, settings).fit;
    double squares = 0.0;
    for (const char* key : {"guide.coulomb_pos_N", "guide.coulomb_neg_N", "guide.viscous_pos_Ns_per_m", "guide.mass_kg"})
      squares += std::pow((named(with, key).value - named(without, key).value) / named(without, key).deviation, 2);
    return std::sqrt(squares);
  };
  const double squared = moved(0.0);
  EXPECT_GT(squared, 0.5) << "or there is nothing to bound";
  EXPECT_LT(moved(3.0), 0.5 * squared);
}

TEST(OutputError, CostOfAPopulationPutsTheTruthFirst) {
  const Case made = short_case(6, 0.1);
  std::vector<ClosedLoopRun> runs;
  for (const auto& recording : made.fit) runs.emplace_back(recording, made.axis, made.controller);
  const auto unknowns = axis_unknowns(made.axis, made.fit);
  const auto simulate = lane_simulator(made.axis, unknowns);
  auto truth = plant::source_axis();
  Eigen::MatrixXd points(static_cast<Eigen::Index>(unknowns.size()), 11);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto* entry = plant::find_parameter(unknowns[i].key);
    const double right = entry != nullptr ? entry->in(truth) : 0.0;
    for (int p = 0; p < 11; ++p) points(static_cast<Eigen::Index>(i), p) = right + 0.1 * p * (unknowns[i].nominal - right);
  }
  const Eigen::VectorXd costs = output_error_cost(runs, unknowns, simulate)(points);
  for (int p = 1; p < 11; ++p) EXPECT_GT(costs[p], costs[p - 1]) << p;
  // one at a time, or all together: the same to the last bit
  OutputErrorSettings shared;
  shared.ranks = &Ranks::world();
  const Eigen::VectorXd again = output_error_cost(runs, unknowns, simulate, shared)(points);
  EXPECT_EQ(again, costs);
}

TEST(Identification, EveryMethodEndsAtTheSamePlace) {
  const Case made = short_case(8, 0.1);
  IdentificationSettings settings;
  settings.population.population = 32;
  settings.population.most_generations = 5;
  settings.method = Method::joint;
  const auto joint = identify_case(made, settings);
  EXPECT_FALSE(joint.started_from_stages);
  for (const auto method : {Method::staged, Method::genetic, Method::population}) {
    settings.method = method;
    const auto found = identify_case(made, settings);
    EXPECT_TRUE(found.fit.converged);
    EXPECT_TRUE(found.started_from_stages);
    EXPECT_NEAR(found.fit.cost, joint.fit.cost, 0.03 * joint.fit.cost);
    EXPECT_EQ(found.population_evaluations > 0, method == Method::population);
    for (std::size_t i = 0; i < found.fit.parameters.size(); ++i) {
      const auto& p = found.fit.parameters[i];
      if (!p.identifiable) continue;
      EXPECT_NEAR(p.value, joint.fit.parameters[i].value, 5.0 * p.deviation) << p.parameter.key;
    }
  }
}

}  // namespace
}  // namespace feedtwin::tools
