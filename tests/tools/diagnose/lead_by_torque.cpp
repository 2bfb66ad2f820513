// A wrong lead in the axis file, told by a torque constant and a torque sensor's gain that undo each other.

#include "tools/diagnose/lead_by_torque.h"

#include <gtest/gtest.h>

#include "tools/diagnose/hypotheses/registry.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

NamedEffect named(const char* id, std::vector<std::pair<std::string, Estimate>> parameters) {
  NamedEffect effect;
  effect.hypothesis = &hypothesis(id);
  effect.parameters = std::move(parameters);
  return effect;
}

Diagnosis told(double torque_gain_error, double torque_sensor_gain, double force_sensor_gain) {
  Diagnosis diagnosis;
  diagnosis.effects.push_back(named(
      "torque_gain_error", {{"relative_error", {torque_gain_error, torque_gain_error - 0.002, torque_gain_error + 0.002}}}));
  const auto exact = [](double value) { return Estimate{value, value, value}; };
  diagnosis.effects.push_back(named(
      "sensor_gain", {{"torque_sensor_gain", exact(torque_sensor_gain)}, {"force_sensor_gain", exact(force_sensor_gain)}}));
  return diagnosis;
}

TEST(LeadByTorque, OneFactorInCommandAndTorqueSensorIsTheLead) {
  const auto fault = lead_by_torque(told(-0.2, 1.25, 1.0));
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->id, "wrong_lead");
  EXPECT_NEAR(fault->parameters.front().value, 1.25, 1e-12);
  EXPECT_NEAR(fault->parameters.front().half_width, 0.002 * 1.25 * 1.25, 1e-12);
}

TEST(LeadByTorque, AConstantOrAGainAloneOrAgainstEachOtherIsNot) {
  EXPECT_FALSE(lead_by_torque(told(-0.2, 1.0, 1.0)).has_value());
  EXPECT_FALSE(lead_by_torque(told(-0.2, 0.8, 1.0)).has_value());
  EXPECT_FALSE(lead_by_torque(told(-0.2, 1.25, 1.25)).has_value());  // the force sensor too: no lead does that
  EXPECT_FALSE(lead_by_torque(told(-0.01, 1.0101, 1.0)).has_value());
  Diagnosis constant_alone = told(-0.2, 1.25, 1.0);
  constant_alone.effects.pop_back();
  EXPECT_FALSE(lead_by_torque(constant_alone).has_value());
}

}  // namespace
}  // namespace feedtwin
