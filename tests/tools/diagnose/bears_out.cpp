// Which channels an effect is judged by.

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypothesis.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

TEST(BearsOut, AGainByItsOwnSensorAlone) {
  const auto& h = hypothesis("sensor_gain");
  ASSERT_EQ(h.starts.size(), 2U);
  const Active torque{&h, h.starts[0]}, force{&h, h.starts[1]}, drag{&hypothesis("quadratic_drag"), {1.0}};
  for (const auto& channel : {tools::channel::torque_cmd_Nm, tools::channel::power_W}) {
    EXPECT_FALSE(bears_out(torque, channel) || bears_out(force, channel)) << channel;
    EXPECT_TRUE(bears_out(drag, channel)) << channel;
  }
  EXPECT_TRUE(bears_out(torque, tools::channel::torque_sensor_Nm));
  EXPECT_FALSE(bears_out(torque, tools::channel::force_sensor_N));
  EXPECT_TRUE(bears_out(force, tools::channel::force_sensor_N));
  EXPECT_FALSE(bears_out(force, tools::channel::torque_sensor_Nm));
}

}  // namespace
}  // namespace feedtwin
