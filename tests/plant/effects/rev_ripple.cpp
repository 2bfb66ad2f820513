// Ripple of the screw's friction: the same as a wave of it along the stroke whose period is a part of the lead.

#include <gtest/gtest.h>

#include "plant/parameter_table.h"
#include "tests/plant/effects/apart.h"

namespace feedtwin::plant {
namespace {

constexpr double ripple_N = 9.0, cycles_per_rev = 2.37, phase_rad = 0.6, most_Nm = 0.35;

AxisParameters with(const EffectSetting& effect) {
  AxisParameters p = source_axis();
  p.ball_screw.coulomb_N.neg = p.ball_screw.coulomb_N.pos;  // the wave's amplitude is relative, the ripple's is not
  p.axis.stroke_centre_m = 0.0;                             // from where the wave counts
  p.effects = {effect};
  return p;
}

EffectSetting ripple(double amplitude) {
  return {"rev_ripple_of_friction", {amplitude, cycles_per_rev, phase_rad}, {}};
}

TEST(RevRippleOfFriction, IsAWaveOfFrictionAsLongAsAPartOfTheLead) {
  const AxisParameters p = with(ripple(ripple_N));
  const EffectSetting wave{"position_friction_wave",
                           {ripple_N / p.ball_screw.coulomb_N.pos, p.axis.lead_m / cycles_per_rev, phase_rad, 0.0, 0.0},
                           {}};
  EXPECT_LT(apart_m(p, with(wave), most_Nm), 1e-6);
  EXPECT_GT(apart_m(p, with(ripple(0.0)), most_Nm), 1e-4);
}

TEST(RevRippleOfFriction, DragsBothWaysWhereARippleOfTheForceDrivesOneWay) {
  const EffectSetting force{"rev_ripple", {ripple_N, cycles_per_rev, phase_rad}, {}};
  EXPECT_GT(apart_m(with(ripple(ripple_N)), with(force), most_Nm), 1e-4);
}

}  // namespace
}  // namespace feedtwin::plant
