// A wrong lead that the numbers took up, told by how far each of them is off.

#include "tools/diagnose/lead_by_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

Recalibrated number(const char* key, double factor) {
  return {key, 40.0, {40.0 * factor, 39.0 * factor, 41.0 * factor}};
}

/// All numbers as a lead `factor` times the file's leaves them, each beyond that off by a few per cent.
Diagnosis with_lead_of(double factor) {
  Diagnosis told;
  double more = 0.05;
  const auto add = [&](const char* key, double power) {
    told.recalibrated.push_back(number(key, std::pow(factor, power) * (1.0 + (more = -more))));
  };
  for (const char* key :
       {"ball_screw.coulomb_pos_N", "ball_screw.static_neg_N", "guide.coulomb_pos_N", "motor.coulomb_neg_N"})
    add(key, 1.0);
  for (const char* key : {"ball_screw.viscous_pos_Ns_per_m", "ball_screw.viscous_neg_Ns_per_m", "guide.mass_kg",
                          "guide.viscous_pos_Ns_per_m", "motor.ke2_neg_Ws2_per_m2", "guide.sigma0_N_per_m"})
    add(key, 2.0);
  add("motor.inertia_kgm2", 0.0);
  add("ball_screw.stribeck_pos_m_per_s", -1.0);
  return told;
}

TEST(LeadByNumbers, OneFactorThatAllNumbersGoWithIsTheLead) {
  for (const double factor : {1.25, 0.5, 2.0}) {
    const auto fault = lead_by_numbers(with_lead_of(factor));
    ASSERT_TRUE(fault.has_value()) << factor;
    EXPECT_EQ(fault->id, "wrong_lead");
    EXPECT_EQ(fault->channel, "position_m");
    EXPECT_NEAR(fault->parameters.front().value, factor, 0.05 * factor);
  }
}

TEST(LeadByNumbers, NumbersThatAreOffByAsMuchEachOrHaveNoPatternAreNone) {
  EXPECT_FALSE(lead_by_numbers(with_lead_of(1.0)).has_value());
  Diagnosis gain;  // a torque constant's: inertia too, and what goes with r^2 by no more
  for (const auto& one : with_lead_of(1.25).recalibrated) gain.recalibrated.push_back(number(one.key.c_str(), 1.25));
  EXPECT_FALSE(lead_by_numbers(gain).has_value());
  Diagnosis half = with_lead_of(2.0);  // the other half of them as the file has them
  for (std::size_t i = 0; i < half.recalibrated.size(); i += 2) half.recalibrated[i].now.value = 40.0;
  EXPECT_FALSE(lead_by_numbers(half).has_value());
  Diagnosis few = with_lead_of(1.5);
  few.recalibrated.resize(5);
  EXPECT_FALSE(lead_by_numbers(few).has_value());
}

}  // namespace
}  // namespace feedtwin
