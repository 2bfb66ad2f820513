#include "controllers/recorded.h"

#include <gtest/gtest.h>

#include <memory>

namespace feedtwin::controllers {
namespace {

std::unique_ptr<Motion> made(std::vector<Reference> points) {
  auto path = std::make_shared<RecordedPath>();
  path->step_s = 2e-3;
  path->points = std::move(points);
  return make_recorded({.path = path});
}

TEST(Recorded, GivesItsPointsAndLinesBetweenThem) {
  const auto motion = made({{1.0, 0.0, 4.0, 10.0}, {2.0, 2.0, 0.0, 30.0}, {5.0, 3.0, 0.0, 0.0}});
  for (int k = 0; k < 2; ++k) EXPECT_EQ(motion->at(k * 2e-3).position_m, k + 1.0);
  const Reference amid = motion->at(1e-3);
  EXPECT_NEAR(amid.position_m, 1.5, 1e-12);
  EXPECT_NEAR(amid.velocity_m_per_s, 1.0, 1e-12);
  EXPECT_NEAR(amid.acceleration_m_per_s2, 2.0, 1e-12);
  EXPECT_NEAR(amid.force_N, 20.0, 1e-12);
}

TEST(Recorded, RestsBeforeItsBeginningAndAfterItsEnd) {
  const auto motion = made({{1.0, 0.0, 0.0, 0.0}, {5.0, 3.0, 2.0, 7.0}});
  EXPECT_EQ(motion->at(-1.0).position_m, 1.0);
  const Reference after = motion->at(10.0);
  EXPECT_EQ(after.position_m, 5.0);
  EXPECT_EQ(after.velocity_m_per_s, 0.0);
  EXPECT_EQ(after.force_N, 0.0);
}

TEST(Recorded, WithoutAPathStaysAtItsCentre) {
  EXPECT_EQ(make_recorded({.centre_m = 0.03})->at(1.0).position_m, 0.03);
}

}  // namespace
}  // namespace feedtwin::controllers
