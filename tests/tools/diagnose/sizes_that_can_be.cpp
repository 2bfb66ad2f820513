// Of what size an effect can be, from which on it is a finding, and where two are one.

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "plant/parameter_table.h"
#include "tests/tools/diagnose/named_effect.h"
#include "tools/diagnose/hypothesis.h"
#include "tools/diagnose/soft_contact.h"
#include "tools/diagnose/windows.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

TEST(ScrewCompliance, IsNoFindingWhereEveryMachineHasIt) {
  const auto finding = [](double stiffness_N_per_m) {
    return worth_naming({&hypothesis("screw_compliance"), {1.0 / stiffness_N_per_m, 0.0}}, plant::source_axis());
  };
  EXPECT_TRUE(finding(4e7));
  EXPECT_TRUE(finding(9.5e7));
  EXPECT_FALSE(finding(1.5e8)) << "machines with nothing hidden yield by 150 N/um and more";
}

TEST(PreslidingMemory, IsAFindingOnlyWhereNoSimplifiedContactOrYieldingScrewCouldBeIt) {
  auto axis = plant::source_axis();
  const auto finding = [&](double force_N, double distance_m) {
    return worth_naming({&hypothesis("presliding_memory"), {force_N, distance_m}}, axis);
  };
  EXPECT_TRUE(finding(80.0, 8e-6));
  EXPECT_TRUE(finding(8.0, 1.7e-5));
  EXPECT_FALSE(finding(80.0, 1.5e-6)) << "a bristle's own stiffness";
  EXPECT_FALSE(finding(35.0, 6e-6)) << "a contact of many elements where the model has one bristle";
  EXPECT_FALSE(finding(3.6, 1.2e-5)) << "a screw that yields";
  EXPECT_FALSE(finding(6.0, 2.6e-5)) << "contacts of slipping elements with nothing hidden";
  EXPECT_TRUE(finding(4.1, 4.9e-5)) << "over more than any of them";
  EXPECT_FALSE(finding(1.9, 1.3e-5)) << "what is left of a torque constant";
  for (auto* coulomb_N : {&axis.ball_screw.coulomb_N, &axis.guide.coulomb_N}) *coulomb_N = {200.0, 200.0};
  EXPECT_FALSE(finding(80.0, 8e-6)) << "a fifth of what the contacts have";
  EXPECT_TRUE(finding(330.0, 8e-6));
  EXPECT_FALSE(finding(330.0, 4e-6)) << "less than half of all friction, as stiff contacts with nothing hidden have it";
  axis.ball_screw.coulomb_N = {4.0, 4.0};
  axis.guide.coulomb_N = {18.0, 18.0};
  axis.ball_screw.stiffness_N_per_m = 3.7e6;
  EXPECT_FALSE(finding(11.0, 1.5e-5)) << "four times what its bristle yields, of which the memory has most";
  EXPECT_TRUE(finding(11.0, 6e-5));
}

TEST(ReadingsThatWaver, StayNextToStraight) {
  auto belt = plant::source_axis();
  belt.axis.lead_m = 0.168;
  for (const auto id : {"encoder_eccentricity", "cyclic_lead_error"}) {
    const auto can_be = [&](double amplitude_m, double cycles) {
      return possible({&hypothesis(id), {0.6 * amplitude_m, 0.8 * amplitude_m, cycles}}, belt);
    };
    EXPECT_TRUE(can_be(1e-3, 1.0)) << id;
    EXPECT_FALSE(can_be(2.1e-2, 1.0)) << id;
    EXPECT_FALSE(can_be(1e-3, 4.0)) << id << ", as steep";
  }
}

TEST(PreslidingMemory, IsToldWhereOnlyASoftenedBristleHidesIt) {
  const auto nominal = plant::source_axis();
  const double file_N_per_m = nominal.ball_screw.stiffness_N_per_m;
  const auto told = [&](double force_N, double distance_m, double left_of_the_bristle) {
    auto now = nominal;
    now.ball_screw.stiffness_N_per_m = left_of_the_bristle * file_N_per_m;
    return worth_telling({&hypothesis("presliding_memory"), {force_N, distance_m}}, now, nominal);
  };
  const double yields_m =
      (0.5 * (nominal.ball_screw.coulomb_N.pos + nominal.ball_screw.coulomb_N.neg) + 36.0) / file_N_per_m;
  EXPECT_TRUE(told(36.0, 6.6 * yields_m, 0.16));
  EXPECT_FALSE(told(36.0, 6.6 * yields_m, 0.3)) << "as contacts with nothing hidden have it";
  EXPECT_FALSE(told(36.0, 3.0 * yields_m, 0.16));
  EXPECT_FALSE(told(3.0, 6.6 * yields_m, 0.16));
  EXPECT_FALSE(worth_telling({&hypothesis("screw_compliance"), {1e-10, 0.0}}, nominal, nominal));
}

