// What counts as a force on an axis of a newton of friction.

#include "tools/diagnose/size_of_axis.h"

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/learned.h"
#include "tools/diagnose/search.h"
#include "tools/diagnose/structure.h"
#include "tools/diagnose/unknown.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

plant::AxisParameters of_size(double friction, double mass) {
  auto axis = plant::source_axis();
  for (auto* coulomb_N : {&axis.motor.coulomb_N, &axis.ball_screw.coulomb_N, &axis.guide.coulomb_N})
    coulomb_N->pos *= friction, coulomb_N->neg *= friction;
  axis.motor.inertia_kgm2 *= mass, axis.ball_screw_inertia_kgm2 *= mass, axis.guide_mass_kg *= mass;
  return axis;
}

TEST(SizeOfAxis, ForcesCountInProportionOnASmallAxisAlone) {
  EXPECT_EQ(newton_of(plant::source_axis()), 1.0);
  EXPECT_EQ(newton_of(of_size(10.0, 10.0)), 1.0) << "no less on a large one";
  EXPECT_EQ(newton_of(of_size(0.0, 1.0)), 1.0) << "air bearings carry as much";
  const double small = newton_of(of_size(0.01, 0.005)), smaller = newton_of(of_size(0.005, 0.0025));
  EXPECT_LT(small, 0.1);
  EXPECT_NEAR(smaller, 0.5 * small, 1e-12);
  EXPECT_GT(newton_of(of_size(0.0, 0.0)), 0.0);
}

TEST(SizeOfAxis, TheBarForANameIsLowerOnASmallOne) {
  const auto axis = of_size(0.01, 0.005);
  EXPECT_EQ(bar_for(plant::source_axis()).force_N, Bar{}.force_N);
  EXPECT_DOUBLE_EQ(bar_for(axis).force_N, newton_of(axis) * Bar{}.force_N);
  EXPECT_DOUBLE_EQ(bar_for(axis).power_W, newton_of(axis) * Bar{}.power_W);
}

TEST(SizeOfAxis, WhatIsUnknownOnASmallOneIsSmall) {
  Structure structure;
  structure.remainder_N = 0.076, structure.share = 0.6;
  Learned table;
  table.share_unseen = 0.5, table.remainder_N = 0.1;
  EXPECT_FALSE(structure.much());
  EXPECT_FALSE(repeats(table));
  structure.newton = table.newton = newton_of(of_size(0.01, 0.005));
  EXPECT_TRUE(structure.much());
  EXPECT_TRUE(repeats(table));
}

}  // namespace
}  // namespace feedtwin
