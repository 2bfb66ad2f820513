// Laws of friction on the guide's contact: an axis whose screw and guide have changed places moves as before where the laws
// have changed places too, and otherwise it does not.

#include <gtest/gtest.h>

#include <utility>

#include "plant/parameter_table.h"
#include "tests/plant/effects/apart.h"

namespace feedtwin::plant {
namespace {

AxisParameters exchanged(AxisParameters p, bool laws_too) {
  std::swap(p.ball_screw, p.guide);
  p.axis.friction_laws_on_guide = laws_too ? 1.0 : 0.0;
  return p;
}

class LawsOnGuide : public testing::TestWithParam<EffectSetting> {};

TEST_P(LawsOnGuide, ChangePlacesWithTheContacts) {
  AxisParameters p = source_axis();
  p.effects = {GetParam()};
  EXPECT_LT(apart_m(p, exchanged(p, true), 0.5), 1e-9);
  EXPECT_GT(apart_m(p, exchanged(p, false), 0.5), 1e-5);
}

TEST(LawsOnGuide, AreFeltBehindTheScrewWhereTheyAreTheGuides) {
  AxisParameters p = source_axis();
  p.effects = {{"position_friction", {0.0, 4000.0, 4000.0}, {}}};
  FeedAxis of_screw(p);
  p.axis.friction_laws_on_guide = 1.0;
  FeedAxis of_guide(p);
  for (int i = 0; i < 300; ++i) of_screw.step({0.9}, 1e-3), of_guide.step({0.9}, 1e-3);
  EXPECT_NEAR(of_guide.state().position_m, of_screw.state().position_m, 1e-9);
  const double u = of_guide.state().position_m / (0.5 * p.axis.stroke_m);
  const double drag_N = 4000.0 * u * of_guide.state().velocity_m_per_s;
  EXPECT_GT(drag_N, 1.0);
  EXPECT_NEAR(of_guide.force_sensors({0.9}).force_sensor_N - of_screw.force_sensors({0.9}).force_sensor_N, drag_N,
              0.02 * drag_N);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, LawsOnGuide,
                         testing::Values(EffectSetting{"friction_drift", {-0.4, 0.8, 0.1}, {}},
                                         EffectSetting{"thermal_friction", {0.6, 4.0, 0.0}, {}},
                                         EffectSetting{"thermal_friction_of_all", {0.4, 4.0, 0.0}, {}},
                                         EffectSetting{"dwell_breakaway", {0.8, 0.05, 2e-5}, {}},
                                         EffectSetting{"position_friction", {-0.5, 2000.0, -1500.0}, {}},
                                         EffectSetting{"position_friction_wave", {0.5, 0.011, 0.3, 800.0, 0.1}, {}},
                                         EffectSetting{"sublinear_viscous", {0.6, 0.1}, {}}),
                         [](const auto& tried) { return tried.param.id; });

}  // namespace
}  // namespace feedtwin::plant
