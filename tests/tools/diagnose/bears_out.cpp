// Which channels an effect is judged by.

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypothesis.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

TEST(BearsOut, AGainByItsOwnSensorAlone) {
  const auto& h = hypothesis("sensor_gain");
  ASSERT_GE(h.starts.size(), 2U);
  const Active drag{&hypothesis("quadratic_drag"), {1.0}};
  for (std::size_t i = 0; i < h.starts.size(); ++i) {  // torque and force sensor in turn
    const Active gain{&h, h.starts[i]};
    for (const auto& channel : {tools::channel::torque_cmd_Nm, tools::channel::power_W}) {
      EXPECT_FALSE(bears_out(gain, channel)) << channel;
      EXPECT_TRUE(bears_out(drag, channel)) << channel;
    }
    EXPECT_EQ(bears_out(gain, tools::channel::torque_sensor_Nm), i % 2 == 0) << i;
    EXPECT_EQ(bears_out(gain, tools::channel::force_sensor_N), i % 2 == 1) << i;
  }
}

}  // namespace
}  // namespace feedtwin