TEST(PreslidingMemory, IsToldFromABristleThatAloneHoldsIt) {
  Fit fit;
  fit.cost = 1000.0;
  fit.model.axis = plant::source_axis();
  const double file_N_per_m = fit.model.axis.ball_screw.stiffness_N_per_m;
  fit.model.axis.ball_screw.coulomb_N = {file_N_per_m * 1e-6, file_N_per_m * 1e-6};
  const auto told = [&](double left, double uncertain, std::vector<NamedEffect> beside = {}) {
    Diagnosis result;
    result.effects = std::move(beside);
    const double now = left * file_N_per_m, half = uncertain * file_N_per_m;
    result.recalibrated = {{"ball_screw.sigma0_N_per_m", file_N_per_m, {now, now - half, now + half}}};
    return memory_in_the_bristle(result, fit);
  };
  const auto memory = told(0.1, 0.004);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->hypothesis->id, "presliding_memory");
  const auto& [name, distance_m] = memory->parameters.back();
  EXPECT_EQ(name, "distance_m");
  EXPECT_NEAR(distance_m.value, 2e-5, 1e-9) << "as steep as a bristle that yields 10 um";
  EXPECT_LT(distance_m.low, 1.5e-5);
  EXPECT_GT(distance_m.high, 2.5e-5);
  EXPECT_FALSE(told(0.2, 0.004)) << "as contacts of slipping elements with nothing hidden leave it";
  EXPECT_FALSE(told(0.16, 0.03)) << "which may be one of 0.19";
  EXPECT_FALSE(told(0.1, 0.004, {tests::named("backlash", "gap_m", 1e-6)}));
  EXPECT_TRUE(told(0.1, 0.004, {tests::named("cogging", "amplitude_Nm", 0.01)}));
  fit.model.effects = {{&hypothesis("presliding_memory"), {0.6, 7e-6}}};
  EXPECT_FALSE(told(0.1, 0.004)) << "the law was there to take it, and did not";
  fit.model.effects.clear();
  const auto guides_N = std::exchange(fit.model.axis.guide.coulomb_N, {file_N_per_m * 2e-5, file_N_per_m * 2e-5});
  EXPECT_FALSE(told(0.1, 0.004)) << "a twentieth of the friction: who knows its bristle";
  fit.model.axis.guide.coulomb_N = guides_N;
  fit.model.axis.ball_screw.coulomb_N = {file_N_per_m * 4e-7, file_N_per_m * 4e-7};
  EXPECT_FALSE(told(0.1, 0.004)) << "over 4 um a bristle of a tenth yields too";
  fit.model.axis.ball_screw.coulomb_N = {file_N_per_m * 8e-5, file_N_per_m * 8e-5};
  EXPECT_FALSE(told(0.1, 0.004)) << "over 0.8 mm no friction does";
  fit.model.axis.ball_screw.coulomb_N = {file_N_per_m * 4e-5, file_N_per_m * 4e-5};
  EXPECT_TRUE(told(0.1, 0.004)) << "0.4 mm";
}

TEST(HardStop, MayBeABufferButNoSpringOfTheWholeTravel) {
  const auto can_be = [](double stiffness_N_per_m) {
    return possible({&hypothesis("hard_stop"), {stiffness_N_per_m, 20.0, 0.15, 1.0}}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(1e6));
  EXPECT_TRUE(can_be(480.0)) << "rubber, 45 mm deep";
  EXPECT_FALSE(can_be(200.0));
}

TEST(HardStop, MayShowByItsBlowAlone) {
  const auto stop = [](double stiffness_N_per_m, double damping_Ns_per_m) {
    return Active{&hypothesis("hard_stop"), {stiffness_N_per_m, damping_Ns_per_m, 0.15, 1.0}};
  };
  EXPECT_TRUE(possible(stop(0.0, 1e4), plant::source_axis()));
  EXPECT_FALSE(possible(stop(0.0, 3600.0), plant::source_axis()));
}

TEST(CopperLoss, IsSmallWhereTheMotorIsLarge) {
  EXPECT_TRUE(possible({&hypothesis("copper_loss"), {0.06}}, plant::source_axis()));
  EXPECT_FALSE(possible({&hypothesis("copper_loss"), {0.0}}, plant::source_axis()));
}

// Balls go round with the screw 0.4 times a turn; slower is place.
TEST(RevRipple, IsNoSlowerThanTheBallsGoRound) {
  for (const auto* id : {"rev_ripple", "rev_ripple_of_friction"}) {
    const auto can_be = [&](double order) {
      return possible({&hypothesis(id), {1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, order}}, plant::source_axis());
    };
    EXPECT_TRUE(can_be(0.45)) << id;
    EXPECT_FALSE(can_be(0.36)) << id;
    EXPECT_FALSE(can_be(8.0)) << id << ": the motor's";
  }
}

TEST(PositionFriction, MayBeOfTheViscousPartAlone) {
  const auto can_be = [](double share, double forth, double back) {
    return possible({&hypothesis("position_friction"), {share, forth, back}}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(0.1, 0.0, 0.0));
  EXPECT_TRUE(can_be(0.0, 100.0, 0.0));
  EXPECT_TRUE(can_be(0.0, 0.0, -100.0));
  EXPECT_FALSE(can_be(0.001, 5.0, -5.0)) << "of neither";
}

TEST(PositionFrictionWave, IsOfSlidingFrictionAndLongerThanTheScrewsTurns) {
  const auto axis = plant::source_axis();
  const double mu = axis.ball_screw.viscous_Ns_per_m.pos;
  const auto can_be = [&](double sliding, double viscous_share, double period_leads) {
    return possible(
        {&hypothesis("position_friction_wave"), {0.0, sliding, viscous_share * mu, 0.0, period_leads * axis.axis.lead_m}},
        axis);
  };
  EXPECT_TRUE(can_be(0.2, 0.0, 8.0));
  EXPECT_TRUE(can_be(-0.2, 0.2, 8.0)) << "all of the screw's friction";
  EXPECT_FALSE(can_be(0.02, 0.0, 8.0)) << "as much as any screw's";
  EXPECT_FALSE(can_be(0.1, 0.5, 8.0)) << "an oil film's";
  EXPECT_FALSE(can_be(0.2, 0.0, 2.0));
}

TEST(SublinearViscous, IsBelowOneAndToldFromOne) {
  const auto can_be = [](double exponent) {
    return possible({&hypothesis("sublinear_viscous"), {1.0 - exponent}}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(0.98));
  EXPECT_FALSE(can_be(0.995)) << "linear";
  EXPECT_FALSE(can_be(1.05)) << "drag";
}

TEST(ScrewGrowth, IsNoWrongLead) {
  const auto can_be = [](double second_run, double third_run) {
    const std::vector<double> q{6e-5, 10.0, -0.09, 0.0, second_run, third_run, 0.0};
    return possible({&hypothesis("screw_growth"), q}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(0.0, 0.0)) << "each run begins cold";
  EXPECT_TRUE(can_be(3e-5, 4e-5)) << "each warmer than the one before it";
  EXPECT_TRUE(can_be(3e-5, 6e-5));
  EXPECT_FALSE(can_be(5.8e-5, 6.1e-5)) << "as long as it will ever be";
}

TEST(HiddenFrictionCompensation, HasSetInWellBelowTheFastestSpeedThatIsLookedFor) {
  const auto can_be = [](double speed_m_per_s) {
    return possible({&hypothesis("hidden_friction_compensation"), {0.016, speed_m_per_s, 0.0, 1.0}}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(0.009));
  EXPECT_FALSE(can_be(0.02));
}

TEST(ThermalFriction, OfAFewPerCentIsNotOverAtOnce) {
  for (const char* id : {"thermal_friction", "thermal_friction_of_all"}) {
    EXPECT_FALSE(worth_naming({&hypothesis(id), {0.031, 0.12, 0.0}}, plant::source_axis())) << id;
    EXPECT_TRUE(worth_naming({&hypothesis(id), {0.013, 23.0, 0.0}}, plant::source_axis())) << id;
    EXPECT_TRUE(worth_naming({&hypothesis(id), {0.05, 0.12, 0.0}}, plant::source_axis())) << id;
  }
}

TEST(FrictionDrift, IsNotOverWithinAMove) {
  const auto can_be = [](double time_constant_s, double second_run) {
    return possible({&hypothesis("friction_drift"), {-0.03, time_constant_s, 0.0, second_run, 0.0, 0.0}},
                    plant::source_axis());
  };
  EXPECT_TRUE(can_be(20.0, 0.0));
  EXPECT_TRUE(can_be(1e4, -0.05)) << "a step between the runs";
  EXPECT_FALSE(can_be(0.42, 0.0)) << "a screw that warms";
  EXPECT_FALSE(can_be(0.42, -0.05));
}

TEST(Payload, IsOfTheOrderOfWhatTheDriveMoves) {
  const auto can_be = [](double mass_kg) { return possible({&hypothesis("payload"), {mass_kg}}, plant::source_axis()); };
  EXPECT_TRUE(can_be(13.0));
  EXPECT_FALSE(can_be(3e7)) << "something solid";
  EXPECT_FALSE(can_be(-1.0));
}

TEST(LocalFriction, IsNarrowAndNoMoreThanTheAxisHas) {
  const auto can_be = [](double height_N, double half_width_m) {
    return possible({&hypothesis("local_friction"), {height_N, 0.01, half_width_m, 0.0}}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(60.0, 2e-3));
  EXPECT_TRUE(can_be(5.0, 0.06 * plant::source_axis().axis.stroke_m));
  EXPECT_FALSE(can_be(1000.0, 2e-4)) << "something solid";
  EXPECT_FALSE(can_be(5.0, 0.03)) << "friction along the stroke";
  EXPECT_FALSE(can_be(-5.0, 2e-3));
}

TEST(TorqueGainError, AtItsBoundStandsForSomethingElse) {
  const auto can_be = [](double error) {
    return possible({&hypothesis("torque_gain_error"), {error}}, plant::source_axis());
  };
  EXPECT_TRUE(can_be(0.2));
  EXPECT_TRUE(can_be(-0.2));
  EXPECT_FALSE(can_be(0.25));
  EXPECT_FALSE(can_be(-0.25));
  EXPECT_FALSE(can_be(0.01)) << "within its tolerance";
}

// One of 50 us, on an axis with nothing hidden, looked 70 us late.
TEST(Hypothesis, WhatAnyDrivesCurrentLoopTakesIsNoFinding) {
  for (const char* id : {"input_delay", "current_loop_lag"}) {
    EXPECT_FALSE(worth_naming({&hypothesis(id), {7e-5}}, plant::source_axis())) << id;
    EXPECT_TRUE(worth_naming({&hypothesis(id), {1.5e-4}}, plant::source_axis())) << id;
  }
}

TEST(Hypothesis, ALagAndADelayAreAlikeOnlyWhereBothAreGoneWithinASample) {
  const auto of = [](std::string_view id, double seconds) { return Active{&hypothesis(id), {seconds}}; };
  constexpr double sample_s = 1e-3;
  EXPECT_TRUE(alike(of("input_delay", 1.2e-4), of("current_loop_lag", 1.2e-4), sample_s));
  EXPECT_FALSE(alike(of("input_delay", 1.2e-4), of("current_loop_lag", 4e-4), sample_s));
  EXPECT_FALSE(alike(of("input_delay", 1.2e-4), of("current_loop_lag", 1.2e-4), 0.25 * sample_s));
  EXPECT_FALSE(alike(of("input_delay", 1.2e-4), of("frictional_lag", 1.2e-4), sample_s));
}

TEST(ProcessForce, OfACutIsMoreThanTheMeanThatItPushesWith) {
  const Hypothesis& process = hypothesis("process_force");
  const auto can_be = [&](double amplitude_N, double mean_N, double opposing_N, bool in_a_part) {
    Active cut{&process, std::vector<double>(process.parameters.size(), 0.0)};
    cut.q[0] = amplitude_N, cut.q[2 * line_runs] = 60.0, cut.q[2 * line_runs + 1] = mean_N,
    cut.q[2 * line_runs + 2] = opposing_N;
    if (in_a_part) set_windows(process.first_window, cut.q, std::vector<Windows>{{{0.5, 1.5}}});
    return possible(cut, plant::source_axis());
  };
  EXPECT_TRUE(can_be(3.0, 8.0, 0.0, true));
  EXPECT_TRUE(can_be(0.01, 0.0, 0.0, false));
  EXPECT_FALSE(can_be(0.011, 0.107, 0.377, true)) << "what a polish of the numbers left";
}

TEST(ToldBySizeAlone, SlowLinesAreTheFloorsAndFastOnesTheTeeths) {
  const auto alone = [](std::string_view id, double frequency_Hz) {
    return told_by_size_alone({&hypothesis(id), {1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, frequency_Hz}});
  };
  EXPECT_TRUE(alone("floor_vibration", 17.0));
  EXPECT_TRUE(alone("process_force", 60.0));
  EXPECT_FALSE(alone("floor_vibration", 38.0)) << "where floors shake and teeth pass";
  EXPECT_FALSE(alone("process_force", 42.0));
  EXPECT_FALSE(told_by_size_alone({&hypothesis("cogging"), {0.01, 0.01, 8.0}}));
}

}  // namespace
}  // namespace feedtwin
